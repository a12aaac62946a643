// SPDX-License-Identifier: MIT
#include "bench/measure/swept_union.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace burin::bench {
namespace {

Vec3 to_axis(const compute::BallSweep& s, const Vec3& p) {
    const Vec3 e = s.end_object_m - s.start_object_m;
    const double length2 = glm::dot(e, e);
    const double t = length2 > 0 ? glm::clamp(glm::dot(p - s.start_object_m, e) / length2, 0.0, 1.0) : 0.0;
    return s.start_object_m + e * t - p;
}

}  // namespace

double cube_distance(const Vec3& p) {
    const Vec3 d = glm::abs(p - Vec3(0.5)) - Vec3(0.5);
    return glm::length(glm::max(d, Vec3(0.0))) + std::min(std::max({d.x, d.y, d.z}), 0.0);
}

SweptUnion::SweptUnion(std::span<const compute::BallSweep> sweeps)
    : sweeps_(sweeps.begin(), sweeps.end()),
      all_(sweeps.size()),
      cells_(static_cast<std::size_t>(kCells) * kCells * kCells) {
    std::iota(all_.begin(), all_.end(), 0u);
    const auto cell_of = [](double x) {
        return std::clamp(static_cast<int>(std::floor((x + kBorder_m) / kCell_m)), 0, kCells - 1);
    };
    const auto for_each_cell = [&](const compute::BallSweep& s, auto&& visit) {
        const Vec3 lo = glm::min(s.start_object_m, s.end_object_m) - Vec3(s.radius_m + kReach_m);
        const Vec3 hi = glm::max(s.start_object_m, s.end_object_m) + Vec3(s.radius_m + kReach_m);
        for (int z = cell_of(lo.z); z <= cell_of(hi.z); ++z)
            for (int y = cell_of(lo.y); y <= cell_of(hi.y); ++y)
                for (int x = cell_of(lo.x); x <= cell_of(hi.x); ++x) {
                    const Vec3 center = (Vec3(x, y, z) + 0.5) * kCell_m - kBorder_m;
                    visit(static_cast<std::size_t>((z * kCells + y) * kCells + x),
                          glm::length(to_axis(s, center)) - s.radius_m);
                }
    };
    // A sweep can be nearest or second nearest in the cell unless two others are nearer everywhere in it: distances
    // change by at most half a diagonal from the cell's centre.
    const double half_diagonal = 0.5 * std::sqrt(3.0) * kCell_m;
    std::vector<std::array<double, 2>> least(cells_.size(), {1e9, 1e9});
    for (const compute::BallSweep& s : sweeps_) {
        for_each_cell(s, [&](std::size_t cell, double distance) {
            auto& [first, second] = least[cell];
            second = std::min(second, std::max(first, distance));
            first = std::min(first, distance);
        });
    }
    for (std::uint32_t i = 0; i < sweeps_.size(); ++i) {
        for_each_cell(sweeps_[i], [&](std::size_t cell, double distance) {
            if (distance <= least[cell][1] + 2.0 * half_diagonal) cells_[cell].push_back(i);
        });
    }
}

SweptUnion::Nearest SweptUnion::among(std::span<const std::uint32_t> some, const Vec3& p) const {
    Nearest nearest;
    for (const std::uint32_t i : some) {
        const Vec3 towards = to_axis(sweeps_[i], p);
        const double distance = glm::length(towards) - sweeps_[i].radius_m;
        if (distance < nearest.distance_m) {
            nearest.second_m = nearest.distance_m;
            nearest.distance_m = distance;
            nearest.towards_axis = towards;
        } else {
            nearest.second_m = std::min(nearest.second_m, distance);
        }
    }
    return nearest;
}

const std::vector<std::uint32_t>* SweptUnion::listed_at(const Vec3& p) const {
    const Vec3 cell = glm::floor((p + kBorder_m) / kCell_m);
    for (int a = 0; a < 3; ++a) {
        if (!(cell[a] >= 0.0 && cell[a] < kCells)) return nullptr;
    }
    return &cells_[static_cast<std::size_t>((cell.z * kCells + cell.y) * kCells + cell.x)];
}

SweptUnion::Nearest SweptUnion::nearest(const Vec3& p) const {
    if (const auto* listed = listed_at(p)) {
        const Nearest found = among(*listed, p);
        if (found.second_m < kReach_m) return found;  // a sweep that is not listed is at least kReach_m away
    }
    return among(all_, p);
}

SweptUnion::SurfaceError SweptUnion::surface_error(const Vec3& p) const {
    const double cube = cube_distance(p);
    const auto* listed = listed_at(p);
    Nearest found = listed != nullptr ? among(*listed, p) : among(all_, p);
    // Sweeps that are not listed are at least kReach_m away: they matter only for a point deeper in the cube than that.
    if (found.distance_m > kReach_m && cube < -kReach_m) found = among(all_, p);
    return {std::abs(std::max(cube, -found.distance_m)), found.distance_m <= kCutRegion_m};
}

SweptUnion::SurfaceError SweptUnion::surface_error(const Vec3& p, double workpiece_m) const {
    const auto* listed = listed_at(p);
    Nearest found = listed != nullptr ? among(*listed, p) : among(all_, p);
    if (found.distance_m > kReach_m && workpiece_m > kReach_m) found = among(all_, p);
    return {std::min(workpiece_m, std::abs(found.distance_m)), found.distance_m <= kCutRegion_m};
}

}  // namespace burin::bench
