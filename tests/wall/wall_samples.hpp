// SPDX-License-Identifier: MIT
// What the tests of stereo geometry share: walls, heads and random poses.
#pragma once

#include <array>
#include <random>

#include "wall/wall.hpp"

namespace burin::wall {

inline Quat turned(double yaw, double pitch, double roll) {
    return glm::angleAxis(yaw, Vec3{0, 1, 0}) * glm::angleAxis(pitch, Vec3{1, 0, 0}) *
           glm::angleAxis(roll, Vec3{0, 0, 1});
}

inline Vec3 random_vector(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> value(-size, size);
    const double x = value(random), y = value(random), z = value(random);
    return {x, y, z};
}

inline Quat random_rotation(std::mt19937& random) {
    std::normal_distribution<double> value;
    const double w = value(random), x = value(random), y = value(random), z = value(random);
    return glm::normalize(Quat{w, x, y, z});
}

inline WallSetup powerwall() {
    WallSetup setup;
    setup.name = "wall";
    setup.screens = {WallScreen{.name = "front"}};
    setup.fallback_head_tracker = {{0.0, 1.6, 2.0}, Quat{1, 0, 0, 0}};
    setup.timing = {120.0, EyeOrder::left_first};
    return setup;
}

inline WallScreen screen_named(const std::string& name, const Vec3& lower_left, const Vec3& lower_right,
                               const Vec3& upper_left) {
    WallScreen s;
    s.name = name;
    s.output = name;
    s.lower_left_tracker = lower_left;
    s.lower_right_tracker = lower_right;
    s.upper_left_tracker = upper_left;
    s.pixels = {1080, 1080};
    return s;
}

// Three walls and a floor, 3 m each, open towards +Z; the front wall stands in the plane z = 0.
inline WallSetup cave() {
    WallSetup setup;
    setup.name = "cave";
    setup.screens = {screen_named("left", {-1.5, 0, 3}, {-1.5, 0, 0}, {-1.5, 3, 3}),
                     screen_named("front", {-1.5, 0, 0}, {1.5, 0, 0}, {-1.5, 3, 0}),
                     screen_named("right", {1.5, 0, 0}, {1.5, 0, 3}, {1.5, 3, 0}),
                     screen_named("floor", {-1.5, 0, 3}, {1.5, 0, 3}, {-1.5, 0, 0})};
    setup.fallback_head_tracker = {{0.0, 1.6, 1.5}, Quat{1, 0, 0, 0}};
    setup.timing = {120.0, EyeOrder::left_first};
    return setup;
}

inline const std::array<Pose, 10> kHeads{{{{0.0, 1.143, 2.0}, turned(0, 0, 0)},
                                          {{0.5, 1.6, 1.5}, turned(0, 0, 0)},
                                          {{-0.9, 1.7, 2.5}, turned(0.3, 0, 0)},
                                          {{1.4, 1.2, 0.6}, turned(-0.6, 0.1, 0)},
                                          {{0.0, 1.8, 2.9}, turned(0, -0.2, 0.1)},
                                          {{1.2, 1.5, 1.0}, turned(0.9, 0, 0)},
                                          {{-1.3, 0.9, 1.8}, turned(-0.4, 0.3, -0.2)},
                                          {{0.2, 2.0, 0.4}, turned(0, 0, 0.5)},
                                          {{0.1, 0.3, 1.5}, turned(2.2, 0.2, 0.2)},
                                          {{-0.3, 1.65, 2.1}, turned(0, 0, 1.5707963267948966)}}};

}  // namespace burin::wall
