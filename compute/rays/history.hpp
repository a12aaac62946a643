// SPDX-License-Identifier: MIT
// Undo and redo of strokes, by keeping what the rays that a stroke changed held before it.
//
// Data flow: after each update record() takes the engine's changes and keeps, of each ray, the oldest ends of this stroke;
// end_stroke() closes the stroke. undo() gives the engine those ends back and keeps what they replace, for redo(). So a stroke
// costs the rays it changed, once each, however many updates it took, and undoing it gives every ray back bit for bit.
// Memory is bounded: when the strokes kept would take more than the budget, the oldest are dropped, and notices() says so.
// One thread.
#pragma once

#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "compute/engine.hpp"

namespace burin {

class History {
public:
    static constexpr std::size_t kDefaultBudget_bytes = std::size_t{1} << 30;

    explicit History(std::size_t budget_bytes = kDefaultBudget_bytes) : budget_bytes_(budget_bytes) {}

    // What an update changed, as the engine tells it. Whatever could be redone is forgotten.
    void record(const Changes& changes);
    // The updates since the last call make one stroke; none of them, none.
    void end_stroke();

    [[nodiscard]] std::size_t undoable() const { return done_.size() + (open_.rays.empty() ? 0 : 1); }
    [[nodiscard]] std::size_t redoable() const { return undone_.size(); }
    // Takes back the last stroke (an open one is closed first), or does it again. What the engine changes thereby must not be
    // recorded. False, and nothing happens, when there is none. Fails when the engine does; the stroke is then still there.
    [[nodiscard]] Result<bool> undo(CarvingEngine& engine);
    [[nodiscard]] Result<bool> redo(CarvingEngine& engine);

    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::size_t dropped_strokes() const { return dropped_strokes_; }
    // For the user, since the last call: that strokes had to be dropped.
    [[nodiscard]] std::vector<std::string> take_notices();

private:
    [[nodiscard]] static std::size_t size_of(const RayBatch& stroke);
    // Puts the last stroke of `from` into the engine, and what that replaced at the end of `to`.
    [[nodiscard]] Result<bool> exchange(std::deque<RayBatch>& from, std::deque<RayBatch>& to, CarvingEngine& engine);
    void keep_within_budget();

    std::size_t budget_bytes_, bytes_ = sizeof(RayBatch), dropped_strokes_ = 0, dropped_since_notice_ = 0;
    std::deque<RayBatch> done_, undone_;  // each ray with the ends that undoing, or redoing, gives it
    RayBatch open_;                       // the stroke in the making
    std::unordered_map<std::uint32_t, std::uint32_t> in_open_;  // which rays it has
};

}  // namespace burin
