// SPDX-License-Identifier: MIT
// Many vertices of a finely meshed surface that a ball may touch (geometry/contact/surface_points.hpp), four at a time
// in float. Frame: positions relative to an origin near the ball, metres. No heap, lock, throw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/contact/surface_points.hpp"
#include "haptics/contact/static_vector.hpp"

namespace burin::haptics {

class PointFours {
public:
    static constexpr std::uint32_t kMost = 4096;

    PointFours() noexcept {}

    // Forgets all points. Distances up to reach_m will be asked for.
    void begin(const Vec3& origin, double reach_m) noexcept {
        origin_ = origin;
        rounding_ = static_cast<float>(4e-7 * reach_m);
        count_ = 0;
    }
    // Adds a point; count() must be below kMost.
    void add(const geometry::SurfacePoint& point) noexcept {
        set(count_, Vec3f(point.position - origin_));
        points_.put(count_++, point);
    }
    // Completes the last four with points that nothing reaches. To be called after the last add().
    void end() noexcept {
        for (std::uint32_t i = count_; i % geometry::kLanes != 0; ++i) set(i, Vec3f(1e15f));
    }

    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    [[nodiscard]] const geometry::SurfacePoint& operator[](std::uint32_t i) const noexcept { return points_[i]; }

    // Calls visit(i) for the points within reach of the way from one centre to another, and for those beyond by no more
    // than rounding. Stops and returns false when visit returns false.
    template <typename Visit>
    bool for_each_near(const Vec3& from, const Vec3& to, double reach, Visit&& visit) const {
        const geometry::Vec3Lanes start = geometry::in_all_lanes(Vec3f(from - origin_));
        const Vec3f way(to - from);
        const geometry::Vec3Lanes motion = geometry::in_all_lanes(way);
        const float length2 = glm::dot(way, way), per_length2 = length2 > 0.0f ? 1.0f / length2 : 0.0f;
        const float limit = static_cast<float>(reach) + 2.0f * rounding_;
        const geometry::Lanes limit2 = geometry::Lanes{} + limit * limit * 1.000001f, one = geometry::Lanes{} + 1.0f;
        for (std::uint32_t first = 0; first < count_; first += geometry::kLanes) {
            const geometry::Vec3Lanes off = fours_[first / geometry::kLanes] - start;
            const geometry::Lanes along = geometry::dot(off, motion) * per_length2;
            const geometry::Lanes share = geometry::lesser(geometry::greater(along, geometry::Lanes{}), one);
            const geometry::Vec3Lanes across = off - share * motion;
            const geometry::LaneMask near = geometry::dot(across, across) <= limit2;
            if (!geometry::any(near)) continue;
            for (std::uint32_t k = 0; k < geometry::kLanes; ++k)
                if (near[k] != 0 && !visit(first + k)) return false;
        }
        return true;
    }

private:
    void set(std::uint32_t i, const Vec3f& at) noexcept {
        geometry::Vec3Lanes& four = fours_[i / geometry::kLanes];
        const std::size_t lane = i % geometry::kLanes;
        four.x[lane] = at.x, four.y[lane] = at.y, four.z[lane] = at.z;
    }

    Vec3 origin_{0.0};
    float rounding_ = 0.0f;
    std::uint32_t count_ = 0;
    std::array<geometry::Vec3Lanes, kMost / geometry::kLanes> fours_;
    StaticVector<geometry::SurfacePoint, kMost> points_;
};

}  // namespace burin::haptics
