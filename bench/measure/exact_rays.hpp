// SPDX-License-Identifier: MIT
// Computes what a ray along an axis keeps of the cube [0,1]^3, or of given intervals, when balls and capsules are
// removed: a reference for the carving engine, simpler and in doubles, straight from the closed forms. Shares no
// arithmetic with compute/.
// Lengths in metres, object frame. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compute/engine/engine.hpp"

namespace burin::bench {

struct Interval {
    double lo = 0.0, hi = 0.0;
    bool operator==(const Interval&) const = default;
};

// Returns the sorted, disjoint intervals that the union of the sweeps covers along the line through the point whose
// coordinates along axis + 1 and axis + 2 (cyclic) are u and v. Every sweep's radius is enlarged by `growth_m`.
[[nodiscard]] std::vector<Interval> covered(std::span<const compute::BallSweep> sweeps, int axis, double u, double v,
                                            double growth_m = 0.0);

// The sweeps of a scene, sorted into columns along one axis, so
// that a ray is tested only against those that can touch it.
class RayColumns {
public:
    // `margin_m` is the largest growth that any ray will ask for.
    RayColumns(std::span<const compute::BallSweep> sweeps, int axis, double margin_m);
    [[nodiscard]] std::vector<Interval> covered(double u, double v, double growth_m = 0.0) const;
    // Returns what is left of the cube.
    [[nodiscard]] std::vector<Interval> kept(double u, double v, double growth_m = 0.0) const;
    // Returns what is left of the given intervals of the ray, which are sorted and disjoint.
    [[nodiscard]] std::vector<Interval> kept_of(std::span<const Interval> uncut, double u, double v,
                                                double growth_m) const;

private:
    static constexpr int kColumns = 64;  // a side
    int axis_;
    std::vector<std::vector<compute::BallSweep>> columns_;
};

// Returns the interval that the cube covers of the line through the point whose coordinates along axis + 1 and axis + 2
// are u and v; nullopt where the line misses it. The cube is [0,1]^3, grown by `growth_m` on every side, and placed by
// `object_from_cube`.
[[nodiscard]] std::optional<Interval> through_cube(const Pose& object_from_cube, int axis, double u, double v,
                                                   double growth_m);

// Returns the volume that the sweeps remove from the cube, by the midpoint rule over rays_a_side^2 rays along z.
[[nodiscard]] double removed_volume_m3(std::span<const compute::BallSweep> sweeps, int rays_a_side);

// Counts the pieces of the intervals a that no interval of b covers
// and that are longer than `least`. Both are sorted and disjoint.
[[nodiscard]] std::uint64_t pieces_missing(std::span<const Interval> a, std::span<const Interval> b, double least);

}  // namespace burin::bench
