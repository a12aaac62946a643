// SPDX-License-Identifier: MIT
#include "wall/wall.hpp"

#include "wall/projection.hpp"

namespace burin::wall {
namespace {

// The smallest rotation that takes one unit vector to the other.
Quat rotation_between(const Vec3& from, const Vec3& to) {
    const Vec3 half = from + to;
    if (glm::dot(half, half) < 1e-12) {  // opposite: half a turn about any perpendicular axis
        const Vec3 across = std::abs(from.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        return glm::angleAxis(glm::pi<double>(), glm::normalize(glm::cross(from, across)));
    }
    const Vec3 h = glm::normalize(half);
    const Vec3 axis = glm::cross(from, h);
    return {glm::dot(from, h), axis.x, axis.y, axis.z};
}

}  // namespace

const char* name_of(EyeOrder order) {
    switch (order) {
        case EyeOrder::left_first: return "left-first";
        case EyeOrder::right_first: return "right-first";
        case EyeOrder::simultaneous: break;
    }
    return "simultaneous";
}

SensorEyes eyes_about(const Vec3& middle_sensor, double interpupillary_m) {
    const Vec3 half{0.5 * interpupillary_m, 0.0, 0.0};
    return {middle_sensor - half, middle_sensor + half};
}

Screen screen_world(const WallSetup& setup, const WallScreen& screen) {
    return {setup.world_from_tracker * screen.lower_left_tracker, setup.world_from_tracker * screen.lower_right_tracker,
            setup.world_from_tracker * screen.upper_left_tracker};
}

Eyes eyes_world(const WallSetup& setup, const HeadPoses& head) {
    return {setup.world_from_tracker * (head.left_tracker * setup.eyes.left_sensor),
            setup.world_from_tracker * (head.right_tracker * setup.eyes.right_sensor)};
}

std::vector<ScreenView> views_of(const WallSetup& setup, const HeadPoses& head) {
    const Eyes eyes = eyes_world(setup, head);
    std::vector<ScreenView> views;
    views.reserve(setup.screens.size());
    for (const WallScreen& s : setup.screens) {
        const Screen screen = screen_world(setup, s);
        views.push_back({screen, eyes, can_be_seen(screen, eyes)});
    }
    return views;
}

Viewer viewer_with(const Eyes& eyes, const Quat& near) {
    const Vec3 apart = eyes.right_world - eyes.left_world;
    const double apart_m = glm::length(apart);
    const Vec3 middle = 0.5 * (eyes.left_world + eyes.right_world);
    if (!(apart_m > 0.0)) return {{middle, near}, 0.0};
    const Quat turned = rotation_between(near * Vec3{1, 0, 0}, apart / apart_m) * near;
    return {{middle, glm::normalize(turned)}, apart_m};
}

}  // namespace burin::wall
