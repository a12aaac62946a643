// SPDX-License-Identifier: MIT
#include "compute/rays/ray_algebra.hpp"

#include <algorithm>

#include "shaders/shared/octahedral.h"

namespace burin::compute {
namespace {

using shared::DexelEnd;

// Merges both lists in order of depth. inside(in_a, in_b) defines the result; an odd number of ends below a depth means
// that the depth is inside. Where both lists have an end at a depth at which the result changes, the end of a opens or
// closes an interval just as the result does, in all three operations, so it can be kept.
template <typename Inside, typename FromB>
void append_combined(RayEnds a, RayEnds b, Inside inside, FromB from_b, std::vector<DexelEnd>& to) {
    std::size_t i = 0, j = 0;
    bool before = false;
    while (i < a.size() || j < b.size()) {
        const bool takes_a = j >= b.size() || (i < a.size() && depth_of(a[i]) <= depth_of(b[j]));
        const bool takes_b = i >= a.size() || (j < b.size() && depth_of(b[j]) <= depth_of(a[i]));
        i += takes_a ? 1 : 0;
        j += takes_b ? 1 : 0;
        const bool after = inside(i % 2 != 0, j % 2 != 0);
        if (after != before) to.push_back(takes_a ? a[i - 1] : from_b(b[j - 1]));
        before = after;
    }
}

}  // namespace

void append_difference(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    append_combined(
        a, b, [](bool in_a, bool in_b) { return in_a && !in_b; },
        [](const DexelEnd& end) { return DexelEnd{end.depth_material, shared::opposite_normal(end.normal)}; }, to);
}

void append_union(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    append_combined(
        a, b, [](bool in_a, bool in_b) { return in_a || in_b; }, [](const DexelEnd& end) { return end; }, to);
}

void append_intersection(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    append_combined(
        a, b, [](bool in_a, bool in_b) { return in_a && in_b; }, [](const DexelEnd& end) { return end; }, to);
}

void append_painted(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    std::size_t j = 0;
    for (const DexelEnd& end : a) {
        while (j < b.size() && depth_of(b[j + 1]) < depth_of(end)) j += 2;
        const bool covered = j < b.size() && depth_of(b[j]) <= depth_of(end);
        to.push_back(covered ? shared::make_end(depth_of(end), material_of(b[j]), end.normal) : end);
    }
}

bool same_ends(RayEnds a, RayEnds b) {
    return std::ranges::equal(a, b, [](const DexelEnd& x, const DexelEnd& y) {
        return x.depth_material == y.depth_material && x.normal == y.normal;
    });
}

}  // namespace burin::compute
