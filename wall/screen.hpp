// SPDX-License-Identifier: MIT
// Screens, heads and eyes with their positions in the world, as plain data, and whether screens overlap. Metres, world
// frame (base/space.hpp). Pure functions; any thread.
#pragma once

#include <cstdint>

#include "base/space.hpp"

namespace burin::wall {

// A flat upright wall that stands on the floor line in the plane z = 0, the middle of its lower edge at the world's
// origin.
// The default is the 10 by 7.5 ft wall.
struct Wall {
    double width_m = 3.048;
    double height_m = 2.286;

    bool operator==(const Wall&) const = default;
};

// Any flat rectangular screen, given by three corners as the viewer sees them.
struct Screen {
    Vec3 lower_left_world{-1.524, 0.0, 0.0};
    Vec3 lower_right_world{1.524, 0.0, 0.0};
    Vec3 upper_left_world{-1.524, 2.286, 0.0};

    bool operator==(const Screen&) const = default;
};

[[nodiscard]] inline Screen screen_of(const Wall& wall) {
    const double half_m = 0.5 * wall.width_m;
    return {{-half_m, 0.0, 0.0}, {half_m, 0.0, 0.0}, {-half_m, wall.height_m, 0.0}};
}

enum class Overlap : std::uint8_t {
    none,
    lying_on,  // in one plane, like blended projector pictures
    crossing,  // one intersects the other
};

// Classifies the overlap of two screens; those that meet at an edge have none. Up to 1 cm counts as touching: a side
// may be that much longer than measured.
[[nodiscard]] Overlap overlap_of(const Screen& a, const Screen& b);

// The head frame has its origin midway between the eyes, +X to the viewer's right, +Y up, -Z ahead.
struct Viewer {
    Pose head_world{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    double interpupillary_m = 0.063;  // mean of adults (Dodgson 2004)

    bool operator==(const Viewer&) const = default;
};

struct Eyes {
    Vec3 left_world;
    Vec3 right_world;
};

// The eyes at +-half the interpupillary distance on the head's own X axis, however the head is turned.
[[nodiscard]] inline Eyes eyes_of(const Viewer& viewer) {
    const Vec3 half{0.5 * viewer.interpupillary_m, 0.0, 0.0};
    return {viewer.head_world * -half, viewer.head_world * half};
}
[[nodiscard]] inline Vec3 middle_of(const Eyes& eyes) { return 0.5 * (eyes.left_world + eyes.right_world); }

}  // namespace burin::wall
