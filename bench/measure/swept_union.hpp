// SPDX-License-Identifier: MIT
// The signed distance to a union of swept balls, from the closed form, with a search grid that makes millions of
// queries against a thousand sweeps affordable. Metres, object frame. Reading is thread-safe.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "compute/engine/engine.hpp"

namespace burin::bench {

// Returns the signed distance to the unit cube [0,1]^3; below zero inside.
[[nodiscard]] double cube_distance(const Vec3& p);

class SweptUnion {
public:
    explicit SweptUnion(std::span<const compute::BallSweep> sweeps);

    struct Nearest {
        double distance_m = std::numeric_limits<double>::infinity();  // to the union; below zero inside
        double second_m = std::numeric_limits<double>::infinity();    // to the second nearest sweep
        Vec3 towards_axis{0.0};                                       // from the point to the nearest sweep's axis
    };
    [[nodiscard]] Nearest nearest(const Vec3& p) const;
    [[nodiscard]] double distance(const Vec3& p) const { return nearest(p).distance_m; }
    struct SurfaceError {
        double error_m = 0.0;
        bool in_cut_region = false;  // within kCutRegion_m of the union
    };
    // Returns |max(cube, -union)|, the distance of the point from the surface of the scene's solid, which is the cube
    // without the union. Exact inside the solid; a lower bound outside, where two surfaces meet.
    [[nodiscard]] SurfaceError surface_error(const Vec3& p) const;
    // Returns a lower bound of the distance from the surface of another workpiece without the union: that to the nearer
    // of the union's surface and the workpiece's, which is `workpiece_m` away.
    [[nodiscard]] SurfaceError surface_error(const Vec3& p, double workpiece_m) const;
    static constexpr double kCutRegion_m = 0.02;

    [[nodiscard]] std::span<const compute::BallSweep> sweeps() const { return sweeps_; }

private:
    [[nodiscard]] const std::vector<std::uint32_t>* listed_at(const Vec3& p) const;  // null outside the grid
    [[nodiscard]] Nearest among(std::span<const std::uint32_t> some, const Vec3& p) const;
    static constexpr int kCells = 48;  // an axis, over the cube and a border
    static constexpr double kBorder_m = 0.1, kCell_m = (1.0 + 2.0 * kBorder_m) / kCells;
    static constexpr double kReach_m = 0.03;  // beyond this distance the grid is not used

    std::vector<compute::BallSweep> sweeps_;
    std::vector<std::uint32_t> all_;
    std::vector<std::vector<std::uint32_t>> cells_;  // the sweeps that can be nearest or second nearest within the cell
};

}  // namespace burin::bench
