// SPDX-License-Identifier: MIT
// The triangles that a ball may touch in this tick: gathered from the surface once (broad phase), then tested in every
// step.
//
// Gathered along a straight segment with a slack: the set is complete for every ball centre within `slack` of the
// segment. Each triangle is stored with its plane and its bounding ball, in float, from which a lower bound of its
// distance from any centre takes a few products; this rules out most triangles before an exact test. Capacity is fixed:
// 440 kB on the stack, of which only the filled part is ever touched. Frame: relative to the surface's origin, metres.
// No heap, lock, throw.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/contact/lanes.hpp"
#include "geometry/contact/local_surface.hpp"

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
    static constexpr std::uint32_t kMost = 4096;

    enum class Gathered : std::uint8_t {
        all,
        too_many,      // more than kMost: the caller retries with a shorter segment
        out_of_looks,  // the tick's work budget is used up
    };

    // Leaves the arrays uninitialized: zeroing them would cost more than filling them.
    Candidates() noexcept {}

    // Gathers the triangles within radius + slack of the segment. Counts looks_left down by the bounding boxes checked.
    [[nodiscard]] Gathered gather(const geometry::LocalSurface& surface, const Way& way, double radius, double slack,
                                  std::uint32_t& looks_left) noexcept;

    // Whether the candidates include everything that a ball around this centre may touch.
    [[nodiscard]] bool covers(const Vec3& center) const noexcept {
        return slack_ >= 0.0 && distance2(way_, center) <= slack_ * slack_ * (1.0 + 1e-9);
    }
    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    [[nodiscard]] const geometry::Triangle& triangle(std::uint32_t i) const noexcept { return triangles_[i]; }
    [[nodiscard]] std::uint32_t id(std::uint32_t i) const noexcept { return ids_[i]; }

    // Calls visit(i) for the candidates within reach of a covered centre, and for a few beyond. Stops and returns false
    // when visit returns false.
    template <typename Visit>
    bool for_each_at(const Vec3& center, double reach, Visit&& visit) const {
        const geometry::Vec3Lanes at = place(center);
        const float limit = static_cast<float>(reach) + rounding_;
        const Weights<2> of = weights<2>({std::fmin(limit, size_), size_});
        return for_each_of(
            [&](const Four& four) {
                const geometry::Lanes height = four.height_at(at), beyond2 = limit * limit - height * height;
                const geometry::Lanes room2 = of[0] * beyond2 + of[1] * (four.radius * four.radius);
                return (beyond2 >= 0.0f) & (four.aside2(at, height) <= room2);
            },
            visit);
    }

    // Calls visit(i) for the candidates that the ball may meet from outside as it moves between covered centres, and
    // for a few more. Stops and returns false when visit returns false. A plane on whose inner side the ball stays
    // cannot be touched. A touched point q lies ahead and near enough: |c + t m - q| = r and (c + t m - q) m <= 0 with
    // t <= 1 give |q - c|^2 - r^2 <= 2 (q - c) m.
    template <typename Visit>
    bool for_each_on_way(const Way& way, double radius, Visit&& visit) const {
        const geometry::Vec3Lanes start = place(way.from), end = place(way.to),
                                  halfway = place(0.5 * (way.from + way.to));
        const geometry::Vec3Lanes motion = end - start;
        const float limit = static_cast<float>(radius) + rounding_;
        const float length = static_cast<float>(glm::length(way.to - way.from)) + rounding_;
        const float rounding2 = 4.0f * rounding_ * (limit + length);
        const Weights<3> of = weights<3>({std::fmin(limit, size_), size_, 0.5f * length});
        return for_each_of(
            [&](const Four& four) {
                const geometry::Lanes at_start = four.height_at(start), at_end = four.height_at(end);
                const geometry::Lanes ahead =
                    geometry::dot(four.middle - start, motion) + (four.radius + rounding_) * length;
                const geometry::Lanes lower = geometry::lesser(at_start, at_end);
                const geometry::Lanes least = geometry::greater(lower, geometry::Lanes{}),
                                      beyond2 = limit * limit - least * least;
                const geometry::Lanes room2 =
                    of[0] * beyond2 + of[1] * (four.radius * four.radius) + of[2] * (0.25f * length * length);
                return (lower <= limit) & ((at_start >= -rounding_) | (at_end >= -rounding_)) &
                       (at_start * at_start - limit * limit <= 2.0f * ahead + rounding2) & (ahead >= 0.0f) &
                       (four.aside2(halfway, 0.5f * (at_start + at_end)) <= room2);
            },
            visit);
    }

private:
    template <std::size_t kCount>
    using Weights = std::array<float, kCount>;

    // Four triangles, one a lane: unit normals of their planes, heights of way_.from above these planes, and bounding
    // balls with centres relative to way_.from.
    struct Four {
        geometry::Vec3Lanes normal;
        geometry::Lanes height;
        geometry::Vec3Lanes middle;
        geometry::Lanes radius;

        [[nodiscard]] geometry::Lanes height_at(const geometry::Vec3Lanes& at) const {
            return height + geometry::dot(normal, at);
        }
        // Squared distance between the bounding ball's centre and the foot of `at` on the plane, reduced by the
        // rounding error.
        [[nodiscard]] geometry::Lanes aside2(const geometry::Vec3Lanes& at, geometry::Lanes height_there) const {
            const geometry::Vec3Lanes off = middle - at;
            return geometry::dot(off, off) * (1.0f - 4e-6f) - height_there * height_there;
        }
        void set(std::size_t lane, const Vec3f& unit_normal, float height_m, const Vec3f& middle_m, float radius_m) {
            normal.x[lane] = unit_normal.x, normal.y[lane] = unit_normal.y, normal.z[lane] = unit_normal.z;
            height[lane] = height_m;
            middle.x[lane] = middle_m.x, middle.y[lane] = middle_m.y, middle.z[lane] = middle_m.z;
            radius[lane] = radius_m;
        }
    };

    // Converts a position to float lanes relative to way_.from.
    [[nodiscard]] geometry::Vec3Lanes place(const Vec3& at) const {
        return geometry::in_all_lanes(Vec3f(at - way_.from));
    }
    // Returns weights w_k with sum w_k x_k^2 >= (sum x_k)^2 for all x, nearly equal for x like `likely`
    // (Cauchy-Schwarz).
    template <std::size_t kCount>
    [[nodiscard]] static Weights<kCount> weights(const Weights<kCount>& likely) {
        float sum = 0.0f;
        for (const float x : likely) sum += x;
        Weights<kCount> shares, result;
        float all = 0.0f;
        for (std::size_t k = 0; k < kCount; ++k) all += shares[k] = likely[k] + 0.02f * sum;
        for (std::size_t k = 0; k < kCount; ++k) result[k] = all / shares[k];
        return result;
    }
    // Tests four candidates at a time, and visits single ones only where the test holds.
    template <typename Near, typename Visit>
    bool for_each_of(Near&& near, Visit&& visit) const {
        for (std::uint32_t first = 0; first < count_; first += geometry::kLanes) {
            const geometry::LaneMask is_near = near(fours_[first / geometry::kLanes]);
            if (!geometry::any(is_near)) continue;
            for (std::uint32_t k = 0; k < geometry::kLanes; ++k)
                if (is_near[k] != 0 && !visit(first + k)) return false;
        }
        return true;
    }
    // Bounding ball of a triangle, its centre relative to way_.from.
    struct Ball {
        Vec3f middle;
        float size2;
    };
    [[nodiscard]] Ball ball_around(const geometry::Triangle& t) const noexcept;
    void add(std::uint32_t id, const geometry::Triangle& t, const Vec3& unit_normal, const Ball& ball) noexcept;
    void fill_last_four() noexcept;

    Way way_;
    double slack_ = -1.0;   // negative: nothing is covered
    float rounding_ = 0.0;  // bound on the rounding error of a height
    float size_ = 0.0;      // typical radius of the triangles' bounding balls
    std::uint32_t count_ = 0;
    std::array<Four, kMost / geometry::kLanes> fours_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<geometry::Triangle, kMost> triangles_;
};

}  // namespace burin::haptics
