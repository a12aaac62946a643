// SPDX-License-Identifier: MIT
#include "compute/rays/extent.hpp"

#include <cmath>
#include <optional>

#include "shaders/shared/octahedral.h"

namespace burin::compute {
namespace {

// Views the rays of an axis from one of its ends: that of the higher depths (side 1) or of the lower ones (side -1).
struct OneSide {
    const DexelSet& set;
    int axis;
    double side;

    // Where a ray leaves the material last: how high that is, and how the surface rises along u and v, in cells.
    struct Outermost {
        double height = 0.0, rise_u = 0.0, rise_v = 0.0;
    };
    [[nodiscard]] std::optional<Outermost> at(int u, int v) const {
        if (u < 0 || v < 0 || u >= set.rays_u() || v >= set.rays_v()) return std::nullopt;
        const auto ends = set.ends(u, v);
        if (ends.empty()) return std::nullopt;
        const shared::DexelEnd& end = side > 0.0 ? ends.back() : ends.front();
        const auto coded = shared::decode_normal(end.normal);
        const Vec3 n{static_cast<double>(coded.x), static_cast<double>(coded.y), static_cast<double>(coded.z)};
        const double along = side * n[axis];
        // A surface that is nearly along the ray says nothing of a top beside it.
        constexpr double kSteep = 0.3;
        Outermost found{side * shared::depth_of(end) / shared::kUnitsPerCell, 0.0, 0.0};
        if (along < kSteep * glm::length(n)) return found;
        found.rise_u = -n[(axis + 1) % 3] / along;
        found.rise_v = -n[(axis + 2) % 3] / along;
        return found;
    }
};

// Returns how much higher than here a parabola's top lies whose slope is `rise` here and `beyond` a cell farther up.
double rise_to_top(double rise, double beyond) {
    const double fall = rise - beyond;
    return rise * beyond < 0.0 ? 0.5 * rise * rise / std::abs(fall) : 0.0;
}

// Returns the height of the top of all rays in cells; nothing where there is no material.
std::optional<double> top_of(const OneSide& rays) {
    std::optional<OneSide::Outermost> highest;
    int top_u = 0, top_v = 0;
    for (int v = 0; v < rays.set.rays_v(); ++v) {
        for (int u = 0; u < rays.set.rays_u(); ++u) {
            const auto ends = rays.set.ends(u, v);
            if (ends.empty()) continue;
            const int depth = shared::depth_of(rays.side > 0.0 ? ends.back() : ends.front());
            if (highest && rays.side * depth / shared::kUnitsPerCell <= highest->height) continue;
            highest = rays.at(u, v);
            top_u = u;
            top_v = v;
        }
    }
    if (!highest) return std::nullopt;
    const auto beyond_u = rays.at(top_u + (highest->rise_u > 0.0 ? 1 : -1), top_v);
    const auto beyond_v = rays.at(top_u, top_v + (highest->rise_v > 0.0 ? 1 : -1));
    return highest->height + (beyond_u ? rise_to_top(highest->rise_u, beyond_u->rise_u) : 0.0) +
           (beyond_v ? rise_to_top(highest->rise_v, beyond_v->rise_v) : 0.0);
}

// Returns the bounds of the rays that meet material, in the object frame.
Box bounds_of_rays(const Solid& solid) {
    Box bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
        for (int v = 0; v < set.rays_v(); ++v)
            for (int u = 0; u < set.rays_u(); ++u) {
                const auto ends = set.ends(u, v);
                if (ends.empty()) continue;
                for (const shared::DexelEnd& end : {ends.front(), ends.back()}) {
                    Vec3 units(0.0);
                    units[axis] = shared::depth_of(end);
                    units[(axis + 1) % 3] = u * shared::kUnitsPerCell;
                    units[(axis + 2) % 3] = v * shared::kUnitsPerCell;
                    bounds.include(solid.lattice.object_from_units(units));
                }
            }
    }
    return bounds;
}

}  // namespace

Box material_bounds(const Solid& solid) {
    Box bounds = bounds_of_rays(solid);
    if (bounds.empty()) return bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
        const auto hi = top_of({set, axis, 1.0}), lo = top_of({set, axis, -1.0});
        if (!hi || !lo) continue;
        bounds.lo[axis] = solid.lattice.origin_object[axis] - *lo * solid.lattice.spacing_m;
        bounds.hi[axis] = solid.lattice.origin_object[axis] + *hi * solid.lattice.spacing_m;
    }
    return bounds;
}

}  // namespace burin::compute
