// SPDX-License-Identifier: MIT
#include "compute/rays/solid.hpp"

#include <algorithm>

#include <cmath>
#include <string>

#include "base/try.hpp"
#include "compute/rays/memory_need.hpp"
#include "shaders/shared/capsule.h"

namespace burin::compute {
namespace {

// Sets each ray to one interval, given by span_of(axis, u, v) in lattice units, with normals from normal_of(axis, u, v,
// depth, is_upper_end).
template <typename SpanOf, typename NormalOf>
void fill_convex(Solid& solid, SpanOf span_of, NormalOf normal_of) {
    for (int axis = 0; axis < 3; ++axis) {
        DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
        set = DexelSet(solid.lattice.rays_u(axis), solid.lattice.rays_v(axis));
        std::vector<std::uint32_t> counts;
        std::vector<shared::DexelEnd> ends;
        counts.reserve(set.ray_count());
        for (int v = 0; v < solid.lattice.rays_v(axis); ++v) {
            for (int u = 0; u < solid.lattice.rays_u(axis); ++u) {
                const int ray_u = u * shared::kUnitsPerCell, ray_v = v * shared::kUnitsPerCell;
                const shared::RaySpan span = span_of(axis, ray_u, ray_v);
                counts.push_back(span.lo < span.hi ? 2 : 0);
                if (span.lo >= span.hi) continue;
                ends.push_back(shared::make_end(span.lo, 0, normal_of(axis, ray_u, ray_v, span.lo, false)));
                ends.push_back(shared::make_end(span.hi, 0, normal_of(axis, ray_u, ray_v, span.hi, true)));
            }
        }
        set.assign(counts, ends);
    }
}

std::array<int, 3> whole_units(const Vec3& units) {
    return {static_cast<int>(std::lround(units.x)), static_cast<int>(std::lround(units.y)),
            static_cast<int>(std::lround(units.z))};
}

}  // namespace

bool well_formed(const Solid& solid) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const DexelSet& set = solid.sets[a];
        if (set.ray_count() != solid.lattice.rays(axis)) return false;
        for (std::size_t r = 0; r < set.ray_count(); ++r) {
            const auto ends = set.ends(r);
            if (ends.size() % 2 != 0) return false;
            int previous = -1;
            for (const shared::DexelEnd& end : ends) {
                if (shared::depth_of(end) <= previous) return false;
                if (shared::material_of(end) >= solid.materials.size()) return false;
                previous = shared::depth_of(end);
            }
            if (previous > solid.lattice.cells[a] * shared::kUnitsPerCell) return false;
        }
    }
    return true;
}

Result<Solid> make_block(const Vec3& size_m, int resolution, geometry::Material material) {
    if (!(size_m.x > 0 && size_m.y > 0 && size_m.z > 0)) {
        return fail("workpiece block", "needs three sizes above zero", "write block:X,Y,Z in metres");
    }
    BURIN_TRY(lattice, lattice_around(Box{Vec3(0.0), size_m}, resolution));
    BURIN_TRY_DO(check_memory(lattice, memory_available()));
    Solid solid{lattice, {}, {std::move(material)}};
    const auto lo = whole_units(solid.lattice.units_from_object(Vec3(0.0)));
    const auto hi = whole_units(solid.lattice.units_from_object(size_m));
    for (std::size_t a = 0; a < 3; ++a) {
        if (hi[a] / shared::kUnitsPerCell == lo[a] / shared::kUnitsPerCell) {
            return fail("workpiece block", "is thinner than the resolution shows",
                        "raise --resolution, or make the block at least one cell thick");
        }
    }
    fill_convex(
        solid,
        [&](int axis, int ray_u, int ray_v) {
            const auto s = static_cast<std::size_t>(axis), u = (s + 1) % 3, v = (s + 2) % 3;
            const bool hit = ray_u > lo[u] && ray_u < hi[u] && ray_v > lo[v] && ray_v < hi[v];
            return hit ? shared::RaySpan{lo[s], hi[s]} : shared::RaySpan{1, 0};
        },
        [](int axis, int, int, int, bool upper) { return shared::axis_normal(axis, upper); });
    return solid;
}

Result<Solid> make_ball(double radius_m, int resolution, geometry::Material material) {
    if (!(radius_m > 0)) return fail("workpiece ball", "needs a radius above zero", "write ball:R in metres");
    BURIN_TRY(lattice, lattice_around(Box{Vec3(-radius_m), Vec3(radius_m)}, resolution));
    BURIN_TRY_DO(check_memory(lattice, memory_available()));
    Solid solid{lattice, {}, {std::move(material)}};
    const auto center = whole_units(solid.lattice.units_from_object(Vec3(0.0)));
    const double radius = radius_m / solid.lattice.unit_m();
    shared::Capsule ball{};
    ball.radius2 = std::llround(radius * radius);
    ball.start_x = center[0];
    ball.start_y = center[1];
    ball.start_z = center[2];
    fill_convex(
        solid,
        [&](int axis, int ray_u, int ray_v) {
            return shared::capsule_span(shared::capsule_from_ray(ball, axis, ray_u, ray_v));
        },
        [&](int axis, int ray_u, int ray_v, int depth, bool) {
            const std::size_t a = static_cast<std::size_t>(axis);
            std::array<std::int64_t, 3> n{};
            n[a] = depth - center[a];
            n[(a + 1) % 3] = ray_u - center[(a + 1) % 3];
            n[(a + 2) % 3] = ray_v - center[(a + 2) % 3];
            return shared::encode_normal({n[0], n[1], n[2]});
        });
    return solid;
}

Result<std::uint8_t> add_material(Solid& solid, const geometry::Material& material) {
    constexpr std::size_t kMost = 255;
    const auto same = [&](const geometry::Material& m) {
        return m.name == material.name && m.colour == material.colour;
    };
    const auto found = std::ranges::find_if(solid.materials, same);
    const auto number = static_cast<std::size_t>(found - solid.materials.begin());
    if (number >= kMost) {
        return fail("material '" + material.name + "'", "is one too many: a solid holds 255",
                    "use a colour that was used before");
    }
    if (found == solid.materials.end()) solid.materials.push_back(material);
    return static_cast<std::uint8_t>(number);
}

}  // namespace burin::compute
