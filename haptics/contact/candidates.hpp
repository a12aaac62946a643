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

#include "geometry/local_surface.hpp"

namespace burin {

struct Way {
    Vec3 from{0.0}, to{0.0};
};

// The distance of p from the way, squared.
[[nodiscard]] inline double distance2(const Way& way, const Vec3& p) noexcept {
    const Vec3 motion = way.to - way.from, off = p - way.from;
    const double length2 = glm::dot(motion, motion);
    const double along = length2 > 0.0 ? std::fmin(1.0, std::fmax(0.0, glm::dot(off, motion) / length2)) : 0.0;
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
        const Vec3f off(center - way_.from);
        const float limit = static_cast<float>(reach) + rounding_;
        return for_each_of(
            [&](std::uint32_t i) {
                const float height = height_at(i, off), beyond2 = limit * limit - height * height;
                const float room2 = 2.0f * (beyond2 + size_[i] * size_[i]);  // at least (sqrt(beyond2) + size)^2
                return static_cast<unsigned>(beyond2 >= 0.0f) & static_cast<unsigned>(aside2(i, off, height) <= room2);
            },
            visit);
    }

    // visit(i) of those that the ball comes to on its way between covered centres, from outside, and of a few more. A
    // plane that it stays on the inner side of cannot be touched.
    template <typename Visit>
    bool for_each_on_way(const Way& way, double radius, Visit&& visit) const {
        const Vec3f off(way.from - way_.from), end(way.to - way_.from), middle = 0.5f * (off + end);
        const float limit = static_cast<float>(radius) + rounding_, half2 = 0.25f * glm::dot(end - off, end - off);
        return for_each_of(
            [&](std::uint32_t i) {
                const float at_start = height_at(i, off), at_end = height_at(i, end);
                const float lower = at_start < at_end ? at_start : at_end;
                const float least = lower > 0.0f ? lower : 0.0f, beyond2 = limit * limit - least * least;
                // at least the square of the sum of the three roots
                const float room2 = 3.0f * (beyond2 + size_[i] * size_[i] + half2);
                return static_cast<unsigned>(lower <= limit) &
                       (static_cast<unsigned>(at_start >= -rounding_) | static_cast<unsigned>(at_end >= -rounding_)) &
                       static_cast<unsigned>(aside2(i, middle, 0.5f * (at_start + at_end)) <= room2);
            },
            visit);
    }

private:
    static constexpr std::uint32_t kBlock = 8;

    [[nodiscard]] float height_at(std::uint32_t i, const Vec3f& off) const {
        return height_[i] + normal_x_[i] * off.x + normal_y_[i] * off.y + normal_z_[i] * off.z;
    }
    // How far the ball around the triangle has its middle from the foot of a centre on the plane, squared; less its rounding.
    [[nodiscard]] float aside2(std::uint32_t i, const Vec3f& off, float height) const {
        const float x = middle_x_[i] - off.x, y = middle_y_[i] - off.y, z = middle_z_[i] - off.z;
        const float distance2 = x * x + y * y + z * z;
        return distance2 * (1.0f - 4e-6f) - height * height;
    }
    // In a form that the compiler makes vectors of: eight at a time, and a closer look only where there is one.
    template <typename Near, typename Visit>
    bool for_each_of(Near&& near, Visit&& visit) const {
        for (std::uint32_t block = 0; block < count_; block += kBlock) {
            std::array<unsigned, kBlock> is_near;
            unsigned any = 0;
            for (std::uint32_t k = 0; k < kBlock; ++k) {
                is_near[k] = near(block + k);
                any |= is_near[k];
            }
            if (any == 0) continue;
            for (std::uint32_t k = 0; k < kBlock; ++k)
                if (is_near[k] != 0 && !visit(block + k)) return false;
        }
        return true;
    }
    void add(std::uint32_t id, const Triangle& t, const Vec3& unit_normal) noexcept;
    void fill_last_block() noexcept;

    Way way_;
    double slack_ = -1.0;   // nothing is covered
    float rounding_ = 0.0;  // of a height
    std::uint32_t count_ = 0;
    // Of the planes: unit normal, and height of way_.from above it. One array each, to be read four at a time.
    std::array<float, kMost + kBlock> normal_x_, normal_y_, normal_z_, height_;
    // Of the balls around them, from way_.from: middle, and radius.
    std::array<float, kMost + kBlock> middle_x_, middle_y_, middle_z_, size_;
    std::array<std::uint32_t, kMost> ids_;
    std::array<Triangle, kMost> triangles_;
};

}  // namespace burin
