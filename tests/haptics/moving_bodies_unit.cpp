// SPDX-License-Identifier: MIT
// A surface that moves is felt as one that rests is felt by a hand that moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "tests/haptics/bodies.hpp"

namespace burin::haptics {
namespace {

constexpr double kBodysRadius_m = 0.004, kStiffness_N_per_m = 600.0, kDamping_Ns_per_m = 0.5;

// Up and down between two heights at one speed, turning only when it is published.
struct Zigzag {
    double speed_m_per_s = 0.0, lowest_m = 0.0;
    int ticks = 10;  // one way

    [[nodiscard]] double height_m(double time_s) const {
        const double at = time_s * 1e3 / ticks, part = at - 2.0 * std::floor(0.5 * at + 1e-9);
        return lowest_m + speed_m_per_s * 1e-3 * ticks * (part < 1.0 ? part : 2.0 - part);
    }
    [[nodiscard]] double speed(double time_s) const {
        const double at = std::floor(time_s * 1e3 / ticks + 1e-9);
        return at - 2.0 * std::floor(0.5 * at) < 0.5 ? speed_m_per_s : -speed_m_per_s;
    }
};

struct Pressed {
    double worst_N = 0.0, least_N = HUGE_VAL, mean_N = 0.0;  // error against spring and damper; force
    double expected_mean_N = 0.0, steepest_N = 0.0;          // rise in a tick
    int ramping = 0;
};

// A plate that goes up and down by up to 3 mm under a held stylus, after the ramp of the first contact.
Pressed press(double speed_m_per_s, bool announced, bool at_random = false, bool in_session = false) {
    Zigzag way{speed_m_per_s, 0.0, 100};
    while (way.speed_m_per_s * 1e-3 * way.ticks > 0.003 && way.ticks > 10) way.ticks -= 10;
    test::Bodies bodies;
    bodies.parameters.passivity.control = in_session;  // else what the wall gives out is judged elsewhere
    if (in_session)
        bodies.device = devices::SimulatedOmni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}})).description();
    bodies.announced = announced;
    bodies.surface = test::around({{test::plate(0.05, 0.01), 0}});
    bodies.motions = {
        test::along_y([way](double t) { return way.height_m(t); }, [way](double t) { return way.speed(t); })};
    // Touched from 1 to 4 mm deep.
    const Vec3 hand(0.0, kBodysRadius_m - 0.001, 0.0);
    Pressed felt;
    std::mt19937 random(1);
    constexpr int kTicks = 1200, kFrom = 500;
    double last_N = 0.0;
    for (int i = 0; i < kTicks; ++i) {
        if (at_random && bodies.ticks > bodies.next_publication)
            bodies.next_publication = bodies.ticks + 8 + static_cast<int>(random() % 9);  // 60 to 120 Hz
        const double t = bodies.time_s();
        const TickRecord record = bodies.tick(hand);
        if (i < kFrom) continue;
        const double depth_m = way.height_m(t) + 0.001;
        const double expected_N = kStiffness_N_per_m * depth_m + kDamping_Ns_per_m * way.speed(t);
        const double given_N = record.gate.given.force_device_N.y;
        felt.worst_N = std::max(felt.worst_N, std::abs(given_N - expected_N));
        felt.least_N = std::min(felt.least_N, given_N);
        felt.mean_N += given_N / (kTicks - kFrom);
        felt.expected_mean_N += expected_N / (kTicks - kFrom);
        if (i > kFrom) felt.steepest_N = std::max(felt.steepest_N, given_N - last_N);
        last_N = given_N;
        felt.ramping += (record.flags & kTickRamping) != 0;
    }
    return felt;
}

TEST(MovingBodies, APlateThatMovesIsFeltInEveryTickAsSpringAndDamperAgainstAHandAtRest) {
    for (const double speed : {0.02, 0.05, 0.1, 0.3}) {
        const Pressed felt = press(speed, true);
        EXPECT_EQ(felt.ramping, 0) << speed;
        EXPECT_LT(felt.worst_N, 0.02) << speed << ": a hundredth of what is felt, and no saw's teeth";
        EXPECT_GT(felt.least_N, 0.4) << speed;
    }
}

TEST(MovingBodies, OfAMotionThatNobodyAnnouncesOnlyThePartThatItAddsFadesIn) {
    for (const double speed : {0.1, 0.3}) {
        const Pressed felt = press(speed, false);
        EXPECT_GT(felt.ramping, 200) << speed;
        EXPECT_LT(felt.steepest_N, 1.1 * 0.0005 * kStiffness_N_per_m) << speed << ": half a millimetre's worth a tick";
        EXPECT_GT(felt.mean_N, 0.4 * 1.5) << speed << ": the contact as such stays";
    }
    EXPECT_EQ(press(0.02, false).ramping, 0) << "below half a millimetre a publication nothing fades";
}

// With an Omni and the account of energy, as in a session: what a body does that nobody announces, the hand has not put
// in, so that most of it is kept from the hand.
TEST(MovingBodies, InASessionAnUnannouncedPlateIsFeltFaintlyAndAnAnnouncedOneAsItIs) {
    for (const double speed : {0.1, 0.3}) {
        const Pressed silent = press(speed, false, false, true), told = press(speed, true, false, true);
        std::cout << speed << " m/s: announced " << told.mean_N << " N, not announced " << silent.mean_N << " N of "
                  << told.expected_mean_N << '\n';
        EXPECT_GT(told.mean_N, 0.5 * told.expected_mean_N);
        EXPECT_LT(silent.mean_N, told.mean_N);
        EXPECT_GT(silent.mean_N, 0.05);
    }
}

// As a physics engine publishes it: at random intervals, with the velocity that holds then, and turning back in
// between.
TEST(MovingBodies, APlateThatTurnsBackBetweenItsPublicationsIsFeltAsHardAsItIs) {
    for (const double speed : {0.1, 0.3}) {
        const Pressed felt = press(speed, true, true);
        // At 300 mm/s it turns back each 10 ms, and is felt too near or too far until the next publication.
        EXPECT_GT(felt.mean_N, (speed < 0.2 ? 0.8 : 0.6) * felt.expected_mean_N) << speed;
        EXPECT_LT(felt.mean_N, 1.1 * felt.expected_mean_N) << speed;
    }
}

TEST(MovingBodies, AFallingBodyThatHitsAHandAtRestIsFeltAtOnceWithoutARamp) {
    for (const double speed : {0.2, 1.0, 2.0}) {
        test::Bodies bodies;
        bodies.parameters.passivity.control = false;
        bodies.surface = test::around({{test::plate(0.05, 0.0005), 0}});  // a sheet of metal, half a millimetre
        bodies.motions = {
            test::along_y([speed](double t) { return -0.5 + speed * t; }, [speed](double) { return speed; })};
        const Vec3 hand(0.0);
        bool felt = false;
        for (int i = 0; i < 5000 && !felt; ++i) {
            const double t = bodies.time_s();
            const TickRecord record = bodies.tick(hand);
            const double depth_m = -0.5 + speed * t + kBodysRadius_m;
            ASSERT_EQ(record.in_contact(), depth_m > 1e-5) << speed << ' ' << depth_m;
            if (!record.in_contact()) continue;
            EXPECT_EQ(record.flags & kTickRamping, 0u);
            EXPECT_NEAR(record.deepest().proxy_object_m.y, depth_m, 1e-4) << "on its upper side, pushed along";
            felt = depth_m > 0.003;
        }
        EXPECT_TRUE(felt) << speed;
    }
}

TEST(MovingBodies, AProxyThatSticksIsCarriedSidewaysAndOneThatSlidesRubsByTheRelativeMotionAlone) {
    test::Bodies bodies;
    bodies.parameters.passivity.control = false;
    bodies.parameters.materials[0].static_friction = bodies.parameters.materials[0].dynamic_friction = 0.5;
    bodies.surface = test::around({{test::plate(0.2, 0.01), 0}});
    const double speed = 0.1;
    bodies.motions = {[speed](double t) {
        geometry::MeshMotion motion;
        motion.body = 7;
        motion.object_from_mesh.position_m.x = speed * t;
        motion.velocity_object_m_per_s.x = speed;
        return motion;
    }};
    const auto hand_at = [&](double x) { return Vec3(x, kBodysRadius_m - 0.002, 0.0); };
    // The hand goes along with the plate: it sticks, and nothing drags.
    for (int i = 0; i < 600; ++i) {
        const TickRecord record = bodies.tick(hand_at(speed * bodies.time_s()));
        ASSERT_TRUE(record.in_contact());
        ASSERT_NE(record.flags & kTickSticking, 0u) << i;
        ASSERT_NEAR(record.deepest().proxy_object_m.x, speed * 1e-3 * i, 1e-6) << i;
    }
    // The hand holds still: the plate drags it along by the friction cone.
    const Vec3 held = hand_at(speed * bodies.time_s());
    TickRecord record;
    for (int i = 0; i < 300; ++i) {
        record = bodies.tick(held);
        ASSERT_EQ(record.contact.jumped, false) << i;
    }
    EXPECT_EQ(record.flags & kTickSticking, 0u);
    const Vec3 force = record.gate.given.force_device_N;
    EXPECT_NEAR(force.y, kStiffness_N_per_m * 0.002, 0.01);
    EXPECT_NEAR(force.x, 0.5 * force.y, 0.02 * force.y);
}

TEST(MovingBodies, ADrumThatTurnsDragsTheHandRound) {
    for (const double speed : {-20.0, -2.0, 2.0, 20.0}) {  // rad/s
        test::Bodies bodies;
        bodies.parameters.passivity.control = false;
        bodies.parameters.materials[0].static_friction = bodies.parameters.materials[0].dynamic_friction = 0.3;
        bodies.surface = test::around({{test::drum(0.05, 0.05, 360), 0}});
        bodies.motions = {[speed](double t) {
            geometry::MeshMotion motion;
            motion.body = 1;
            motion.object_from_mesh = geometry::moved_on({}, Vec3(0.0), {0.0, 0.0, speed}, t);
            motion.angular_velocity_object_rad_per_s.z = speed;
            return motion;
        }};
        const Vec3 hand(0.0, 0.05 + kBodysRadius_m - 0.002, 0.0);
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (int i = 0; i < 1500; ++i) {
            const TickRecord record = bodies.tick(hand);
            ASSERT_TRUE(record.in_contact()) << i;
            ASSERT_EQ(record.contact.jumped, i == 0) << i;
            if (i < 800) continue;
            const Vec3 force = record.gate.given.force_device_N;
            least = std::min(least, force.x / force.y), most = std::max(most, force.x / force.y);
        }
        // Dragged the way its top goes, by the cone; the proxy has gone round by its angle.
        const double sense = speed > 0.0 ? -1.0 : 1.0, cone = 0.3;
        EXPECT_GT(std::min(sense * least, sense * most), 0.8 * cone) << speed;
        EXPECT_LT(std::max(sense * least, sense * most), 1.3 * cone) << speed;
    }
}

TEST(MovingBodies, WhatIsSetElsewhereOrRaisedByAnEditFadesInAndWhatRetreatsDoesNot) {
    for (const double rise_m : {-0.003, 0.0003, 0.003, 0.03}) {
        test::Bodies bodies;
        bodies.surface = test::around({{test::plate(0.05, 0.1), 0}});
        bodies.motions = {
            test::along_y([rise_m](double t) { return t < 0.5 ? 0.0 : rise_m; }, [](double) { return 0.0; })};
        bool fades = false;
        double steepest_N = 0.0, last_N = 0.0;
        const Vec3 hand(0.0, kBodysRadius_m - 0.004, 0.0);
        for (int i = 0; i < 520; ++i) {
            const TickRecord record = bodies.tick(hand);
            const double force_N = record.gate.given.force_device_N.y;
            if (i >= 490) {
                fades = fades || (record.flags & kTickRamping) != 0;
                steepest_N = std::max(steepest_N, force_N - last_N);
            }
            last_N = force_N;
        }
        EXPECT_EQ(fades, rise_m > 0.0005) << rise_m;
        EXPECT_LT(steepest_N, 1.1 * 0.0005 * kStiffness_N_per_m) << rise_m;
    }
    // A mesh that rests, and whose top is raised.
    for (const double rise_m : {0.0003, 0.003}) {
        test::Bodies bodies;
        bodies.surface = test::around({{test::plate(0.05, 0.1), 0}});
        const Vec3 hand(0.0, kBodysRadius_m - 0.001, 0.0);
        for (int i = 0; i < 500; ++i) (void)bodies.tick(hand);
        auto raised = test::snapshot_of(test::box({-0.05, -0.1, -0.05}, {0.05, rise_m, 0.05}, 4));
        bodies.surface.meshes[0].snapshot = raised;
        EXPECT_EQ((bodies.tick(hand).flags & kTickRamping) != 0, rise_m > 0.0005) << rise_m;
    }
}

// Returns the forces on a hand under which a plate goes up and down, with other meshes
// before it in the surface.
std::vector<double> pressed_behind(const std::vector<geometry::TouchedMesh>& others) {
    const Zigzag way{0.02, 0.0, 100};
    test::Bodies bodies;
    bodies.surface = test::around(others);
    bodies.surface.meshes.push_back({test::plate(0.05, 0.01), 0});
    bodies.motions.resize(others.size());
    bodies.motions.push_back(
        test::along_y([way](double t) { return way.height_m(t); }, [way](double t) { return way.speed(t); }));
    std::vector<double> forces_N;
    for (int i = 0; i < 800; ++i)
        forces_N.push_back(bodies.tick({0.0, kBodysRadius_m - 0.001, 0.0}).gate.given.force_device_N.y);
    return forces_N;
}

TEST(MovingBodies, ABodyIsFollowedHoweverManyMeshesRestBeforeIt) {
    const test::Snapshot far = test::plate(0.05, 0.01);
    std::vector<geometry::TouchedMesh> resting(20, {far, 0});
    for (geometry::TouchedMesh& mesh : resting) mesh.motion.object_from_mesh.position_m = {10.0, 0.0, 0.0};
    EXPECT_EQ(pressed_behind(resting), pressed_behind({}));
}

TEST(MovingBodies, TwentyBodiesAreFollowedAtOnce) {
    std::vector<geometry::TouchedMesh> moving(19, {test::plate(0.05, 0.01), 0});
    for (std::size_t i = 0; i < moving.size(); ++i) {
        moving[i].motion.body = 100 + i;
        moving[i].motion.object_from_mesh.position_m = {10.0, 0.0, 0.0};
    }
    EXPECT_EQ(pressed_behind(moving), pressed_behind({}));
}

TEST(MovingBodies, ABodyStandsWhenItIsNoLongerPublished) {
    test::Bodies bodies;
    bodies.parameters.max_surface_age_s = 0.05;
    bodies.publish_every = 1000;
    bodies.surface = test::around({{test::plate(0.05, 0.01), 0}});
    bodies.motions = {test::along_y([](double t) { return -0.1 + t; }, [](double) { return 1.0; })};
    TickRecord record;
    for (int i = 0; i < 200; ++i) record = bodies.tick({0.0, -0.047, 0.0});
    EXPECT_NEAR(record.deepest().proxy_object_m.y, -0.05 + kBodysRadius_m, 1e-4);
    EXPECT_EQ(record.contact.surface_velocity_device_m_per_s, Vec3(0.0));
    EXPECT_EQ(record.gate.cause, GateCause::stale_surface);
}

}  // namespace
}  // namespace burin::haptics
