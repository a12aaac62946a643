// SPDX-License-Identifier: MIT
#include "compute/rays/ray_batch.hpp"

#include <algorithm>
#include <utility>

namespace burin::compute {

using shared::DexelEnd;

void Changes::append(const Changes& later) {
    const auto shift = static_cast<std::uint32_t>(before.size());
    before.insert(before.end(), later.before.begin(), later.before.end());
    const std::size_t own = rays.size();
    rays.insert(rays.end(), later.rays.begin(), later.rays.end());
    for (std::size_t i = own; i < rays.size(); ++i) rays[i].first += shift;
}

Changes Changes::take() {
    Changes taken;
    taken.rays.reserve(rays.size());
    taken.before.reserve(before.size());
    std::swap(taken, *this);
    return taken;
}

bool assign_ray(DexelSet& set, const RayPlace& place, std::span<const DexelEnd> ends, Changes& changes) {
    const std::span<const DexelEnd> held = set.ends(place.u, place.v);
    const auto same = [](const DexelEnd& a, const DexelEnd& b) {
        return a.depth_material == b.depth_material && a.normal == b.normal;
    };
    const std::size_t shorter = std::min(held.size(), ends.size());
    std::size_t front = 0, back = 0;
    while (front < shorter && same(held[front], ends[front])) ++front;
    if (front == held.size() && front == ends.size()) return false;
    while (front + back < shorter && same(held[held.size() - 1 - back], ends[ends.size() - 1 - back])) ++back;
    // The lists differ in held[front .. size - back) and ends[front .. size - back); one of these ranges may be empty.
    int lo = shared::kMaxDepth, hi = 0;
    for (const std::span<const DexelEnd> list : {held, ends}) {
        if (front + back >= list.size()) continue;
        lo = std::min(lo, depth_of(list[front]));
        hi = std::max(hi, depth_of(list[list.size() - 1 - back]));
    }
    changes.record(place, lo, hi, held);
    set.replace(place.u, place.v, ends);
    return true;
}

}  // namespace burin::compute
