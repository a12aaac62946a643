// SPDX-License-Identifier: MIT
#include "compute/tools/sweep_units.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace burin::compute {
namespace {

// A part lo <= t <= hi of a segment start + t * along; empty when lo > hi.
struct PartInBox {
    double lo = 0.0, hi = 1.0;
};

PartInBox clip(const Vec3& start, const Vec3& along, const Vec3& lo, const Vec3& hi) {
    PartInBox part;
    for (int a = 0; a < 3; ++a) {
        if (along[a] == 0.0) {
            if (start[a] < lo[a] || start[a] > hi[a]) return {1.0, 0.0};
            continue;
        }
        const double t0 = (lo[a] - start[a]) / along[a], t1 = (hi[a] - start[a]) / along[a];
        part.lo = std::max(part.lo, std::min(t0, t1));
        part.hi = std::min(part.hi, std::max(t0, t1));
    }
    return part;
}

// Lattice units; 4096 cells. Coordinates are at most a lattice and a radius away from the origin, so that all stay
// within +-2^26, where shaders/shared/capsule.h is exact.
constexpr double kLargestRadius = 1 << 24;

// Lattice units: farther away than this, a double does not hold thousandths of a unit.
constexpr double kFarthest = 0x1p42;

bool too_far(const Lattice& lattice, const Vec3& p_object) {
    const Vec3 units = glm::abs(lattice.units_from_object(p_object));
    // Also true when the division overflowed.
    return !(units.x < kFarthest && units.y < kFarthest && units.z < kFarthest);
}

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::optional<shared::Capsule> capsule_in_units(const Lattice& lattice, const BallSweep& sweep) {
    Vec3 start = lattice.units_from_object(sweep.start_object_m);
    Vec3 along = lattice.units_from_object(sweep.end_object_m) - start;
    const double radius = sweep.radius_m / lattice.unit_m();
    const double reach = radius + shared::kUnitsPerCell;
    const Vec3 size = Vec3(lattice.cells[0], lattice.cells[1], lattice.cells[2]) * double(shared::kUnitsPerCell);
    const PartInBox part = clip(start, along, Vec3(-reach), size + Vec3(reach));
    if (part.lo > part.hi) return std::nullopt;
    // An end that was not clipped keeps its exact position.
    const Vec3 end = part.hi < 1.0 ? start + along * part.hi : start + along;
    if (part.lo > 0.0) start = start + along * part.lo;
    shared::Capsule c{};
    c.radius2 = std::llround(radius * radius);
    c.reach = static_cast<int>(std::ceil(radius)) + 1;
    c.start_x = static_cast<int>(std::lround(start.x));
    c.start_y = static_cast<int>(std::lround(start.y));
    c.start_z = static_cast<int>(std::lround(start.z));
    c.along_x = static_cast<int>(std::lround(end.x)) - c.start_x;
    c.along_y = static_cast<int>(std::lround(end.y)) - c.start_y;
    c.along_z = static_cast<int>(std::lround(end.z)) - c.start_z;
    c.work = shared::make_work(static_cast<int>(sweep.operation), sweep.material);
    return c;
}

}  // namespace

Result<std::vector<shared::Capsule>> capsules_in_units(const Solid& solid, std::span<const BallSweep> sweeps) {
    const Lattice& lattice = solid.lattice;
    std::vector<shared::Capsule> capsules;
    capsules.reserve(sweeps.size());
    for (const BallSweep& sweep : sweeps) {
        if (!finite(sweep.start_object_m) || !finite(sweep.end_object_m) || !std::isfinite(sweep.radius_m)) {
            return fail("stroke", "holds a number that is not finite",
                        "check the stroke's positions and the tool's radius");
        }
        if (!(sweep.radius_m > 0.0) || sweep.radius_m / lattice.unit_m() > kLargestRadius) {
            return fail("tool", "radius " + std::to_string(sweep.radius_m) + " m does not fit the workpiece",
                        "choose a radius above zero and below 4096 lattice cells");
        }
        if (too_far(lattice, sweep.start_object_m) || too_far(lattice, sweep.end_object_m)) {
            return fail("stroke", "holds a position too far from the workpiece to be told apart from its neighbours",
                        "check the stroke's units: positions are in metres");
        }
        if (sweep.material >= solid.materials.size()) {
            return fail("tool", "leaves material " + std::to_string(sweep.material) + ", which the workpiece lacks",
                        "add the material to the workpiece first");
        }
        if (sweep.operation == Operation::smooth) {
            return fail("tool", "cannot smooth along a sweep",
                        "smooth with apply(), which knows the surface around it");
        }
        if (const auto capsule = capsule_in_units(lattice, sweep)) capsules.push_back(*capsule);
    }
    return capsules;
}

Footprint footprint(const Lattice& lattice, const shared::Capsule& c, int axis) {
    const auto range = [&](int start, int along, int rays, int& lo, int& hi) {
        const int from = std::min(start, start + along) - c.reach, to = std::max(start, start + along) + c.reach;
        // Rays lie at multiples of the cell. Rounding outwards is safe, because the kernel decides exactly.
        lo = std::max(0, from / shared::kUnitsPerCell - (from < 0 ? 1 : 0));
        hi = std::min(rays - 1, to / shared::kUnitsPerCell - (to < 0 ? 1 : 0));
    };
    Footprint f{};
    const int start[3] = {c.start_x, c.start_y, c.start_z}, along[3] = {c.along_x, c.along_y, c.along_z};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    range(start[u], along[u], lattice.rays_u(axis), f.u_lo, f.u_hi);
    range(start[v], along[v], lattice.rays_v(axis), f.v_lo, f.v_hi);
    return f;
}

// Rounding outwards is safe, because the closed form decides.
Footprint footprint(const Lattice& lattice, const Box& bounds, int axis) {
    const auto cell = [](double units, int last) {
        return static_cast<int>(std::clamp(std::floor(units / shared::kUnitsPerCell), -1.0, last + 1.0));
    };
    const int u = (axis + 1) % 3, v = (axis + 2) % 3, last_u = lattice.rays_u(axis) - 1,
              last_v = lattice.rays_v(axis) - 1;
    return {std::max(0, cell(bounds.lo[u], last_u)), std::min(last_u, cell(bounds.hi[u], last_u) + 1),
            std::max(0, cell(bounds.lo[v], last_v)), std::min(last_v, cell(bounds.hi[v], last_v) + 1)};
}

}  // namespace burin::compute
