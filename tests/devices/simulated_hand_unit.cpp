// SPDX-License-Identifier: MIT
#include "devices/hand/simulated_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace burin::devices {
namespace {

SimulatedHand hand(std::vector<HandPose> script, HandPath path) {
    auto made = SimulatedHand::create(std::move(script), path);
    EXPECT_TRUE(made) << made.error().line();
    return *made;
}

const std::vector<HandPose> kScript{{0.0, Vec3(0.0), {1, 0, 0, 0}, 0},
                                    {0.5, Vec3(0.01, 0.0, 0.0), {1, 0, 0, 0}, 1},
                                    {0.8, Vec3(0.01, 0.02, 0.0), {0, 0, 1, 0}, 1},
                                    {1.6, Vec3(0.04, 0.03, -0.01), {0, 0, 1, 0}, 0}};

}  // namespace

TEST(SimulatedHand, PassesThroughEveryPoseAndRestsOutsideTheScript) {
    for (const HandPath path : {HandPath::straight, HandPath::monotone_cubic}) {
        const SimulatedHand h = hand(kScript, path);
        for (const HandPose& pose : kScript) {
            const HandTarget t = h.target(pose.time_s);
            EXPECT_LT(glm::length(t.position_device_m - pose.position_device_m), 1e-15);
            EXPECT_EQ(t.buttons, pose.buttons);
        }
        for (const double t : {-1.0, 1.6, 99.0}) EXPECT_EQ(h.target(t).velocity_device_m_per_s, Vec3(0.0));
        EXPECT_EQ(h.target(-1.0).position_device_m, Vec3(0.0));
        EXPECT_EQ(h.end_s(), 1.6);
    }
}

TEST(SimulatedHand, VelocityIsTheDerivativeOfPosition) {
    for (const HandPath path : {HandPath::straight, HandPath::monotone_cubic}) {
        const SimulatedHand h = hand(kScript, path);
        for (double t = 0.013; t < 1.59; t += 0.037) {
            const double e = 1e-6;
            const Vec3 difference = (h.target(t + e).position_device_m - h.target(t - e).position_device_m) / (2.0 * e);
            EXPECT_LT(glm::length(h.target(t).velocity_device_m_per_s - difference), 1e-7) << t;
        }
    }
}

TEST(SimulatedHand, TheMonotoneCubicIsSmoothAndNeverOvershoots) {
    const SimulatedHand h = hand(kScript, HandPath::monotone_cubic);
    double last_y = 0.0;
    for (int i = 0; i <= 1600; ++i) {
        const HandTarget t = h.target(i * 1e-3);
        EXPECT_GE(t.position_device_m.y, last_y - 1e-15);  // the script's y never falls
        EXPECT_LE(t.position_device_m.y, 0.03 + 1e-15);
        last_y = t.position_device_m.y;
    }
    for (const HandPose& pose : kScript) {  // no corner at a pose
        const Vec3 before = h.target(pose.time_s - 1e-9).velocity_device_m_per_s;
        const Vec3 after = h.target(pose.time_s + 1e-9).velocity_device_m_per_s;
        EXPECT_LT(glm::length(after - before), 1e-6);
    }
}

TEST(SimulatedHand, OrientationStaysAUnitQuaternionAndTakesTheShortWay) {
    const double c = std::cos(0.1), s = std::sin(0.1);
    // The same small turn written once as q and once as -q.
    const SimulatedHand h = hand({{0.0, Vec3(0.0), {1, 0, 0, 0}, 0}, {1.0, Vec3(0.0), {-c, 0, -s, 0}, 0}}, {});
    for (double t = 0.0; t <= 1.0; t += 0.05) {
        const Quat q = h.target(t).orientation_device;
        EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14);
        EXPECT_GE(std::abs(q.w), c - 1e-14);
    }
}

TEST(SimulatedHand, RefusesScriptsThatMakeNoSense) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(SimulatedHand::create({}));
    EXPECT_FALSE(SimulatedHand::create({{0.0, Vec3(0.0)}, {0.0, Vec3(1.0)}}));
    EXPECT_FALSE(SimulatedHand::create({{1.0, Vec3(0.0)}, {0.5, Vec3(1.0)}}));
    EXPECT_FALSE(SimulatedHand::create({{0.0, Vec3(nan, 0, 0)}}));
    EXPECT_FALSE(SimulatedHand::create({{nan, Vec3(0.0)}}));
    EXPECT_FALSE(SimulatedHand::create({{0.0, Vec3(0.0), {0, 0, 0, 0}}}));
    EXPECT_FALSE(SimulatedHand::create({{0.0, Vec3(0.0)}}, HandPath::straight, {.mass_kg = -1.0}));
    const auto unsorted = SimulatedHand::create({{1.0, Vec3(0.0)}, {0.5, Vec3(1.0)}});
    EXPECT_EQ(unsorted.error().where, "hand script, pose 2");  // names the culprit
}

TEST(SimulatedHand, TheMonotoneCubicsSlopeLeansTowardsTheSteeperStretchWhereThatIsTheShorter) {
    // Fritsch and Butland 1984: the harmonic mean of the secants 1 and 4 with the weights (2 h2 + h1) / 3 h and
    // (h2 + 2 h1) / 3 h (h1 = 0.1, h2 = 0.4, h = 0.5): 1 / (0.6 / 1 + 0.4 / 4).
    const SimulatedHand h =
        hand({{0.0, Vec3(0.0)}, {0.1, Vec3(0.1, 0.0, 0.0)}, {0.5, Vec3(1.7, 0.0, 0.0)}}, HandPath::monotone_cubic);
    EXPECT_NEAR(h.target(0.1).velocity_device_m_per_s.x, 1.0 / 0.7, 1e-12);
}

TEST(SimulatedHand, GivesUnitOrientationsOfAnyScriptAlsoAtItsEnds) {
    const SimulatedHand h = hand({{0.0, Vec3(0.0), {3, 0, 0, 0}, 0}, {1.0, Vec3(0.0), {0, 0, 0.1, 0}, 0}}, {});
    EXPECT_EQ(h.target(-1.0).orientation_device, Quat(1, 0, 0, 0));
    EXPECT_EQ(h.target(2.0).orientation_device, Quat(0, 0, 1, 0));
    // Halfway between orientations of any lengths it is the middle of the two.
    EXPECT_NEAR(h.target(0.5).orientation_device.w, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(h.target(0.5).orientation_device.y, std::sqrt(0.5), 1e-12);
}

}  // namespace burin::devices
