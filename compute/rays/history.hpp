// SPDX-License-Identifier: MIT
// Undo and redo of strokes. For each ray that a stroke changed, the history keeps the ends that it held before.
//
// Data flow: after each update, record() receives the engine's changes and keeps the oldest ends of each ray in the
// hand's open stroke; end_stroke() closes the stroke. undo() assigns those ends to the engine and keeps the ends that
// they replace, for redo(). So each changed ray is stored once a stroke, however many updates the stroke took, and undo
// restores every ray bit for bit.
// Several hands may have strokes open at the same time. Each is undone alone, the one that ended last first, as long as
// no ray was changed by both at the same depths; of a ray that both changed elsewhere, each keeps the depths between
// which it changed it. Strokes that met while both were open cannot be taken apart and are one from then on, until all
// their hands have ended theirs (docs/decisions/024-two-hands.md).
// Memory is bounded: when the strokes exceed the budget, the oldest are dropped, and take_notices() reports it.
// Thread: one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "compute/rays/engine.hpp"

namespace burin::compute {

class History {
public:
    static constexpr std::size_t kDefaultBudget_bytes = std::size_t{1} << 30;

    explicit History(std::size_t budget_bytes = kDefaultBudget_bytes) : budget_bytes_(budget_bytes) {}

    // Adds the changes of an update, as taken from the engine, to the hand's open stroke. Discards the strokes that
    // could be redone. hand < 32.
    void record(const Changes& changes, std::size_t hand = 0);
    // Makes one of the open strokes of two hands, whatever they change: their next changes come in one record.
    void join(std::size_t hand, std::size_t other);
    // Ends the hand's stroke: the updates recorded for it since the last call. Does nothing if there were none. `solid`
    // is the engine's, after the update that was recorded last.
    void end_stroke(const Solid& solid, std::size_t hand = 0);
    // Ends the open strokes of all hands, in the order in which they worked last.
    void end_strokes(const Solid& solid);

    [[nodiscard]] std::size_t undoable() const;
    [[nodiscard]] std::size_t redoable() const { return undone_.size(); }
    // undo() takes back the last stroke, after ending the open ones; redo() repeats the stroke that was undone last.
    // The changes that the engine reports for this must not be recorded. Both return false, with no effect, when there
    // is no such stroke, and fail when the engine does; the stroke is then kept.
    [[nodiscard]] Result<bool> undo(CarvingEngine& engine);
    [[nodiscard]] Result<bool> redo(CarvingEngine& engine);

    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t dropped_strokes() const { return dropped_strokes_; }
    // Returns messages for the user since the last call: how many strokes had to be dropped.
    [[nodiscard]] std::vector<std::string> take_notices();

private:
    // Depths of a ray, lo and hi among them.
    struct Depths {
        int lo = 0, hi = 0;
        [[nodiscard]] bool meets(const Depths& other) const { return lo <= other.hi && other.lo <= hi; }
        void include(const Depths& other) {
            lo = std::min(lo, other.lo);
            hi = std::max(hi, other.hi);
        }
    };
    // A stroke that has ended, with the ends that undo or redo assigns.
    struct Stroke {
        RayBatch whole;              // rays of which it gives all ends
        RayBatch parts;              // rays of which it gives the ends between some depths only; may be odd in number
        std::vector<Depths> depths;  // of each ray in `parts`
    };
    // A stroke that has not ended, of one hand or of several that have met.
    struct Open {
        struct Touched {
            Depths depths;        // between which the stroke has changed the ray
            bool shared = false;  // another stroke has changed the ray while this one was open
        };
        std::uint32_t hands = 0;  // bits of those that have not ended it
        // The rays as they were before. The ends are the true ones where the stroke has changed the ray, and elsewhere
        // but for what other open strokes do.
        RayBatch before;
        std::vector<Touched> touched;                            // of each ray in `before`
        std::unordered_map<std::uint32_t, std::uint32_t> index;  // of a ray's code in `before`
    };

    [[nodiscard]] static std::size_t size_of(const RayBatch& rays);
    [[nodiscard]] static std::size_t size_of(const Stroke& stroke);
    [[nodiscard]] Open& open_of(std::size_t hand);
    [[nodiscard]] bool meets_another(const Open& stroke, const shared::ChangedRay& change) const;
    void note_shared(std::uint32_t ray);
    Open& absorb_all();
    void close(std::size_t open, const Solid& solid);
    // Assigns the last stroke of `from` to the engine and appends the ends that it replaced to `to`.
    [[nodiscard]] Result<bool> exchange(std::deque<Stroke>& from, std::deque<Stroke>& to, CarvingEngine& engine);
    void keep_within_budget();

    std::size_t budget_bytes_, closed_bytes_ = 0, dropped_strokes_ = 0, dropped_since_notice_ = 0;
    std::deque<Stroke> done_, undone_;
    std::vector<Open> open_;  // in the order in which they were recorded last
};

}  // namespace burin::compute
