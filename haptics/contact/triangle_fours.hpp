// SPDX-License-Identifier: MIT
// Many triangles that a ball may touch, four at a time in float: which of them are within a distance, or may be met on
// a way, before any is tested exactly.
//
// Each triangle is stored with its plane, its bounding ball and its edges. Plane and bounding ball give a lower bound
// of the distance by a few products, which rules out most; for the rest the distance is computed, exact but for
// rounding. It is remembered together with the length that the ball has travelled since: a triangle that is farther off
// than what the ball has moved since it was measured is not looked at again.
// Frame: positions relative to an origin near the ball, metres. No heap, lock, throw.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/contact/lanes.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::haptics {

// Four triangles, one a lane.
struct TriangleFour {
    geometry::Vec3Lanes normal;  // unit, of the plane
    geometry::Lanes height;      // of the origin above the plane
    geometry::Vec3Lanes middle;  // of the bounding ball
    geometry::Lanes radius;
    geometry::Vec3Lanes corner, u, v;  // a corner, and the edges from it
    geometry::Lanes rounding;          // bound on the rounding error of a distance
    // The ball's centre cannot come nearer to the triangle than this minus the length that it has travelled.
    geometry::Lanes clear_until;
    geometry::LaneMask two_sided;

    [[nodiscard]] geometry::Lanes height_at(const geometry::Vec3Lanes& at) const {
        return height + geometry::dot(normal, at);
    }
    // Squared distance between the bounding ball's centre and the foot of `at` on the plane, reduced by the rounding
    // error.
    [[nodiscard]] geometry::Lanes aside2(const geometry::Vec3Lanes& at, geometry::Lanes height_there) const {
        const geometry::Vec3Lanes off = middle - at;
        return geometry::dot(off, off) * (1.0f - 4e-6f) - height_there * height_there;
    }
    // Lower bound of the distance from `at`: inside all three edges the height above the plane, else the distance from
    // the nearest edge. Exact but for rounding where it is about `likely`, which spares a square root: of sqrt(x), the
    // geometric mean of x / s and s, their harmonic mean 2 x s / (x + s^2) is a lower bound.
    [[nodiscard]] geometry::Lanes distance(const geometry::Vec3Lanes& at, float likely) const {
        const geometry::Vec3Lanes w = at - corner, e = v - u, we = w - u;
        const geometry::Lanes uu = geometry::dot(u, u), uv = geometry::dot(u, v), vv = geometry::dot(v, v);
        const geometry::Lanes wu = geometry::dot(w, u), wv = geometry::dot(w, v);
        const geometry::Lanes along_u = vv * wu - uv * wv, along_v = uu * wv - uv * wu, area = uu * vv - uv * uv;
        const geometry::LaneMask inside = (along_u >= 0.0f) & (along_v >= 0.0f) & (along_u + along_v <= area);
        const geometry::Lanes above = height_at(at);
        const geometry::Lanes edges2 =
            geometry::lesser(geometry::lesser(from_edge2(w, u, wu, uu), from_edge2(w, v, wv, vv)),
                             from_edge2(we, e, geometry::dot(we, e), geometry::dot(e, e)));
        const geometry::Lanes distance2 = inside != 0 ? above * above : edges2;
        return distance2 * (2.0f * likely) / (distance2 + likely * likely) - rounding;
    }

private:
    // Squared distance from an edge; w from its beginning, along = w . edge, length2 = edge . edge.
    [[nodiscard]] static geometry::Lanes from_edge2(const geometry::Vec3Lanes& w, const geometry::Vec3Lanes& edge,
                                                    geometry::Lanes along, geometry::Lanes length2) {
        const geometry::Lanes share = geometry::lesser(geometry::greater(along, geometry::Lanes{}), length2) / length2;
        const geometry::Vec3Lanes off = w - share * edge;
        return geometry::dot(off, off);
    }
};

// Bounding ball of a triangle.
struct TriangleBall {
    Vec3f middle;
    float size2;  // squared radius
};

class TriangleFours {
public:
    static constexpr std::uint32_t kMost = 4096, kNoLimit = 0xffffffffu;

    // Leaves the array uninitialized: zeroing it would cost more than filling it.
    TriangleFours() noexcept {}

    // Forgets all triangles. Only distances up to reach_m from the ball's ways will matter; rounding errors follow from
    // that. The triangles' usual size makes the bounds tight for most.
    void begin(const Vec3& origin, double reach_m, double usual_edge_m) noexcept;
    [[nodiscard]] TriangleBall ball_around(const geometry::Triangle& t) const noexcept;
    // Adds a triangle; count() must be below kMost.
    void add(const geometry::Triangle& t, const Vec3& unit_normal, const TriangleBall& ball, bool two_sided) noexcept;
    // Completes the last four, so that passes need not treat it separately. To be called after the last add().
    void end() noexcept;

    [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
    [[nodiscard]] float rounding() const noexcept { return rounding_; }
    // Number of times that the distances of four triangles were computed since begin().
    [[nodiscard]] std::uint32_t measured() const noexcept { return measured_; }
    // Lets the next queries compute so many at most; one that would need more stops and returns false.
    void measure_at_most(std::uint32_t count) noexcept {
        most_measured_ = count < kNoLimit - measured_ ? measured_ + count : kNoLimit;
    }

    // Calls visit(i) for the triangles within reach of a centre, and for those beyond by no more than rounding. Stops
    // and returns false when visit returns false.
    template <typename Visit>
    bool for_each_at(const Vec3& center, double reach, Visit&& visit) {
        go_to(center);
        const geometry::Vec3Lanes at = place(center);
        const float limit = static_cast<float>(reach) + rounding_;
        const Weights<2> of = weights<2>({std::fmin(limit, size_), size_});
        return for_each_of(
            [&](TriangleFour& four) {
                geometry::LaneMask near = four.clear_until - travel_ <= limit;
                if (!geometry::any(near)) return near;
                const geometry::Lanes height = four.height_at(at), beyond2 = limit * limit - height * height;
                const geometry::Lanes room2 = of[0] * beyond2 + of[1] * (four.radius * four.radius);
                near &= (beyond2 >= 0.0f) & (four.aside2(at, height) <= room2);
                return geometry::any(near) ? near & (measure(four, at, limit) <= limit) : near;
            },
            visit);
    }

    // Calls visit(i) for the triangles that the ball may meet from outside as it moves straight from one centre to
    // another, and for a few more. Stops and returns false when visit returns false. A plane on whose inner side the
    // ball stays cannot be touched. A touched point q lies ahead and near enough: |c + t m - q| = r and
    // (c + t m - q) m <= 0 with t <= 1 give |q - c|^2 - r^2 <= 2 (q - c) m. The distance changes by at most what the
    // ball moves, so between distances d and e at both ends of the way, of length l, it is nowhere less than
    // (d + e - l) / 2.
    template <typename Visit>
    bool for_each_on_way(const Vec3& from, const Vec3& to, double radius, Visit&& visit) {
        go_to(from);
        const geometry::Vec3Lanes start = place(from), end = place(to), halfway = place(0.5 * (from + to));
        const geometry::Vec3Lanes motion = end - start;
        const float limit = static_cast<float>(radius) + rounding_;
        const float length = static_cast<float>(glm::length(to - from)) + rounding_;
        const float rounding2 = 4.0f * rounding_ * (limit + length);
        const Weights<3> of = weights<3>({std::fmin(limit, size_), size_, 0.5f * length});
        return for_each_of(
            [&](TriangleFour& four) {
                geometry::LaneMask near = four.clear_until - travel_ <= limit + length;
                if (!geometry::any(near)) return near;
                const geometry::Lanes at_start = four.height_at(start), at_end = four.height_at(end);
                const geometry::Lanes ahead =
                    geometry::dot(four.middle - start, motion) + (four.radius + rounding_) * length;
                const geometry::Lanes lower = geometry::lesser(at_start, at_end);
                const geometry::Lanes least = geometry::greater(lower, geometry::Lanes{}),
                                      beyond2 = limit * limit - least * least;
                const geometry::Lanes room2 =
                    of[0] * beyond2 + of[1] * (four.radius * four.radius) + of[2] * (0.25f * length * length);
                near &= four.two_sided | ((lower <= limit) & ((at_start >= -rounding_) | (at_end >= -rounding_)) &
                                          (at_start * at_start - limit * limit <= 2.0f * ahead + rounding2) &
                                          (four.aside2(halfway, 0.5f * (at_start + at_end)) <= room2));
                near &= ahead >= 0.0f;
                if (!geometry::any(near)) return near;
                const geometry::Lanes here = measure(four, start, limit);
                near &= here <= limit + length;
                return geometry::any(near) ? near & (here + four.distance(end, limit) <= 2.0f * limit + length) : near;
            },
            visit);
    }

private:
    template <std::size_t kCount>
    using Weights = std::array<float, kCount>;

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
    [[nodiscard]] geometry::Vec3Lanes place(const Vec3& at) const {
        return geometry::in_all_lanes(Vec3f(at - origin_));
    }
    // Adds the way to `center` to the length travelled.
    void go_to(const Vec3& center) noexcept {
        travel_ += static_cast<float>(glm::length(center - center_)) * 1.000001f;
        center_ = center;
    }
    [[nodiscard]] geometry::Lanes measure(TriangleFour& four, const geometry::Vec3Lanes& at, float likely) {
        ++measured_;
        const geometry::Lanes distance = four.distance(at, likely);
        four.clear_until = distance + travel_;
        return distance;
    }
    // Tests four at a time, and visits single ones only where the test holds.
    template <typename IsNear, typename Visit>
    bool for_each_of(IsNear&& is_near, Visit&& visit) {
        for (std::uint32_t first = 0; first < count_; first += geometry::kLanes) {
            if (measured_ >= most_measured_) return false;
            const geometry::LaneMask near = is_near(fours_[first / geometry::kLanes]);
            if (!geometry::any(near)) continue;
            for (std::uint32_t k = 0; k < geometry::kLanes; ++k)
                if (near[k] != 0 && !visit(first + k)) return false;
        }
        return true;
    }

    Vec3 origin_{0.0};
    float rounding_ = 0.0f;  // bound on the rounding error of a height
    float size_ = 0.0f;      // usual radius of the bounding balls
    Vec3 center_{0.0};       // of the ball at the last query
    float travel_ = 0.0f;    // length of its way since begin()
    std::uint32_t count_ = 0, measured_ = 0, most_measured_ = kNoLimit;
    std::array<TriangleFour, kMost / geometry::kLanes> fours_;
};

}  // namespace burin::haptics
