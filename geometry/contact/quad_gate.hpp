// SPDX-License-Identifier: MIT
// The coarse test of a search on the quads of a tile, four at a time, in float: by their boxes, by their distance from
// the segment of the search and by their planes (Near::by_way).
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/contact/lanes.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

// Four quads by their corners. The triangles of each are (a, p, q) and (a, p, d), with their corners in some order.
struct FourQuads {
    Vec3Lanes a, p, q, d;
};

// Tells which triangles of four quads are within reach, and passes some a little beyond it too, because of rounding.
class QuadGate {
public:
    struct Passed {
        LaneMask first{}, second{};
        LaneMask sound_first{}, sound_second{};  // certainly not degenerate
    };

    // No edge or diagonal of a quad is longer than longest_edge_m; most are about as long as usual_edge_m.
    QuadGate(const Near& near, double longest_edge_m, double usual_edge_m) noexcept
        : by_way_(near.by_way),
          lo_(in_all_lanes(Vec3f(near.lo))),
          hi_(in_all_lanes(Vec3f(near.hi))),
          from_(in_all_lanes(Vec3f(near.from))),
          longest_edge_m_(longest_edge_m) {
        const Vec3 motion = near.to - near.from;
        const double length2 = glm::dot(motion, motion);
        motion_ = in_all_lanes(Vec3f(motion));
        // For a segment this short the box is no larger than the segment's own neighbourhood.
        is_long_ = near.by_way && length2 > 0.25 * near.reach_m * near.reach_m;
        if (is_long_) by_length2_ = in_all_lanes(Vec3f(motion / length2));
        length_m_ = std::sqrt(length2);
        const Vec3 size =
            glm::max(glm::max(glm::abs(near.lo), glm::abs(near.hi)), glm::max(glm::abs(near.from), glm::abs(near.to)));
        rounding_m_ = 4e-7 * std::max({size.x, size.y, size.z});
        half_m_ = 0.7 * usual_edge_m;
        reach(near);
    }

    // Adopts the new near.reach_m; to be called when it has become smaller.
    void reach(const Near& near) noexcept {
        reach_m_ = near.reach_m;
        const double reach = (near.reach_m + rounding_m_) * (1.0 + 1e-6), reach2 = reach * reach;
        box_reach2_ = static_cast<float>(reach2);
        // (a + b)^2 <= (1 + s) a^2 + (1 + 1 / s) b^2, for the reach and half a diagonal, with the best s for the usual
        // edge.
        const double s = std::clamp(half_m_ / std::max(reach, 1e-30), 1e-3, 1e3);
        way_reach2_ = static_cast<float>((1.0 + s) * reach2 * (1.0 + 1e-5));
        way_half2_ = static_cast<float>((1.0 + 1.0 / s) * (1.0 + 1e-5));
        // The same inequality with s = 1e-3, for the reach and for the rounding of heights times twice the area, which
        // is at most 6e-7 of the longest edge squared times the distance from the segment.
        const double rounding = 6e-7 * longest_edge_m_ * longest_edge_m_ * (reach + length_m_ + longest_edge_m_);
        plane_reach2_ = static_cast<float>(1.001 * reach2);
        plane_rounding2_ = static_cast<float>(1001.0 * rounding * rounding);
    }
    [[nodiscard]] bool reaches_as_far_as(const Near& near) const noexcept { return reach_m_ == near.reach_m; }

    // Tests the quads of the lanes in `asked`.
    [[nodiscard]] Passed look(const FourQuads& quads, LaneMask asked) const noexcept {
        const Vec3Lanes lo = lesser(lesser(quads.a, quads.p), lesser(quads.q, quads.d));
        const Vec3Lanes hi = greater(greater(quads.a, quads.p), greater(quads.q, quads.d));
        const Vec3Lanes zero{}, outside = greater(greater(lo - hi_, lo_ - hi), zero);
        LaneMask met = asked & (dot(outside, outside) <= box_reach2_);
        if (is_long_) met &= beside_way(lo, hi);
        if (!any(met)) return {};
        const Vec3Lanes ap = quads.p - quads.a, aq = quads.q - quads.a, ad = quads.d - quads.a;
        const Vec3Lanes first = cross(ap, aq), second = cross(ap, ad);
        const Lanes first2 = dot(first, first), second2 = dot(second, second);
        Passed passed{met, met, {}, {}};
        if (by_way_) {
            const Vec3Lanes to_from = from_ - quads.a;
            passed.first &= plane_met(first, first2, to_from);
            passed.second &= plane_met(second, second2, to_from);
        }
        const Lanes ap2 = dot(ap, ap);
        passed.sound_first = sound(first2, ap2, aq, quads.q - quads.p);
        passed.sound_second = sound(second2, ap2, ad, quads.d - quads.p);
        return passed;
    }

private:
    // Tests the ball around each box against the segment.
    [[nodiscard]] LaneMask beside_way(const Vec3Lanes& lo, const Vec3Lanes& hi) const noexcept {
        const Vec3Lanes size = hi - lo, off = Lanes{0.5f, 0.5f, 0.5f, 0.5f} * (lo + hi) - from_;
        const Lanes one{1.0f, 1.0f, 1.0f, 1.0f};
        const Lanes share = lesser(greater(dot(off, by_length2_), Lanes{}), one);
        const Vec3Lanes across = off - share * motion_;
        return dot(across, across) <= way_reach2_ + 0.25f * way_half2_ * dot(size, size);
    }
    // Tests the heights of the segment's ends above each plane, multiplied by the normal's length.
    [[nodiscard]] LaneMask plane_met(const Vec3Lanes& normal, Lanes normal2, const Vec3Lanes& to_from) const noexcept {
        const Lanes at_start = dot(normal, to_from), at_end = at_start + dot(normal, motion_);
        const Lanes limit = plane_reach2_ * normal2 + plane_rounding2_;
        return ~((at_start * at_end > 0.0f) & (at_start * at_start > limit) & (at_end * at_end > limit));
    }
    // Tests as is_degenerate does, with ten times its limit: float is wrong by 2.4e-7 of the longest edge squared, and
    // the root of the limit is 1e-5.
    [[nodiscard]] static LaneMask sound(Lanes cross2, Lanes edge2, const Vec3Lanes& u, const Vec3Lanes& v) noexcept {
        const Lanes longest2 = greater(edge2, greater(dot(u, u), dot(v, v)));
        return cross2 > 1e-9f * longest2 * longest2;
    }

    bool by_way_, is_long_ = false;
    Vec3Lanes lo_, hi_, from_, motion_{}, by_length2_{};
    double longest_edge_m_, length_m_ = 0.0, rounding_m_ = 0.0, half_m_ = 0.0, reach_m_ = 0.0;
    float box_reach2_ = 0.0f, way_reach2_ = 0.0f, way_half2_ = 0.0f, plane_reach2_ = 0.0f, plane_rounding2_ = 0.0f;
};

}  // namespace burin::geometry
