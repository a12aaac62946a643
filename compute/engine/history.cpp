// SPDX-License-Identifier: MIT
#include "compute/engine/history.hpp"

#include "base/try.hpp"

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
    discard_undone();
    if (open_.rays.empty())
        ++made_;
    else
        done_states_.pop_back();
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
    done_.push_back(take_open());
    unsaved_.insert(done());
}

// The memory stays accounted for: whoever takes the stroke keeps it.
RayBatch History::take_open() {
    in_open_.clear();
    open_.rays.shrink_to_fit();
    open_.ends.shrink_to_fit();
    RayBatch stroke = std::exchange(open_, {});
    bytes_ += size_of(open_);
    return stroke;
}

void History::discard_undone() {
    for (const RayBatch& stroke : undone_) bytes_ -= size_of(stroke);
    undone_.clear();
    undone_states_.clear();
    unsaved_.erase(unsaved_.upper_bound(done()), unsaved_.end());
}

// Drops the oldest closed strokes. The open stroke is kept, since it could only be dropped in part.
void History::keep_within_budget() {
    while (bytes_ > budget_bytes_ && !done_.empty()) {
        bytes_ -= size_of(done_.front());
        done_.pop_front();
        oldest_state_ = done_states_.front();
        done_states_.pop_front();
        unsaved_.erase(first_++);
        ++dropped_strokes_;
        ++dropped_since_notice_;
    }
}

Result<bool> History::undo(CarvingEngine& engine) {
    end_stroke();
    const std::int64_t number = done();
    const Result<bool> undone = exchange(done_, undone_, engine);
    if (undone && *undone) {
        move_last(done_states_, undone_states_);
        unsaved_.insert(number);
    }
    return undone;
}

Result<bool> History::redo(CarvingEngine& engine) {
    end_stroke();
    const Result<bool> redone = exchange(undone_, done_, engine);
    if (redone && *redone) {
        move_last(undone_states_, done_states_);
        unsaved_.insert(done());
    }
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
    BURIN_TRY_DO(engine.assign(stroke));
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

// ---- For documents

const RayBatch& History::stroke(std::int64_t number) const {
    return number <= done() ? done_[static_cast<std::size_t>(number - first_)]
                            : undone_[static_cast<std::size_t>(last() - number)];
}

void History::note_all_unsaved() {
    for (std::int64_t number = first(); number <= last(); ++number) unsaved_.insert(number);
}

bool History::put_before(RayBatch stroke) {
    if (bytes_ + size_of(stroke) > budget_bytes_) return false;
    bytes_ += size_of(stroke);
    done_.push_front(std::move(stroke));
    done_states_.push_front(std::exchange(oldest_state_, ++last_state_));
    --first_;
    return true;
}

bool History::put_after(RayBatch stroke) {
    if (bytes_ + size_of(stroke) > budget_bytes_) return false;
    bytes_ += size_of(stroke);
    undone_.push_front(std::move(stroke));
    undone_states_.push_front(++last_state_);
    return true;
}

void History::take_held(const RayBatch& held) {
    bytes_ -= size_of(open_);
    for (const RayBatch::Ray& ray : held.rays)
        if (in_open_.try_emplace(ray.code, 0u).second) open_.add(ray.code, held.ends_of(ray));
    bytes_ += size_of(open_);
}

// Where the other history went back farther than this one, what it took back can still be repeated.
void History::take_step(HistoryStep step) {
    if (step == HistoryStep::goes_on) return;
    if (step == HistoryStep::stroke) {
        if (open_.rays.empty()) return;
        discard_undone();
        ++made_;
        done_states_.push_back(++last_state_);
        end_stroke();
        return keep_within_budget();
    }
    const bool is_undo = step == HistoryStep::undo;
    std::deque<RayBatch>&from = is_undo ? done_ : undone_, &to = is_undo ? undone_ : done_;
    std::deque<std::uint64_t>&from_states = is_undo ? done_states_ : undone_states_,
    &to_states = is_undo ? undone_states_ : done_states_;
    if (from.empty()) {
        to_states.push_back(is_undo ? std::exchange(oldest_state_, last_state_ + 1) : last_state_ + 1);
        ++last_state_;
        if (is_undo) --first_;
    } else {
        bytes_ -= size_of(from.back());
        from.pop_back();
        move_last(from_states, to_states);
    }
    to.push_back(take_open());
    unsaved_.insert(is_undo ? done() + 1 : done());
    keep_within_budget();
}

}  // namespace burin::compute
