// SPDX-License-Identifier: MIT
// Undo and redo of strokes. For each ray that a stroke changed, the history keeps the ends that it held before.
//
// Data flow: after each update, record() receives the engine's changes and keeps the oldest ends of each ray in this
// stroke; end_stroke() closes the stroke. undo() assigns those ends to the engine and keeps the ends that they replace,
// for redo(). So each changed ray is stored once a stroke, however many updates the stroke took, and undo restores
// every ray bit for bit.
// Strokes have numbers that follow each other: first() to done() lead back, done() + 1 to last() forward. A document
// keeps them by these, and a number that take_unsaved() does not name holds what it held at the call before.
// Memory is bounded: when the strokes exceed the budget, the oldest are dropped, and take_notices() reports it.
// Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compute/engine/engine.hpp"

namespace burin::compute {

// Says what a change of rays ends: nothing, as the stroke goes on; a stroke; an undo; a redo.
enum class HistoryStep : std::uint8_t { goes_on, stroke, undo, redo };

class History {
public:
    static constexpr std::size_t kDefaultBudget_bytes = std::size_t{1} << 30;

    explicit History(std::size_t budget_bytes = kDefaultBudget_bytes) : budget_bytes_(budget_bytes) {}

    // Adds the changes of an update, as taken from the engine, to the open stroke. Discards the strokes that could be
    // redone.
    void record(const Changes& changes);
    // Makes one stroke of the updates since the last call. Does nothing if there were none.
    void end_stroke();

    [[nodiscard]] std::size_t undoable() const { return done_.size() + (open_.rays.empty() ? 0 : 1); }
    [[nodiscard]] std::size_t redoable() const { return undone_.size(); }
    // Tells the states of the solid apart that the strokes lead to: the same number again after undo, and no other's.
    // It is 0 at first, also with strokes of an earlier session.
    [[nodiscard]] std::uint64_t state() const { return done_states_.empty() ? oldest_state_ : done_states_.back(); }
    // Returns how many strokes have been begun, in this history or in the one that it repeats.
    [[nodiscard]] std::uint64_t made() const { return made_; }
    // Forgets the strokes that could be redone.
    void forget_undone() { discard_undone(); }
    // undo() takes back the last stroke, after closing an open one; redo() repeats the stroke that was undone last. The
    // changes that the engine reports for this must not be recorded. Both return false, with no effect, when there is
    // no such stroke, and fail when the engine does; the stroke is then kept.
    [[nodiscard]] Result<bool> undo(CarvingEngine& engine);
    [[nodiscard]] Result<bool> redo(CarvingEngine& engine);

    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::size_t dropped_strokes() const { return dropped_strokes_; }
    // Returns messages for the user since the last call: how many strokes had to be dropped.
    [[nodiscard]] std::vector<std::string> take_notices();

    // ---- For documents. The open stroke has no number yet.

    [[nodiscard]] std::int64_t first() const { return first_; }
    [[nodiscard]] std::int64_t done() const { return first_ + static_cast<std::int64_t>(done_.size()) - 1; }
    [[nodiscard]] std::int64_t last() const { return done() + static_cast<std::int64_t>(undone_.size()); }
    // Returns the rays of the stroke with this number, from first() to last(), with the ends that undo or redo assigns.
    [[nodiscard]] const RayBatch& stroke(std::int64_t number) const;
    // Returns the numbers of the strokes that are new or other than at the last call.
    [[nodiscard]] std::set<std::int64_t> take_unsaved() { return std::exchange(unsaved_, {}); }
    // Names all of them at the next call.
    void note_all_unsaved();

    // Begins an empty history that goes on after the stroke with this number.
    void go_on_after(std::int64_t done) { first_ = done + 1; }
    // Puts a stroke before the first, or after the last. Returns false, and does nothing, where memory does not allow.
    [[nodiscard]] bool put_before(RayBatch stroke);
    [[nodiscard]] bool put_after(RayBatch stroke);
    // Repeats what another history has recorded: takes what rays held before a change that has been made again, and
    // then what that change was the end of.
    void take_held(const RayBatch& held);
    void take_step(HistoryStep step);

private:
    [[nodiscard]] static std::size_t size_of(const RayBatch& stroke);
    // Assigns the last stroke of `from` to the engine and appends the ends that it replaced to `to`.
    [[nodiscard]] Result<bool> exchange(std::deque<RayBatch>& from, std::deque<RayBatch>& to, CarvingEngine& engine);
    [[nodiscard]] RayBatch take_open();
    void discard_undone();
    void keep_within_budget();

    std::size_t budget_bytes_, bytes_ = sizeof(RayBatch), dropped_strokes_ = 0, dropped_since_notice_ = 0;
    std::deque<RayBatch> done_, undone_;  // rays with the ends that undo or redo assigns to them; the next are last
    // After each stroke of done_ and of the open one, and of undone_ once it is redone; before the oldest of done_.
    std::deque<std::uint64_t> done_states_, undone_states_;
    std::uint64_t oldest_state_ = 0, last_state_ = 0, made_ = 0;
    std::int64_t first_ = 1;
    std::set<std::int64_t> unsaved_;
    RayBatch open_;                                             // the stroke that has not ended
    std::unordered_map<std::uint32_t, std::uint32_t> in_open_;  // codes of the rays in open_
};

}  // namespace burin::compute
