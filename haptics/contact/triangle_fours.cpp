// SPDX-License-Identifier: MIT
#include "haptics/contact/triangle_fours.hpp"

#include <algorithm>

namespace burin::haptics {
namespace {

void set(geometry::Vec3Lanes& lanes, std::size_t lane, const Vec3f& value) {
    lanes.x[lane] = value.x, lanes.y[lane] = value.y, lanes.z[lane] = value.z;
}

}  // namespace

void TriangleFours::begin(const Vec3& origin, double reach_m, double usual_edge_m) noexcept {
    origin_ = center_ = origin;
    // Only heights up to the reach matter; float rounds each of their four terms by 6e-8 of its size.
    rounding_ = static_cast<float>(4e-7 * reach_m);
    size_ = static_cast<float>(0.6 * usual_edge_m);  // circumscribed ball of an equilateral triangle
    travel_ = 0.0f;
    count_ = measured_ = 0;
    most_measured_ = kNoLimit;
}

TriangleBall TriangleFours::ball_around(const geometry::Triangle& t) const noexcept {
    const Vec3f a(t.a - origin_), b(t.b - origin_), c(t.c - origin_);
    const Vec3f middle = (a + b + c) * (1.0f / 3.0f), to_a = a - middle, to_b = b - middle, to_c = c - middle;
    const float size2 = std::max({glm::dot(to_a, to_a), glm::dot(to_b, to_b), glm::dot(to_c, to_c)});
    return {middle, size2 * 1.00002f};
}

// The lanes decide in float whether a foot lies inside an edge. Where that is uncertain, by the rounding of coordinates
// over the sine of the triangle's angle, the distance is uncertain by as much; slivers are thus left to the exact test.
void TriangleFours::add(const geometry::Triangle& t, const Vec3& unit_normal, const TriangleBall& ball,
                        bool two_sided) noexcept {
    TriangleFour& four = fours_[count_ / geometry::kLanes];
    const std::size_t lane = count_++ % geometry::kLanes;
    const Vec3f u(t.b - t.a), v(t.c - t.a);
    const float size = std::sqrt(ball.size2) * 1.000001f;
    set(four.normal, lane, Vec3f(unit_normal));
    four.height[lane] = static_cast<float>(glm::dot(origin_ - t.a, unit_normal));
    set(four.middle, lane, ball.middle);
    four.radius[lane] = size;
    set(four.corner, lane, Vec3f(t.a - origin_));
    set(four.u, lane, u);
    set(four.v, lane, v);
    const Vec3f twice_area = glm::cross(u, v);
    const float sine2 = glm::dot(twice_area, twice_area) / (glm::dot(u, u) * glm::dot(v, v));
    four.rounding[lane] = rounding_ + 1e-6f * (2.5e6f * rounding_ + size) / std::sqrt(sine2);
    four.clear_until[lane] = 0.0f;
    four.two_sided[lane] = two_sided ? -1 : 0;
}

void TriangleFours::end() noexcept {
    for (std::uint32_t i = count_; i % geometry::kLanes != 0; ++i) {
        TriangleFour& four = fours_[i / geometry::kLanes];
        const std::size_t lane = i % geometry::kLanes;
        for (geometry::Vec3Lanes* lanes : {&four.normal, &four.middle, &four.corner, &four.u, &four.v})
            set(*lanes, lane, Vec3f(0.0f));
        four.height[lane] = four.clear_until[lane] = HUGE_VALF;
        four.radius[lane] = four.rounding[lane] = 0.0f;
        four.two_sided[lane] = 0;
    }
}

}  // namespace burin::haptics
