// SPDX-License-Identifier: MIT
#include "compute/rays/history.hpp"

#include <algorithm>
#include <utility>

#include "compute/rays/set_algebra.hpp"

namespace burin::compute {
namespace {

RayEnds ends_held(const Solid& solid, std::uint32_t code) {
    const RayPlace place = place_of(code);
    return solid.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
}

// Returns those of a ray's ends that lie at these depths.
template <typename Depths>
RayEnds at(const Depths& depths, RayEnds ends) {
    const auto depth = [](const shared::DexelEnd& end) { return depth_of(end); };
    return {std::ranges::lower_bound(ends, depths.lo, {}, depth), std::ranges::upper_bound(ends, depths.hi, {}, depth)};
}

// Returns a ray's ends with those of another state of it in their place at these depths. Just below and above them both
// are alike.
template <typename Depths>
std::vector<shared::DexelEnd> with(const Depths& depths, RayEnds other, RayEnds ends) {
    const RayEnds replaced = at(depths, ends), fresh = at(depths, other);
    std::vector<shared::DexelEnd> all(ends.begin(), replaced.begin());
    all.insert(all.end(), fresh.begin(), fresh.end());
    all.insert(all.end(), replaced.end(), ends.end());
    return all;
}

void replace(RayBatch& batch, std::uint32_t ray, std::span<const shared::DexelEnd> ends) {
    batch.rays[ray].first = static_cast<std::uint32_t>(batch.ends.size());
    batch.rays[ray].count = static_cast<std::uint32_t>(ends.size());
    batch.ends.insert(batch.ends.end(), ends.begin(), ends.end());
}

// Returns the rays of both, none of which is in both; the first itself where there are no others.
const RayBatch& all_of(const RayBatch& first, RayBatch& others) {
    if (others.rays.empty()) return first;
    for (const RayBatch::Ray& ray : first.rays) others.add(ray.code, first.ends_of(ray));
    return others;
}

}  // namespace

// ---- Strokes that are open

// Finds the hand's open stroke, or opens one, as the last of all.
History::Open& History::open_of(std::size_t hand) {
    const std::uint32_t bit = std::uint32_t{1} << hand;
    const auto found = std::ranges::find_if(open_, [&](const Open& open) { return (open.hands & bit) != 0; });
    if (found == open_.end()) {
        open_.emplace_back().hands = bit;
    } else {
        std::rotate(found, found + 1, open_.end());
    }
    return open_.back();
}

void History::record(const Changes& changes, std::size_t hand) {
    if (changes.empty()) return;
    for (const Stroke& stroke : undone_) closed_bytes_ -= size_of(stroke);
    undone_.clear();
    Open* stroke = &open_of(hand);
    for (const shared::ChangedRay& change : changes.rays) {
        if (open_.size() > 1 && meets_another(*stroke, change)) stroke = &absorb_all();
        const auto [known, is_new] =
            stroke->index.try_emplace(change.ray, static_cast<std::uint32_t>(stroke->before.rays.size()));
        if (is_new) {
            stroke->before.add(change.ray, changes.before_of(change));
            stroke->touched.push_back({{change.changed_lo, change.changed_hi}});
        } else {
            stroke->touched[known->second].depths.include({change.changed_lo, change.changed_hi});
        }
        if (open_.size() > 1) note_shared(change.ray);
    }
    keep_within_budget();
}

// Tells whether another open stroke has changed the ray at depths that this one will have changed it at.
bool History::meets_another(const Open& stroke, const shared::ChangedRay& change) const {
    Depths depths{change.changed_lo, change.changed_hi};
    if (const auto own = stroke.index.find(change.ray); own != stroke.index.end())
        depths.include(stroke.touched[own->second].depths);
    return std::ranges::any_of(open_, [&](const Open& other) {
        if (&other == &stroke) return false;
        const auto known = other.index.find(change.ray);
        return known != other.index.end() && other.touched[known->second].depths.meets(depths);
    });
}

void History::note_shared(std::uint32_t ray) {
    Open::Touched* first = nullptr;
    for (Open& open : open_) {
        const auto known = open.index.find(ray);
        if (known == open.index.end()) continue;
        Open::Touched& touched = open.touched[known->second];
        if (first != nullptr) first->shared = touched.shared = true;
        if (first == nullptr) first = &touched;
    }
}

// Makes the last of the open strokes one with all others. More than two are open only where three hands or more work.
History::Open& History::absorb_all() {
    Open all = std::move(open_.back());
    open_.pop_back();
    for (const Open& other : open_) {
        all.hands |= other.hands;
        for (std::uint32_t i = 0; i < other.before.rays.size(); ++i) {
            const RayBatch::Ray& ray = other.before.rays[i];
            const auto [known, is_new] =
                all.index.try_emplace(ray.code, static_cast<std::uint32_t>(all.before.rays.size()));
            if (is_new) {
                all.before.add(ray.code, other.before.ends_of(ray));
                all.touched.push_back(other.touched[i]);
                continue;
            }
            const std::uint32_t own = known->second;
            replace(all.before, own,
                    with(other.touched[i].depths, other.before.ends_of(ray), all.before.ends_of(all.before.rays[own])));
            all.touched[own].depths.include(other.touched[i].depths);
        }
    }
    open_.clear();
    return open_.emplace_back(std::move(all));
}

void History::join(std::size_t hand, std::size_t other) {
    const std::uint32_t bit = std::uint32_t{1} << other;
    Open* stroke = &open_of(hand);
    if ((stroke->hands & bit) != 0) return;
    if (std::ranges::any_of(open_, [&](const Open& open) { return (open.hands & bit) != 0; })) stroke = &absorb_all();
    stroke->hands |= bit;
}

void History::end_stroke(const Solid& solid, std::size_t hand) {
    const std::uint32_t bit = std::uint32_t{1} << hand;
    for (std::size_t i = 0; i < open_.size(); ++i) {
        if ((open_[i].hands & bit) == 0) continue;
        open_[i].hands &= ~bit;
        if (open_[i].hands == 0) close(i, solid);
        return;
    }
}

void History::end_strokes(const Solid& solid) {
    while (!open_.empty()) close(0, solid);
}

void History::close(std::size_t open, const Solid& solid) {
    Open ended = std::move(open_[open]);
    open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(open));
    if (ended.before.rays.empty()) return;
    // The strokes still open will be undone before this one, so what it has done was there before them.
    for (Open& later : open_) {
        for (std::uint32_t i = 0; i < ended.before.rays.size(); ++i) {
            const std::uint32_t code = ended.before.rays[i].code;
            const auto known = later.index.find(code);
            if (known == later.index.end()) continue;
            const RayEnds before = later.before.ends_of(later.before.rays[known->second]);
            replace(later.before, known->second, with(ended.touched[i].depths, ends_held(solid, code), before));
        }
    }
    Stroke stroke;
    if (std::ranges::none_of(ended.touched, &Open::Touched::shared)) {
        stroke.whole = std::move(ended.before);
    } else {
        for (std::size_t i = 0; i < ended.touched.size(); ++i) {
            const RayBatch::Ray& ray = ended.before.rays[i];
            const RayEnds before = ended.before.ends_of(ray);
            if (ended.touched[i].shared) {
                stroke.parts.add(ray.code, at(ended.touched[i].depths, before));
                stroke.depths.push_back(ended.touched[i].depths);
            } else {
                stroke.whole.add(ray.code, before);
            }
        }
    }
    stroke.whole.rays.shrink_to_fit();
    stroke.whole.ends.shrink_to_fit();
    closed_bytes_ += size_of(stroke);
    done_.push_back(std::move(stroke));
}

// ---- Strokes that have ended

std::size_t History::undoable() const {
    const auto changed = std::ranges::count_if(open_, [](const Open& open) { return !open.before.rays.empty(); });
    return done_.size() + static_cast<std::size_t>(changed);
}

Result<bool> History::undo(CarvingEngine& engine) {
    end_strokes(engine.solid());
    return exchange(done_, undone_, engine);
}

Result<bool> History::redo(CarvingEngine& engine) {
    end_strokes(engine.solid());
    return exchange(undone_, done_, engine);
}

Result<bool> History::exchange(std::deque<Stroke>& from, std::deque<Stroke>& to, CarvingEngine& engine) {
    if (from.empty()) return false;
    const Stroke& stroke = from.back();
    Stroke replaced;
    replaced.depths = stroke.depths;
    replaced.whole.rays.reserve(stroke.whole.rays.size());
    replaced.whole.ends.reserve(stroke.whole.ends.size());
    for (const RayBatch::Ray& ray : stroke.whole.rays)
        replaced.whole.add(ray.code, ends_held(engine.solid(), ray.code));
    RayBatch completed;  // the rays in parts, with the ends that stay
    for (std::size_t i = 0; i < stroke.parts.rays.size(); ++i) {
        const RayBatch::Ray& ray = stroke.parts.rays[i];
        const RayEnds held = ends_held(engine.solid(), ray.code);
        replaced.parts.add(ray.code, at(stroke.depths[i], held));
        completed.add(ray.code, with(stroke.depths[i], stroke.parts.ends_of(ray), held));
    }
    if (const auto assigned = engine.assign(all_of(stroke.whole, completed)); !assigned)
        return std::unexpected(assigned.error());
    closed_bytes_ -= size_of(stroke);
    from.pop_back();
    closed_bytes_ += size_of(replaced);
    to.push_back(std::move(replaced));
    return true;
}

// ---- Memory

std::size_t History::size_of(const RayBatch& rays) {
    return sizeof(RayBatch) + rays.rays.size() * sizeof(RayBatch::Ray) + rays.ends.size() * sizeof(shared::DexelEnd);
}

std::size_t History::size_of(const Stroke& stroke) {
    const std::size_t parts = stroke.parts.rays.empty() ? 0 : size_of(stroke.parts);
    return size_of(stroke.whole) + parts + stroke.depths.size() * sizeof(Depths);
}

std::size_t History::bytes() const {
    std::size_t open_bytes = open_.empty() ? sizeof(RayBatch) : 0;
    for (const Open& open : open_) open_bytes += size_of(open.before);
    return closed_bytes_ + open_bytes;
}

// Drops the oldest closed strokes. Open strokes are kept, since they could only be dropped in part.
void History::keep_within_budget() {
    while (bytes() > budget_bytes_ && !done_.empty()) {
        closed_bytes_ -= size_of(done_.front());
        done_.pop_front();
        ++dropped_strokes_;
        ++dropped_since_notice_;
    }
}

std::vector<std::string> History::take_notices() {
    const std::size_t dropped = std::exchange(dropped_since_notice_, 0);
    if (dropped == 0) return {};
    return {"the undo memory of " + std::to_string(budget_bytes_ >> 20) + " MiB is full: the oldest " +
            std::to_string(dropped) + (dropped == 1 ? " stroke" : " strokes") +
            " can no longer be undone; raise --undo-memory to keep more"};
}

}  // namespace burin::compute
