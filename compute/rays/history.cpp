// SPDX-License-Identifier: MIT
#include "compute/rays/history.hpp"

#include <utility>

namespace burin::compute {
namespace {

void move_last(std::deque<std::uint64_t>& from, std::deque<std::uint64_t>& to) {
    to.push_back(from.back());
    from.pop_back();
}

}  // namespace

std::size_t History::size_of(const RayBatch& stroke) {
    return sizeof(RayBatch) + stroke.rays.size() * sizeof(RayBatch::Ray) +
           stroke.ends.size() * sizeof(shared::DexelEnd);
}

void History::record(const Changes& changes) {
    if (changes.empty()) return;
    for (const RayBatch& stroke : undone_) bytes_ -= size_of(stroke);
    undone_.clear();
    undone_states_.clear();
    if (!open_.rays.empty()) done_states_.pop_back();
    done_states_.push_back(++last_state_);
    bytes_ -= size_of(open_);
    for (const shared::ChangedRay& change : changes.rays) {
        if (in_open_.try_emplace(change.ray, 0u).second) open_.add(change.ray, changes.before_of(change));
    }
    bytes_ += size_of(open_);
    keep_within_budget();
}

void History::end_stroke() {
    if (open_.rays.empty()) return;
    in_open_.clear();
    open_.rays.shrink_to_fit();
    open_.ends.shrink_to_fit();
    done_.push_back(std::exchange(open_, {}));
    bytes_ += size_of(open_);
}

// Drops the oldest closed strokes. The open stroke is kept, since it could only be dropped in part.
void History::keep_within_budget() {
    while (bytes_ > budget_bytes_ && !done_.empty()) {
        bytes_ -= size_of(done_.front());
        done_.pop_front();
        oldest_state_ = done_states_.front();
        done_states_.pop_front();
        ++dropped_strokes_;
        ++dropped_since_notice_;
    }
}

Result<bool> History::undo(CarvingEngine& engine) {
    end_stroke();
    const Result<bool> undone = exchange(done_, undone_, engine);
    if (undone && *undone) move_last(done_states_, undone_states_);
    return undone;
}

Result<bool> History::redo(CarvingEngine& engine) {
    end_stroke();
    const Result<bool> redone = exchange(undone_, done_, engine);
    if (redone && *redone) move_last(undone_states_, done_states_);
    return redone;
}

Result<bool> History::exchange(std::deque<RayBatch>& from, std::deque<RayBatch>& to, CarvingEngine& engine) {
    if (from.empty()) return false;
    const RayBatch& stroke = from.back();
    RayBatch replaced;
    replaced.rays.reserve(stroke.rays.size());
    replaced.ends.reserve(stroke.ends.size());
    for (const RayBatch::Ray& ray : stroke.rays) {
        const RayPlace place = place_of(ray.code);
        replaced.add(ray.code, engine.solid().sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v));
    }
    const Result<CarveStats> assigned = engine.assign(stroke);
    if (!assigned) return std::unexpected(assigned.error());
    bytes_ -= size_of(stroke);
    from.pop_back();
    bytes_ += size_of(replaced);
    to.push_back(std::move(replaced));
    return true;
}

std::vector<std::string> History::take_notices() {
    const std::size_t dropped = std::exchange(dropped_since_notice_, 0);
    if (dropped == 0) return {};
    return {"the undo memory of " + std::to_string(budget_bytes_ >> 20) + " MiB is full: the oldest " +
            std::to_string(dropped) + (dropped == 1 ? " stroke" : " strokes") +
            " can no longer be undone; raise --undo-memory to keep more"};
}

}  // namespace burin::compute
