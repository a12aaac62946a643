// SPDX-License-Identifier: MIT
// How a tool stands where the mouse points, of a contact that is known: upright on the normal, its +X to the screen's
// right, and rolled about its own axis by the right-hand rule.
#include "desk/input/surface_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/uneven_poses.hpp"

namespace burin::session {
namespace {

// Returns where the tool stands beside a contact, as no surface is hit.
Pose stands(const Vec3& normal, const Quat& object_from_screen, double roll_rad) {
    SurfaceHand hand;
    hand.last = SurfaceContact{uneven_offset(2), normal};
    const Ray ray{uneven_offset(2) + Vec3(0.011, -0.023, 0.4), glm::normalize(Vec3(0.1, -0.2, -0.9))};
    const ToolOnSurface tool{.tip_m = 0.017, .half_width_m = 0.006, .depth_m = 0.002, .roll_rad = roll_rad};
    return pointed_at(hand, ray, SeenSurface{}, tool, object_from_screen, Vec3(0.0)).tool.object_from_tool;
}

// A vector turned about a unit axis by the right-hand rule (Rodrigues).
Vec3 turned(const Vec3& v, const Vec3& axis, double angle_rad) {
    return std::cos(angle_rad) * v + std::sin(angle_rad) * glm::cross(axis, v) +
           (1.0 - std::cos(angle_rad)) * glm::dot(axis, v) * axis;
}

}  // namespace

TEST(SurfaceHands, ARollTurnsTheToolAboutItsAxisByTheRightHandRule) {
    for (std::size_t i = 0; i < kUnevenPoses; ++i) {
        const Vec3 normal = uneven_direction(i);
        const Quat screen = uneven_turn(i + 1);
        const Vec3 to_right = screen * Vec3(1.0, 0.0, 0.0);
        const Vec3 right = glm::normalize(to_right - glm::dot(to_right, normal) * normal);
        for (const double degrees : {0.0, 30.0, -30.0, 75.0, 160.0}) {
            const double roll_rad = degrees * std::numbers::pi / 180.0;
            const Pose pose = stands(normal, screen, roll_rad);
            const Vec3 x = pose.orientation * Vec3(1.0, 0.0, 0.0), y = pose.orientation * Vec3(0.0, 1.0, 0.0);
            EXPECT_LT(glm::distance(y, normal), 1e-9) << i << " " << degrees;
            EXPECT_LT(glm::distance(x, turned(right, normal, roll_rad)), 1e-9) << i << " " << degrees;
        }
    }
}

TEST(SurfaceHands, OfANormalAlongTheScreensRightTheToolsXIsDefinedToo) {
    const Quat screen = uneven_turn(0);
    for (const double sign : {1.0, -1.0}) {
        const Vec3 normal = screen * Vec3(sign, 0.0, 0.0);
        const Vec3 x0 = stands(normal, screen, 0.0).orientation * Vec3(1.0, 0.0, 0.0);
        EXPECT_NEAR(glm::dot(x0, normal), 0.0, 1e-9);
        const Vec3 x = stands(normal, screen, 0.5).orientation * Vec3(1.0, 0.0, 0.0);
        EXPECT_LT(glm::distance(x, turned(x0, normal, 0.5)), 1e-9);
    }
}

}  // namespace burin::session
