// SPDX-License-Identifier: MIT
#include "compute/tools/turning_sweep.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace burin::compute {
namespace {

// Lattice units, as for balls (sweep_units.cpp): farther away than this, a double does not hold thousandths of a unit.
constexpr double kFarthestTurning = 0x1p42;
constexpr double kLeastTolerance = 0x1p-10, kLargestTolerance = 0x1p10;  // cells
constexpr double kMostMoves = 4096;

Quat normalized(const Quat& q) {
    const double length = std::sqrt(glm::dot(q, q));
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

// Returns the same orientation with the sign for which the turn from `other` is at most half a circle.
Quat on_side_of(const Quat& other, const Quat& q) { return glm::dot(q, other) < 0.0 ? -q : q; }

// Returns an upper bound of the angle between two orientations on one side, at most 11 % too large. Their chord is
// 2 sin(A / 4), and sin x >= x sqrt(8) / pi for x up to pi / 4.
double angle_bound(const Quat& a, const Quat& b) {
    const Quat chord = b - a;
    return 2.2215 * std::sqrt(glm::dot(chord, chord));
}

bool turns_about_y(const Quat& from, const Quat& to) {
    const Quat turn = glm::conjugate(from) * to;
    return turn.x * turn.x + turn.z * turn.z < 1e-24;
}

struct PartNearLattice {
    double lo = 0.0, hi = 1.0;
};

// Returns the part of a motion in which a ball of radius `reach` about the tool's middle meets the lattice; empty when
// lo > hi.
PartNearLattice near_lattice(const Lattice& lattice, const Vec3& middle, const Vec3& along, double reach) {
    PartNearLattice part;
    for (int a = 0; a < 3; ++a) {
        const double lo = -reach,
                     hi = lattice.cells[static_cast<std::size_t>(a)] * double(shared::kUnitsPerCell) + reach;
        if (along[a] == 0.0) {
            if (middle[a] < lo || middle[a] > hi) return {1.0, 0.0};
            continue;
        }
        const double t0 = (lo - middle[a]) / along[a], t1 = (hi - middle[a]) / along[a];
        part.lo = std::max(part.lo, std::min(t0, t1));
        part.hi = std::min(part.hi, std::max(t0, t1));
    }
    return part;
}

void add_move(const Lattice& lattice, const Extent& extent, const Quat& orientation, const Vec3& middle,
              const Vec3& middle_end, std::vector<StraightMove>& moves) {
    const Vec3 along = middle_end - middle;
    const PartNearLattice part = near_lattice(lattice, middle, along, extent.radius + shared::kUnitsPerCell);
    if (part.lo > part.hi) return;
    const Vec3 start = middle - orientation * extent.middle + along * part.lo;
    moves.push_back({orientation, start, along * (part.hi - part.lo), lattice.object_from_units(start)});
}

Result<void> check(const Lattice& lattice, const ToolSweep& sweep) {
    if (!(sweep.tolerance_cells >= kLeastTolerance && sweep.tolerance_cells <= kLargestTolerance)) {
        return fail("sweep tolerance " + std::to_string(sweep.tolerance_cells), "is outside 1/1024 to 1024 cells",
                    "choose one within that range; 0.1 is usual");
    }
    for (const Pose* pose : {&sweep.start, &sweep.end}) {
        const Vec3& p = pose->position_m;
        const Quat& q = pose->orientation;
        if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(q.w + q.x + q.y + q.z)) {
            return fail("stroke", "holds a number that is not finite", "check the stroke's positions and quaternions");
        }
        const double length2 = glm::dot(q, q);
        if (!(length2 > 1e-12 && length2 < 1e12)) {
            return fail("stroke", "holds a quaternion that is no orientation", "write 0,0,0,1 for no rotation");
        }
        const Vec3 units = glm::abs(lattice.units_from_object(p));
        if (!(units.x < kFarthestTurning && units.y < kFarthestTurning && units.z < kFarthestTurning)) {
            return fail("stroke", "holds a position too far from the workpiece to be told apart from its neighbours",
                        "check the stroke's units: positions are in metres");
        }
    }
    return {};
}

}  // namespace

Quat turned(const Quat& from, const Quat& to, double share) {
    Quat lo = from, hi = on_side_of(from, to);
    if (share <= 0.0) return lo;
    if (share >= 1.0) return hi;
    for (double step = 0.5, at = 0.5; step > 0x1p-41; step *= 0.5) {
        const Quat middle = normalized(lo + hi);
        if (at == share) return middle;
        if (at < share) {
            lo = middle;
            at += 0.5 * step;
        } else {
            hi = middle;
            at -= 0.5 * step;
        }
    }
    return normalized(lo + hi);
}

Result<std::vector<StraightMove>> straight_moves(const Lattice& lattice, const ToolSweep& sweep, const Extent& extent) {
    BURIN_TRY_DO(check(lattice, sweep));
    const Quat from = normalized(sweep.start.orientation);
    const Quat to = on_side_of(from, normalized(sweep.end.orientation));
    const Vec3 start = lattice.units_from_object(sweep.start.position_m),
               end = lattice.units_from_object(sweep.end.position_m);
    std::vector<StraightMove> moves;
    if (from == to || (extent.turns_on_itself && turns_about_y(from, to))) {
        const Vec3 middle = start + from * extent.middle;
        const PartNearLattice part = near_lattice(lattice, middle, end - start, extent.radius + shared::kUnitsPerCell);
        if (part.lo > part.hi) return moves;
        const Vec3 along = (end - start) * (part.hi - part.lo);
        if (part.lo == 0.0) return std::vector{StraightMove{from, start, along, sweep.start.position_m}};
        const Vec3 clipped = start + (end - start) * part.lo;
        return std::vector{StraightMove{from, clipped, along, lattice.object_from_units(clipped)}};
    }
    const double angle = angle_bound(from, to), tolerance = sweep.tolerance_cells * shared::kUnitsPerCell;
    const double arm = std::sqrt(glm::dot(extent.middle, extent.middle));
    const double wanted = std::ceil((0.5 * extent.radius + 0.125 * arm * angle) * angle / tolerance);
    if (!(wanted <= kMostMoves)) {
        return fail("stroke", "turns the tool so far in one step that it would have to be split too often",
                    "raise --sweep-tolerance, or give the stroke more rows");
    }
    const int count = std::max(1, static_cast<int>(wanted));
    const auto middle_at = [&](double share) {
        return start + (end - start) * share + turned(from, to, share) * extent.middle;
    };
    for (int i = 0; i < count; ++i) {
        const double before = static_cast<double>(i) / count, after = static_cast<double>(i + 1) / count;
        add_move(lattice, extent, turned(from, to, 0.5 * (before + after)), middle_at(before), middle_at(after), moves);
    }
    return moves;
}

}  // namespace burin::compute
