// SPDX-License-Identifier: MIT
// Thin plates that move and turn at random through a hand that moves at random: the proxy stays outside, on its side.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/haptics/bodies.hpp"

namespace burin::haptics {
namespace {

constexpr double kHalf_m = 0.05, kThick_m = 0.0005, kRadius_m = 0.004;

TEST(MovingBodies, LeaveTheProxyOutsideAndOnItsSideInTenThousandRandomMotions) {
    std::mt19937_64 random(14);
    const auto between = [&](double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const auto vector = [&](double half) {
        return Vec3(between(-half, half), between(-half, half), between(-half, half));
    };
    const test::Snapshot plate = test::plate(kHalf_m, kThick_m, 2);
    int touched = 0, inside = 0, crossed = 0, ticks = 0;
    for (int run = 0; run < 10'000; ++run) {
        const Vec3 turning = vector(10.0), hand_speed = vector(0.5), at = vector(0.01);
        const Vec3 speed = vector(0.3) + Vec3(0.0, between(-2.0, 2.0), 0.0);
        const Pose start{{0.0, (speed.y > 0.0 ? -1.0 : 1.0) * between(0.006, 0.02), 0.0}};
        test::Bodies bodies;
        bodies.parameters.probe = ball_probe(run % 4 == 0 ? 0.0 : kRadius_m);
        const double radius_m = run % 4 == 0 ? 0.0 : kRadius_m;
        bodies.parameters.materials[0].static_friction = run % 3 == 0 ? 0.4 : 0.0;
        bodies.surface = test::around({{plate, 0}});
        Pose pose = start;
        bodies.motions = {[&](double t) {
            geometry::MeshMotion motion;
            motion.body = 1;
            pose = motion.object_from_mesh = geometry::moved_on(start, speed, turning, t);
            motion.velocity_object_m_per_s = speed;
            motion.angular_velocity_object_rad_per_s = turning;
            return motion;
        }};
        double side = 0.0;
        for (int i = 0; i < 20; ++i, ++ticks) {
            const double t = bodies.time_s();
            const TickRecord record = bodies.tick(at + t * hand_speed);
            touched += record.in_contact();
            const Pose now = geometry::moved_on(start, speed, turning, t);
            const Vec3 p = glm::conjugate(now.orientation) * (record.deepest().proxy_object_m - now.position_m);
            const Vec3 middle(0.0, -0.5 * kThick_m, 0.0), half(kHalf_m, 0.5 * kThick_m, kHalf_m);
            const double away = glm::length(glm::max(glm::abs(p - middle) - half, Vec3(0.0)));
            if (i > 0) inside += away < radius_m * 0.99 || (away == 0.0 && radius_m > 0.0);
            const bool over = std::abs(p.x) < kHalf_m && std::abs(p.z) < kHalf_m;
            const double now_on = over ? (p.y > middle.y ? 1.0 : -1.0) : 0.0;
            crossed += now_on * side < 0.0;
            side = now_on;
        }
    }
    EXPECT_EQ(inside, 0);
    EXPECT_EQ(crossed, 0);
    EXPECT_GT(touched, ticks / 5);
    RecordProperty("touched", touched);
}

}  // namespace
}  // namespace burin::haptics
