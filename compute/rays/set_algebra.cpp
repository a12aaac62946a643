// SPDX-License-Identifier: MIT
#include "compute/rays/set_algebra.hpp"

#include <algorithm>
#include <string>

#include "shaders/shared/octahedral.h"

namespace burin::compute {
namespace {

using shared::DexelEnd;

// Merges both lists in order of depth. inside(in_a, in_b) defines the result; an odd number of ends below a depth means
// that the depth is inside. Where both lists have an end at a depth at which the result changes, the end of a opens or
// closes an interval just as the result does, in all three operations, so it can be kept.
template <typename Inside, typename FromB>
void append_merged(RayEnds a, RayEnds b, Inside inside, FromB from_b, std::vector<DexelEnd>& to) {
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
    append_merged(
        a, b, [](bool in_a, bool in_b) { return in_a && !in_b; },
        [](const DexelEnd& end) { return DexelEnd{end.depth_material, shared::opposite_normal(end.normal)}; }, to);
}

void append_union(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    append_merged(a, b, [](bool in_a, bool in_b) { return in_a || in_b; }, [](const DexelEnd& end) { return end; }, to);
}

void append_intersection(RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    append_merged(a, b, [](bool in_a, bool in_b) { return in_a && in_b; }, [](const DexelEnd& end) { return end; }, to);
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

namespace {

constexpr std::size_t kMostMaterials = 255;

void append_combined(Combination operation, RayEnds a, RayEnds b, std::vector<DexelEnd>& to) {
    switch (operation) {
        case Combination::unite: return append_union(a, b, to);
        case Combination::subtract: return append_difference(a, b, to);
        case Combination::intersect: return append_intersection(a, b, to);
    }
}

// Returns the index in `materials` of each of b's materials. `materials` holds those of a; the ones it lacks are
// appended.
std::vector<std::uint8_t> merge_materials(const std::vector<geometry::Material>& b,
                                          std::vector<geometry::Material>& materials) {
    std::vector<std::uint8_t> places;
    for (const geometry::Material& material : b) {
        const auto same = [&](const geometry::Material& m) {
            return m.name == material.name && m.colour == material.colour;
        };
        const auto found = std::ranges::find_if(materials, same);
        places.push_back(static_cast<std::uint8_t>(found - materials.begin()));
        if (found == materials.end()) materials.push_back(material);
        if (materials.size() > kMostMaterials) break;
    }
    return places;
}

// Combines the rays of one axis; rows are distributed over the pool.
DexelSet combined_set(const Solid& a, const Solid& b, int axis, Combination operation,
                      std::span<const std::uint8_t> place_of_b, WorkerPool& pool) {
    const auto s = static_cast<std::size_t>(axis);
    const int rays_u = a.lattice.rays_u(axis), rays_v = a.lattice.rays_v(axis);
    struct Row {
        std::vector<std::uint32_t> counts;
        std::vector<DexelEnd> ends;
    };
    std::vector<Row> rows(static_cast<std::size_t>(rays_v));
    pool.run(rows.size(), [&](std::size_t v) {
        std::vector<DexelEnd> other;
        for (int u = 0; u < rays_u; ++u) {
            const RayEnds of_b = b.sets[s].ends(u, static_cast<int>(v));
            other.clear();
            for (const DexelEnd& end : of_b) {
                other.push_back(shared::make_end(depth_of(end), place_of_b[material_of(end)], end.normal));
            }
            const std::size_t before = rows[v].ends.size();
            append_combined(operation, a.sets[s].ends(u, static_cast<int>(v)), other, rows[v].ends);
            rows[v].counts.push_back(static_cast<std::uint32_t>(rows[v].ends.size() - before));
        }
    });
    std::vector<std::uint32_t> counts;
    std::vector<DexelEnd> ends;
    counts.reserve(a.lattice.rays(axis));
    for (Row& row : rows) {
        counts.insert(counts.end(), row.counts.begin(), row.counts.end());
        ends.insert(ends.end(), row.ends.begin(), row.ends.end());
        row = {};
    }
    DexelSet set(rays_u, rays_v);
    set.assign(counts, ends);
    return set;
}

}  // namespace

Result<Solid> combine(const Solid& a, const Solid& b, Combination operation, WorkerPool& pool) {
    if (!(a.lattice == b.lattice)) {
        return fail("solids", "lie on different lattices, so their rays do not meet",
                    "convert both onto one lattice (scan_convert_onto)");
    }
    Solid result{a.lattice, {}, a.materials};
    const std::vector<std::uint8_t> place_of_b = merge_materials(b.materials, result.materials);
    if (result.materials.size() > kMostMaterials) {
        return fail("solids", "have more than 255 materials together", "merge materials in one of the files");
    }
    for (int axis = 0; axis < 3; ++axis) {
        result.sets[static_cast<std::size_t>(axis)] = combined_set(a, b, axis, operation, place_of_b, pool);
    }
    return result;
}

}  // namespace burin::compute
