// SPDX-License-Identifier: MIT
#include "haptics/contact/candidates.hpp"

#include <algorithm>

#include "geometry/local_surface_search.hpp"

namespace burin {

void Candidates::add(std::uint32_t id, const Triangle& t, const Vec3& unit_normal) noexcept {
    const Vec3f n(unit_normal);
    normal_x_[count_] = n.x;
    normal_y_[count_] = n.y;
    normal_z_[count_] = n.z;
    const Vec3f a(t.a - way_.from), b(t.b - way_.from), c(t.c - way_.from);
    height_[count_] = -glm::dot(a, n);
    const Vec3f middle = (a + b + c) * (1.0f / 3.0f), to_a = a - middle, to_b = b - middle, to_c = c - middle;
    middle_x_[count_] = middle.x;
    middle_y_[count_] = middle.y;
    middle_z_[count_] = middle.z;
    size_[count_] = std::sqrt(std::max({glm::dot(to_a, to_a), glm::dot(to_b, to_b), glm::dot(to_c, to_c)})) * 1.00001f;
    ids_[count_] = id;
    triangles_[count_] = t;
    ++count_;
}

// Planes that nothing reaches, so that a block of the passes is always whole.
void Candidates::fill_last_block() noexcept {
    for (std::uint32_t i = count_; i % kBlock != 0; ++i) {
        normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0f;
        height_[i] = HUGE_VALF;
        middle_x_[i] = middle_y_[i] = middle_z_[i] = size_[i] = 0.0f;
    }
}

Candidates::Gathered Candidates::gather(const LocalSurface& surface, const Way& way, double radius, double slack,
                                        std::uint32_t& looks_left) noexcept {
    way_ = way;
    slack_ = -1.0;
    count_ = 0;
    const double reach = radius + slack, reach2 = reach * reach;
    const Vec3 motion = way.to - way.from;
    const double length2 = glm::dot(motion, motion);
    // Heights are at most reach + length where they matter; float keeps 6e-8 of each of four terms.
    rounding_ = static_cast<float>(4e-7 * (reach + std::sqrt(length2)));
    // What is near the box around a long way need not be near the way.
    const bool is_long = length2 > 0.25 * radius * radius;
    const auto beside = [&](const Triangle& t) {
        const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
        const double limit = reach + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
        return distance2(way, 0.5 * (lo + hi)) > limit * limit;
    };
    bool room = true;
    Near near{glm::min(way.from, way.to), glm::max(way.from, way.to), reach, looks_left, true, way.from, way.to};
    const bool complete = for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle& t) {
        // All squared and times the normal's length, so that those too far cost no root.
        const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const double size2 = glm::dot(normal, normal);
        const double at_start = glm::dot(normal, way.from - t.a), at_end = at_start + glm::dot(normal, motion);
        const double limit = reach2 * size2;
        if (at_start * at_end > 0.0 && at_start * at_start > limit && at_end * at_end > limit) return true;
        if (is_long && beside(t)) return true;
        if (count_ == kMost) return room = false;
        add(id, t, normal / std::sqrt(size2));
        return true;
    });
    looks_left = near.looks_left;
    if (!room) return Gathered::too_many;
    if (!complete) return Gathered::out_of_looks;
    fill_last_block();
    slack_ = slack;
    return Gathered::all;
}

}  // namespace burin
