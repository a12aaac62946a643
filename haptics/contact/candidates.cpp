// SPDX-License-Identifier: MIT
#include "haptics/contact/candidates.hpp"

#include <algorithm>

#include "geometry/contact/local_surface_search.hpp"

namespace burin::haptics {

Candidates::Ball Candidates::ball_around(const geometry::Triangle& t) const noexcept {
    const Vec3f a(t.a - way_.from), b(t.b - way_.from), c(t.c - way_.from);
    const Vec3f middle = (a + b + c) * (1.0f / 3.0f), to_a = a - middle, to_b = b - middle, to_c = c - middle;
    const float size2 = std::max({glm::dot(to_a, to_a), glm::dot(to_b, to_b), glm::dot(to_c, to_c)});
    return {middle, size2 * 1.00002f};
}

// The lanes decide in float whether a foot lies inside an edge. Where that is uncertain, by an angle's sine times the
// rounding of coordinates, the distance is uncertain by as much; slivers are thus left to the exact test.
void Candidates::add(std::uint32_t id, const geometry::Triangle& t, const Vec3& unit_normal,
                     const Ball& ball) noexcept {
    Four& four = fours_[count_ / geometry::kLanes];
    const std::size_t lane = count_ % geometry::kLanes;
    const Vec3f u(t.b - t.a), v(t.c - t.a);
    const float size = std::sqrt(ball.size2) * 1.000001f;
    set(four.normal, lane, Vec3f(unit_normal));
    four.height[lane] = static_cast<float>(glm::dot(way_.from - t.a, unit_normal));
    set(four.middle, lane, ball.middle);
    four.radius[lane] = size;
    four.clear_until[lane] = 0.0f;
    set(four.corner, lane, Vec3f(t.a - way_.from));
    set(four.u, lane, u);
    set(four.v, lane, v);
    const Vec3f twice_area = glm::cross(u, v);
    const float sine2 = glm::dot(twice_area, twice_area) / (glm::dot(u, u) * glm::dot(v, v));
    four.rounding[lane] = rounding_ + 1e-6f * (2.5e6f * rounding_ + size) / std::sqrt(sine2);
    ids_[count_] = id;
    triangles_[count_] = t;
    ++count_;
}

// Fills the last group of four with planes that nothing reaches, so that passes need not treat it separately.
void Candidates::fill_last_four() noexcept {
    for (std::uint32_t i = count_; i % geometry::kLanes != 0; ++i) {
        Four& four = fours_[i / geometry::kLanes];
        const std::size_t lane = i % geometry::kLanes;
        for (geometry::Vec3Lanes* lanes : {&four.normal, &four.middle, &four.corner, &four.u, &four.v})
            set(*lanes, lane, Vec3f(0.0f));
        four.height[lane] = four.clear_until[lane] = HUGE_VALF;
        four.radius[lane] = four.rounding[lane] = 0.0f;
    }
}

Candidates::Gathered Candidates::gather(const geometry::LocalSurface& surface, const Way& way, double radius,
                                        double slack, std::uint32_t& looks_left) noexcept {
    way_ = way;
    slack_ = -1.0;
    center_ = way.from;
    travel_ = 0.0f;
    count_ = 0;
    const double reach = radius + slack, reach2 = reach * reach;
    const Vec3 motion = way.to - way.from;
    const double length2 = glm::dot(motion, motion), length = std::sqrt(length2);
    // Only heights of at most reach + length matter; float rounds each of the four terms by 6e-8 of its size.
    rounding_ = static_cast<float>(4e-7 * (reach + length));
    size_ = static_cast<float>(0.6 * surface.mean_edge_m());  // circumscribed ball of an equilateral triangle
    const Vec3f along = Vec3f(motion), by_length2 = length2 > 0.0 ? along / static_cast<float>(length2) : Vec3f(0.0f);
    const float near_way = static_cast<float>(reach) + 4.0f * rounding_;
    const Weights<2> of = weights<2>({near_way, size_});
    // The bounding box of a long segment also holds triangles that are far from the segment.
    const auto beside = [&](const Ball& ball) {
        const float share = glm::dot(ball.middle, by_length2);
        const Vec3f off = ball.middle - (share < 0.0f ? 0.0f : (share > 1.0f ? 1.0f : share)) * along;
        return glm::dot(off, off) * (1.0f - 4e-6f) > of[0] * near_way * near_way + of[1] * ball.size2;
    };
    bool room = true;
    geometry::Near near{
        glm::min(way.from, way.to), glm::max(way.from, way.to), reach, looks_left, true, way.from, way.to};
    const bool complete =
        geometry::for_each_triangle_near(surface, near, [&](std::uint32_t id, const geometry::Triangle& t) {
            const Ball ball = ball_around(t);
            if (beside(ball)) return true;
            // Compares squares scaled by the normal's length, so that triangles too far away cost no square root.
            const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
            const double size2 = glm::dot(normal, normal);
            const double at_start = glm::dot(normal, way.from - t.a), at_end = at_start + glm::dot(normal, motion);
            const double limit = reach2 * size2;
            if (at_start * at_end > 0.0 && at_start * at_start > limit && at_end * at_end > limit) return true;
            if (count_ == kMost) return room = false;
            add(id, t, normal / std::sqrt(size2), ball);
            return true;
        });
    looks_left = near.looks_left;
    if (!room) return Gathered::too_many;
    if (!complete) return Gathered::out_of_looks;
    fill_last_four();
    slack_ = slack;
    return Gathered::all;
}

}  // namespace burin::haptics
