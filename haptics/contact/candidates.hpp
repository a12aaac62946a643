// SPDX-License-Identifier: MIT
// The triangles that a ball may come to touch in this tick: gathered from the surface once, then asked in every step.
//
// Gathered for a way and a slack: complete for every centre within `slack` of the straight way. Each triangle comes with its
// plane and a ball around it, in float, from which its least distance from any centre takes a few products: what tells most of them
// from those that need an exact look. Room is fixed; on the stack it takes 440 kB, of which only what is filled is ever touched.
// Frame: relative to the surface's origin, metres. No heap, lock, throw.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/lanes.hpp"
#include "geometry/local_surface.hpp"

namespace burin {

struct Way {
    Vec3 from{0.0}, to{0.0};
};

// The distance of p from the way, squared.
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
        too_many,      // no room: ask for a shorter way
        out_of_looks,  // the tick's work is used up
    };

    Candidates() noexcept {}  // leaves its room as it is: zeroing it would cost more than filling it

    // Those within radius + slack of the way. looks_left is counted down.
    [[nodiscard]] Gathered gather(const LocalSurface& surface, const Way& way, double radius, double slack,
                                  std::uint32_t& looks_left) noexcept;

    // Whether all is known that a ball around this centre may touch.
    [[nodiscard]] bool covers(const Vec3& center) const noexcept {
        return slack_ >= 0.0 && distance2(way_, center) <= slack_ * slack_ * (1.0 + 1e-9);
    }
    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    [[nodiscard]] const Triangle& triangle(std::uint32_t i) const noexcept { return triangles_[i]; }
    [[nodiscard]] std::uint32_t id(std::uint32_t i) const noexcept { return ids_[i]; }

    // visit(i) of those within reach of a covered centre, and of a few beyond. False when visit said so.
    template <typename Visit>
    bool for_each_at(const Vec3& center, double reach, Visit&& visit) const {
        const Vec3Lanes at = place(center);
        const float limit = static_cast<float>(reach) + rounding_;
        const Weights<2> of = weights<2>({std::fmin(limit, size_), size_});
        return for_each_of(
            [&](const Four& four) {
                const Lanes height = four.height_at(at), beyond2 = limit * limit - height * height;
                const Lanes room2 = of[0] * beyond2 + of[1] * (four.radius * four.radius);
                return (beyond2 >= 0.0f) & (four.aside2(at, height) <= room2);
            },
            visit);
    }

    // visit(i) of those that the ball comes to on its way between covered centres, from outside, and of a few more. A
    // plane that it stays on the inner side of cannot be touched. What is touched at a point q lies ahead, and near enough: from
    // |c + t m - q| = r and (c + t m - q) m <= 0 with t <= 1 follows |q - c|^2 - r^2 <= 2 (q - c) m.
    template <typename Visit>
    bool for_each_on_way(const Way& way, double radius, Visit&& visit) const {
        const Vec3Lanes start = place(way.from), end = place(way.to), halfway = place(0.5 * (way.from + way.to));
        const Vec3Lanes motion = end - start;
        const float limit = static_cast<float>(radius) + rounding_;
        const float length = static_cast<float>(glm::length(way.to - way.from)) + rounding_;
        const float rounding2 = 4.0f * rounding_ * (limit + length);
        const Weights<3> of = weights<3>({std::fmin(limit, size_), size_, 0.5f * length});
        return for_each_of(
            [&](const Four& four) {
                const Lanes at_start = four.height_at(start), at_end = four.height_at(end);
                const Lanes ahead = dot(four.middle - start, motion) + (four.radius + rounding_) * length;
                const Lanes lower = lesser(at_start, at_end);
                const Lanes least = greater(lower, Lanes{}), beyond2 = limit * limit - least * least;
                const Lanes room2 =
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

    // Of four triangles: the planes' unit normals, and heights of way_.from above them; the balls around them, from way_.from.
    struct Four {
        Vec3Lanes normal;
        Lanes height;
        Vec3Lanes middle;
        Lanes radius;

        [[nodiscard]] Lanes height_at(const Vec3Lanes& at) const { return height + dot(normal, at); }
        // How far the ball has its middle from the foot of a centre on the plane, squared; less its rounding.
        [[nodiscard]] Lanes aside2(const Vec3Lanes& at, Lanes height_there) const {
            const Vec3Lanes off = middle - at;
            return dot(off, off) * (1.0f - 4e-6f) - height_there * height_there;
        }
        void set(std::size_t lane, const Vec3f& unit_normal, float height_m, const Vec3f& middle_m, float radius_m) {
            normal.x[lane] = unit_normal.x, normal.y[lane] = unit_normal.y, normal.z[lane] = unit_normal.z;
            height[lane] = height_m;
            middle.x[lane] = middle_m.x, middle.y[lane] = middle_m.y, middle.z[lane] = middle_m.z;
            radius[lane] = radius_m;
        }
    };

    // From way_.from, as everything here.
    [[nodiscard]] Vec3Lanes place(const Vec3& at) const { return in_all_lanes(Vec3f(at - way_.from)); }
    // The w_k for which sum w_k x_k^2 is at least (sum x_k)^2 for any x, and little more for those like these (Cauchy and Schwarz).
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
    // Four at a time, and a closer look only where there is one.
    template <typename Near, typename Visit>
    bool for_each_of(Near&& near, Visit&& visit) const {
        for (std::uint32_t first = 0; first < count_; first += kLanes) {
            const LaneMask is_near = near(fours_[first / kLanes]);
            if (!any(is_near)) continue;
            for (std::uint32_t k = 0; k < kLanes; ++k)
                if (is_near[k] != 0 && !visit(first + k)) return false;
        }
        return true;
    }
    // The ball around a triangle, from way_.from.
    struct Ball {
        Vec3f middle;
        float size2;
    };
    [[nodiscard]] Ball ball_around(const Triangle& t) const noexcept;
    void add(std::uint32_t id, const Triangle& t, const Vec3& unit_normal, const Ball& ball) noexcept;
    void fill_last_four() noexcept;

    Way way_;
    double slack_ = -1.0;   // nothing is covered
    float rounding_ = 0.0;  // of a height
    float size_ = 0.0;      // of most balls around triangles
    std::uint32_t count_ = 0;
    std::array<Four, kMost / kLanes> fours_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<Triangle, kMost> triangles_;
};

}  // namespace burin
