// SPDX-License-Identifier: MIT
// What a ray along an axis of the cube [0,1]^3 keeps when balls and capsules are taken out: a second, simpler way to what the
// carving engine works out, in doubles, straight from the closed forms. Shares no arithmetic with compute/.
// Lengths in metres, object frame. Any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compute/engine.hpp"

namespace burin::bench {

struct Interval {
    double lo = 0.0, hi = 0.0;
    bool operator==(const Interval&) const = default;
};

// The sorted, disjoint intervals that the union of the sweeps covers along the line through the point whose coordinates
// along axis + 1 and axis + 2 (cyclic) are u and v. The radius of every sweep is made larger by `growth_m`.
[[nodiscard]] std::vector<Interval> covered(std::span<const BallSweep> sweeps, int axis, double u, double v,
                                            double growth_m = 0.0);

// The sweeps of a scene in columns along one axis, so that a ray meets only those that can touch it.
class RayColumns {
public:
    // `margin_m`: no ray will ask for a larger growth than this.
    RayColumns(std::span<const BallSweep> sweeps, int axis, double margin_m);
    [[nodiscard]] std::vector<Interval> covered(double u, double v, double growth_m = 0.0) const;
    // What is left of the cube.
    [[nodiscard]] std::vector<Interval> kept(double u, double v, double growth_m = 0.0) const;

private:
    static constexpr int kColumns = 64;  // a side
    int axis_;
    std::vector<std::vector<BallSweep>> columns_;
};

// The volume that the sweeps take out of the cube: the midpoint rule over rays_a_side^2 rays along z.
[[nodiscard]] double removed_volume_m3(std::span<const BallSweep> sweeps, int rays_a_side);

// The pieces of the intervals a that no interval of b covers, longer than `least`, counted. Both sorted and disjoint.
[[nodiscard]] std::uint64_t pieces_missing(std::span<const Interval> a, std::span<const Interval> b, double least);

}  // namespace burin::bench
