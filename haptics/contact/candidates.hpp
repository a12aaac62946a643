// SPDX-License-Identifier: MIT
// Holds the triangles and vertices that a ball may touch in this tick: gathered from the surface once (broad phase),
// then tested in every step.
//
// Gathered along a straight segment with a slack: the set is complete for every ball centre within `slack` of the
// segment. It holds triangles, and vertices alone where the surface is so fine that the ball cannot tell the difference
// (geometry/contact/surface_points.hpp). Capacity is fixed, on the stack, and only the filled part is ever touched.
// Frame: relative to the surface's origin, metres. No heap, lock, throw.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/contact/posed_surface.hpp"
#include "haptics/contact/point_fours.hpp"
#include "haptics/contact/triangle_fours.hpp"

namespace burin::haptics {

// A straight segment that the ball's centre moves along.
struct Way {
    Vec3 from{0.0}, to{0.0};
};

// Squared distance of p from the segment.
[[nodiscard]] inline double distance2(const Way& way, const Vec3& p) noexcept {
    const Vec3 motion = way.to - way.from, off = p - way.from;
    const double length2 = glm::dot(motion, motion);
    const double share = length2 > 0.0 ? glm::dot(off, motion) / length2 : 0.0;
    const double along = share < 0.0 ? 0.0 : (share > 1.0 ? 1.0 : share);
    const Vec3 across = off - along * motion;
    return glm::dot(across, across);
}

class Candidates {
public:
    // Candidates are numbered: triangles from 0, points from kMost.
    static constexpr std::uint32_t kMost = TriangleFours::kMost;
    [[nodiscard]] static bool is_point(std::uint32_t candidate) noexcept { return candidate >= kMost; }

    enum class Gathered : std::uint8_t {
        all,
        too_many_triangles,  // more than wanted: the caller retries with a shorter segment
        too_many_points,     // likewise, or with a greater stride
        out_of_looks,        // the tick's work budget is used up
    };

    struct Query {
        Way way;
        double radius = 0.0, slack = 0.0;
        geometry::Fineness fineness;
        std::uint32_t most_triangles = kMost, most_points = kMost;  // at most kMost
    };

    Candidates() noexcept {}

    // Gathers what is within radius + slack of the segment. Counts looks_left down by the bounding boxes checked.
    [[nodiscard]] Gathered gather(const geometry::PosedSurface& surface, const Query& query,
                                  std::uint32_t& looks_left) noexcept;

    // Whether the candidates include everything that a ball around this centre may touch.
    [[nodiscard]] bool covers(const Vec3& center) const noexcept {
        return slack_ >= 0.0 && distance2(way_, center) <= slack_ * slack_ * (1.0 + 1e-9);
    }
    [[nodiscard]] std::uint32_t triangles() const noexcept { return fours_.count(); }
    [[nodiscard]] std::uint32_t points() const noexcept { return points_.count(); }
    [[nodiscard]] const geometry::Triangle& triangle(std::uint32_t candidate) const noexcept {
        return triangles_[candidate];
    }
    [[nodiscard]] std::uint32_t id(std::uint32_t candidate) const noexcept { return ids_[candidate]; }
    [[nodiscard]] bool two_sided(std::uint32_t candidate) const noexcept { return two_sided_[candidate]; }
    [[nodiscard]] const geometry::SurfacePoint& point(std::uint32_t candidate) const noexcept {
        return points_[candidate - kMost];
    }
    // Number of times that the distances of four triangles were computed since gather().
    [[nodiscard]] std::uint32_t fours_measured() const noexcept { return fours_.measured(); }
    void measure_at_most(std::uint32_t fours) noexcept { fours_.measure_at_most(fours); }

    // Calls visit(candidate) for the candidates within reach of a covered centre, and for those beyond by no more than
    // rounding. Stops and returns false when visit returns false.
    template <typename Visit>
    bool for_each_at(const Vec3& center, double reach, Visit&& visit) {
        return fours_.for_each_at(center, reach, visit) &&
               points_.for_each_near(center, center, reach, [&](std::uint32_t i) { return visit(kMost + i); });
    }
    // Calls visit(candidate) for the candidates that the ball may meet from outside as it moves between covered
    // centres, and for a few more. Stops and returns false when visit returns false.
    template <typename Visit>
    bool for_each_on_way(const Way& way, double radius, Visit&& visit) {
        return fours_.for_each_on_way(way.from, way.to, radius, visit) &&
               points_.for_each_near(way.from, way.to, radius, [&](std::uint32_t i) { return visit(kMost + i); });
    }

private:
    Way way_;
    double slack_ = -1.0;  // negative: nothing is covered
    TriangleFours fours_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<bool, kMost> two_sided_;
    std::array<geometry::Triangle, kMost> triangles_;
    PointFours points_;
};

}  // namespace burin::haptics
