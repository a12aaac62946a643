// SPDX-License-Identifier: MIT
// Poses, vectors and scales in which nothing is zero, one, equal or a multiple of another. A test whose body is not
// turned, whose axes are alike or whose scale is 1 cannot see that two axes are exchanged, that a vector is given in
// the wrong frame, or that a turn is forgotten. Take these wherever a test needs any pose at all.
//
// Metres and radians, right-handed. The same sequence in every run: entry i of each table belongs to index i of what is
// tested (stylus 0 and 1, wand 0 and 1, finger 0 to 3), so that the second is never the first one's copy.
#pragma once

#include "base/space.hpp"

#include <array>
#include <cstddef>

#include <glm/gtc/quaternion.hpp>

namespace burin {

inline constexpr std::size_t kUnevenPoses = 5;

// Other than 1, and other than each other's inverse.
inline constexpr std::array<double, kUnevenPoses> kUnevenScales{1.7, 0.6, 2.3, 0.45, 1.3};

// Returns a vector of some centimetres; its components differ in size and not all in sign.
[[nodiscard]] inline Vec3 uneven_offset(std::size_t index) {
    static constexpr std::array<std::array<double, 3>, kUnevenPoses> kOffsets{{{0.031, -0.017, 0.046},
                                                                               {-0.023, 0.052, 0.011},
                                                                               {0.013, 0.029, -0.037},
                                                                               {-0.041, -0.019, 0.007},
                                                                               {0.059, -0.043, -0.027}}};
    const std::array<double, 3>& at = kOffsets[index % kUnevenPoses];
    return {at[0], at[1], at[2]};
}

// Returns a unit vector that lies in no coordinate plane and at no equal angles to two axes.
[[nodiscard]] inline Vec3 uneven_direction(std::size_t index) { return glm::normalize(uneven_offset(index)); }

// Returns a turn of 0.5 to 2.6 rad about a slanted axis; no two of its four components are equal in size.
[[nodiscard]] inline Quat uneven_turn(std::size_t index) {
    static constexpr std::array<double, kUnevenPoses> kAngles_rad{0.9, 2.1, 1.4, 0.5, 2.6};
    return glm::angleAxis(kAngles_rad[index % kUnevenPoses], uneven_direction(index + 1));
}

[[nodiscard]] inline Pose uneven_pose(std::size_t index) {
    return {.position_m = uneven_offset(index), .orientation = uneven_turn(index)};
}

}  // namespace burin
