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

    // Calls visit(i) for the candidates within reach of a covered centre, and for those beyond by no more than rounding.
    // Stops and returns false when visit returns false.
    template <typename Visit>
    bool for_each_at(const Vec3& center, double reach, Visit&& visit) {
        go_to(center);
        const geometry::Vec3Lanes at = place(center);
        const float limit = static_cast<float>(reach) + rounding_;
        const Weights<2> of = weights<2>({std::fmin(limit, size_), size_});
        return for_each_of(
            [&](Four& four) {
                geometry::LaneMask near = four.clear_until - travel_ <= limit;
                if (!geometry::any(near)) return near;
                const geometry::Lanes height = four.height_at(at), beyond2 = limit * limit - height * height;
                const geometry::Lanes room2 = of[0] * beyond2 + of[1] * (four.radius * four.radius);
                near &= (beyond2 >= 0.0f) & (four.aside2(at, height) <= room2);
                return geometry::any(near) ? near & (measure(four, at) <= limit) : near;
            },
            visit);
    }

    // Calls visit(i) for the candidates that the ball may meet from outside as it moves between covered centres, and
    // for a few more. Stops and returns false when visit returns false. A plane on whose inner side the ball stays
    // cannot be touched. A touched point q lies ahead and near enough: |c + t m - q| = r and (c + t m - q) m <= 0 with
    // t <= 1 give |q - c|^2 - r^2 <= 2 (q - c) m. The distance changes by at most what the ball moves, so between
    // distances d and e at both ends of the way, of length l, it is nowhere less than (d + e - l) / 2.
    template <typename Visit>
    bool for_each_on_way(const Way& way, double radius, Visit&& visit) {
        go_to(way.from);
        const geometry::Vec3Lanes start = place(way.from), end = place(way.to),
                                  halfway = place(0.5 * (way.from + way.to));
        const geometry::Vec3Lanes motion = end - start;
        const float limit = static_cast<float>(radius) + rounding_;
        const float length = static_cast<float>(glm::length(way.to - way.from)) + rounding_;
        const float rounding2 = 4.0f * rounding_ * (limit + length);
        const Weights<3> of = weights<3>({std::fmin(limit, size_), size_, 0.5f * length});
        return for_each_of(
            [&](Four& four) {
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
                near &= (lower <= limit) & ((at_start >= -rounding_) | (at_end >= -rounding_)) &
                        (at_start * at_start - limit * limit <= 2.0f * ahead + rounding2) & (ahead >= 0.0f) &
                        (four.aside2(halfway, 0.5f * (at_start + at_end)) <= room2);
                if (!geometry::any(near)) return near;
                const geometry::Lanes here = measure(four, start);
                near &= here <= limit + length;
                return geometry::any(near) ? near & (here + four.distance(end) <= 2.0f * limit + length) : near;
            },
            visit);
    }

    // Number of times that the distances of four triangles were computed since the start.
    [[nodiscard]] std::uint32_t fours_measured() const noexcept { return fours_measured_; }

private:
    template <std::size_t kCount>
    using Weights = std::array<float, kCount>;

    // Four triangles, one a lane, relative to way_.from: unit normals of their planes, heights of way_.from above these
    // planes, bounding balls, a corner and the two edges from it.
    struct Four {
        geometry::Vec3Lanes normal;
        geometry::Lanes height;
        geometry::Vec3Lanes middle;
        geometry::Lanes radius;
        // The ball's centre cannot come nearer to the triangle than this minus the length that it has travelled.
        geometry::Lanes clear_until;
        geometry::Vec3Lanes corner, u, v;
        geometry::Lanes rounding;  // bound on the rounding error of a distance

        [[nodiscard]] geometry::Lanes height_at(const geometry::Vec3Lanes& at) const {
            return height + geometry::dot(normal, at);
        }
        // Squared distance between the bounding ball's centre and the foot of `at` on the plane, reduced by the
        // rounding error.
        [[nodiscard]] geometry::Lanes aside2(const geometry::Vec3Lanes& at, geometry::Lanes height_there) const {
            const geometry::Vec3Lanes off = middle - at;
            return geometry::dot(off, off) * (1.0f - 4e-6f) - height_there * height_there;
        }
        // Lower bound of the distance from `at`, exact but for rounding. Inside all three edges it is the height above
        // the plane, else the distance from the nearest edge.
        [[nodiscard]] geometry::Lanes distance(const geometry::Vec3Lanes& at) const {
            const geometry::Vec3Lanes w = at - corner, e = v - u, we = w - u;
            const geometry::Lanes uu = geometry::dot(u, u), uv = geometry::dot(u, v), vv = geometry::dot(v, v);
            const geometry::Lanes wu = geometry::dot(w, u), wv = geometry::dot(w, v);
            const geometry::Lanes along_u = vv * wu - uv * wv, along_v = uu * wv - uv * wu, area = uu * vv - uv * uv;
            const geometry::LaneMask inside = (along_u >= 0.0f) & (along_v >= 0.0f) & (along_u + along_v <= area);
            const geometry::Lanes above = height_at(at);
            const geometry::Lanes edges2 =
                geometry::lesser(geometry::lesser(from_edge2(w, u, wu, uu), from_edge2(w, v, wv, vv)),
                                 from_edge2(we, e, geometry::dot(we, e), geometry::dot(e, e)));
            return square_root(inside != 0 ? above * above : edges2) - rounding;
        }
    };
    static void set(geometry::Vec3Lanes& lanes, std::size_t lane, const Vec3f& value) {
        lanes.x[lane] = value.x, lanes.y[lane] = value.y, lanes.z[lane] = value.z;
    }
    // Squared distance from an edge; w from its beginning, along = w . edge, length2 = edge . edge.
    [[nodiscard]] static geometry::Lanes from_edge2(const geometry::Vec3Lanes& w, const geometry::Vec3Lanes& edge,
                                                    geometry::Lanes along, geometry::Lanes length2) {
        const geometry::Lanes share = geometry::lesser(geometry::greater(along, geometry::Lanes{}), length2) / length2;
        const geometry::Vec3Lanes off = w - share * edge;
        return geometry::dot(off, off);
    }
    [[nodiscard]] static geometry::Lanes square_root(geometry::Lanes x) {
        for (std::size_t k = 0; k < geometry::kLanes; ++k) x[k] = std::sqrt(x[k]);
        return x;
    }

    // Adds the way to `center` to the length travelled.
    void go_to(const Vec3& center) noexcept {
        travel_ += static_cast<float>(glm::length(center - center_)) * 1.000001f;
        center_ = center;
    }
    // Computes the distances of four triangles from the ball's centre, and remembers how far it may travel before they
    // matter again.
    [[nodiscard]] geometry::Lanes measure(Four& four, const geometry::Vec3Lanes& at) {
        ++fours_measured_;
        const geometry::Lanes distance = four.distance(at);
        four.clear_until = distance + travel_;
        return distance;
    }

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
    bool for_each_of(Near&& near, Visit&& visit) {
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
    double slack_ = -1.0;  // negative: nothing is covered
    Vec3 center_{0.0};     // of the ball at the last query
    float travel_ = 0.0f;  // length of its way since gather()
    std::uint32_t fours_measured_ = 0;
    float rounding_ = 0.0;  // bound on the rounding error of a height
    float size_ = 0.0;      // typical radius of the triangles' bounding balls
    std::uint32_t count_ = 0;
    std::array<Four, kMost / geometry::kLanes> fours_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<geometry::Triangle, kMost> triangles_;
};

}  // namespace burin::haptics
