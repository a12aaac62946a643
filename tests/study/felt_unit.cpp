// SPDX-License-Identifier: MIT
// The touch of a study's world: its mesh against the tube's formula, deviations both ways, what groups feel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "study/felt/repeated_stage.hpp"
#include "study/felt/tube_mesh.hpp"
#include "study/people/learner.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::study {
namespace {

Protocol kinesthetic_path() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_protocol(text).protocol;
}

constexpr Nanoseconds kTick_ns = 1'000'000;

// The middle of the wand at a share of the spine, off the axis by so much upwards and sideways.
Vec3 beside(const StudyWorld& world, double share, double up_m, double side_m) {
    const double at = share * static_cast<double>(world.spine_m.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), world.spine_m.size() - 2);
    const Vec3 way = world.spine_m[i + 1] - world.spine_m[i];
    const Vec3 side = glm::normalize(glm::cross(way, Vec3(0, 1, 0)));
    return world.spine_m[i] + (at - static_cast<double>(i)) * way + Vec3(0, up_m, 0) + side_m * side;
}

devices::DeviceSample sample_at(const StageTouch& touch, const Vec3& middle_m, std::size_t tick) {
    devices::DeviceSample sample;
    sample.time_ns = static_cast<Nanoseconds>(tick + 1) * kTick_ns;
    sample.position_device_m = touch.place_at_device(middle_m);
    return sample;
}

TEST(StudyTubeMesh, LiesOnTheTubesWall) {
    const Protocol protocol = kinesthetic_path();
    const StudyWorld& world = protocol.worlds.at(0);
    const geometry::TriangleMesh mesh = tube_mesh(world);
    ASSERT_GT(mesh.triangles.size(), 1000u);
    // The spine of this tube bends more sharply than the tube is wide: sections across it lie up to 16 mm within.
    const auto off_m = [&](const Vec3& p) { return nearest_on(world.spine_m, p).distance_m - world.tube_radius_m; };
    double corner_m = 0.0, most_m = 0.0, least_m = 0.0, sum_m = 0.0;
    for (const auto& t : mesh.triangles) {
        const Vec3 middle = (mesh.positions_m[t[0]] + mesh.positions_m[t[1]] + mesh.positions_m[t[2]]) / 3.0;
        corner_m = std::max(corner_m, std::abs(off_m(mesh.positions_m[t[0]])));
        most_m = std::max(most_m, off_m(middle));
        least_m = std::min(least_m, off_m(middle));
        sum_m += std::abs(off_m(middle));
    }
    EXPECT_LT(corner_m, 0.00004);
    EXPECT_GT(corner_m, 0.0);
    EXPECT_LT(most_m, 0.0015);
    EXPECT_GT(least_m, -0.0003);
    EXPECT_LT(sum_m / static_cast<double>(mesh.triangles.size()), 0.00006);
    EXPECT_TRUE(funnel_mesh({"w", {{0, 0, 0}, {1, 0, 0}}, 0.045, 0.06, 0.02, 0.0}, WorldEnd::start).triangles.empty());
}

TEST(StudyTubeMesh, FunnelsNarrowFromTheCapToTheMouth) {
    const StudyWorld world{"w", {{0, 0, 0}, {1, 0, 0}}, 0.045, 0.068, 0.02, 0.05};
    const geometry::TriangleMesh funnel = funnel_mesh(world, WorldEnd::end), cap = cap_mesh(world, WorldEnd::end);
    for (const Vec3& p : funnel.positions_m) {
        const double half_m = 0.05 + (p.x - 1.0) / 0.02 * 0.018;
        EXPECT_NEAR(std::max(std::abs(p.y), std::abs(p.z)), half_m, 1e-12);
    }
    for (const Vec3& p : cap.positions_m) {
        EXPECT_GE(p.x, 1.02 - 1e-12);
        EXPECT_LE(p.x, 1.022 + 1e-12);
    }
    EXPECT_EQ(cap.triangles.size(), 12u);
}

// A motion through the tube that goes out of the wall again and again, at the pace of a person.
std::vector<AttemptTick> motion_beside(const Protocol& protocol, const FeltWorld& world, double up_m, double side_m) {
    const StageTouch touch(protocol, *protocol.stage("test"), protocol.groups[1], world);
    std::vector<AttemptTick> motion;
    constexpr std::size_t kTicks = 3000;
    for (std::size_t i = 0; i < kTicks; ++i) {
        const double share = static_cast<double>(i) / kTicks;
        const double calm = std::sin(std::numbers::pi * share);
        const Vec3 middle =
            beside(world.world(), share, calm * up_m * std::sin(9.0 * share), calm * side_m * std::cos(7.0 * share));
        const devices::DeviceSample sample = sample_at(touch, middle, i);
        motion.push_back({sample.time_ns, sample.time_ns, sample.position_device_m, sample.orientation_device,
                          touch.points_m(sample)});
    }
    return motion;
}

TEST(StudyDeviation, ToTheProxyAndToTheWallAgreeWithinAFifthOfAMillimetre) {
    const Protocol protocol = kinesthetic_path();
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    StageState end;
    end.result = StageResult::valid_exit;
    end.clock_stopped_s = 3.0;
    for (const auto& [up_m, side_m] : {std::pair{0.0, 0.0}, std::pair{0.03, 0.02}, std::pair{0.015, 0.04}}) {
        const auto motion = motion_beside(protocol, **world, up_m, side_m);
        const ModelTouch model = touch_by_model(protocol, *protocol.stage("test"), **world, motion);
        const Json record = trial_record((*world)->world(), end, {}, model);
        const double by_proxy = record.at("proxy_deviation_mm").get<double>();
        const double by_wall = record.at("deviation_mm").get<double>();
        EXPECT_NEAR(by_proxy, by_wall, 0.4) << up_m;  // the sum of two points' means
        EXPECT_EQ(record.at("deviations_differ").get<int>(), 0);
        if (up_m > 0.0) {
            EXPECT_GT(by_wall, 1.0);
            EXPECT_GT(record.at("contact_s").get<double>(), 0.5);
            EXPECT_GT(record.at("force_largest_N").get<double>(), record.at("force_mean_N").get<double>());
            // About the middle the torque is that of half the difference of both forces, at the whole handle.
            double torque_Nm = 0.0;
            for (std::size_t i = 0; i < model.times_ns.size(); ++i)
                torque_Nm =
                    std::max(torque_Nm, 0.5 * glm::length(glm::cross(model.points_m[0][i] - model.points_m[1][i],
                                                                     model.forces_N[0][i] - model.forces_N[1][i])));
            EXPECT_GT(torque_Nm, 1e-4);
            EXPECT_NEAR(record.at("torque_largest_Nm").get<double>(), torque_Nm, 1e-12);
        } else {
            EXPECT_LT(by_wall, 1e-9);
            EXPECT_LT(by_proxy, 0.2);
        }
    }
}

TEST(StudyDeviation, IsFlaggedWhereTheHandGoesAroundTheTube) {
    const Protocol protocol = kinesthetic_path();
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    const StageTouch touch(protocol, *protocol.stage("test"), protocol.groups[1], **world);
    const StudyWorld& tube = (*world)->world();
    // Out through the wall a tenth of the way along, straight to the same distance before the end: the proxy cannot
    // go there, and hangs in the bend.
    std::vector<AttemptTick> motion;
    for (std::size_t i = 0; i < 3000; ++i) {
        const Vec3 middle =
            tube.spine_m.front() + (static_cast<double>(i) / 3000.0) * (tube.spine_m.back() - tube.spine_m.front());
        const devices::DeviceSample sample = sample_at(touch, middle, i);
        motion.push_back({sample.time_ns, sample.time_ns, sample.position_device_m, sample.orientation_device,
                          touch.points_m(sample)});
    }
    StageState end;
    end.result = StageResult::valid_exit;
    const Json record = trial_record(tube, end, {}, touch_by_model(protocol, *protocol.stage("test"), **world, motion));
    EXPECT_GT(record.at("deviation_mm").get<double>(), 50.0);
    EXPECT_GT(record.at("proxy_deviation_mm").get<double>(), 50.0);
    // Then out of the wall and back into the tube beyond the bend: the proxy stays behind, and the trial is flagged.
    std::vector<AttemptTick> around;
    for (std::size_t i = 0; i < 3000; ++i) {
        const double t = static_cast<double>(i) / 3000.0;
        const Vec3 from = beside(tube, 0.15, 0.0, 0.0), to = beside(tube, 0.85, 0.0, 0.0);
        const double share = std::clamp(2.0 * t - 0.25, 0.0, 1.0);
        const Vec3 middle = t < 0.125 ? beside(tube, 1.2 * t, 0.0, 0.0) : from + share * (to - from);
        const devices::DeviceSample sample = sample_at(touch, middle, i);
        around.push_back({sample.time_ns, sample.time_ns, sample.position_device_m, sample.orientation_device,
                          touch.points_m(sample)});
    }
    const Json flagged =
        trial_record(tube, end, {}, touch_by_model(protocol, *protocol.stage("test"), **world, around));
    EXPECT_EQ(flagged.at("deviations_differ").get<int>(), 1);
    EXPECT_GT(flagged.at("proxy_deviation_mm").get<double>(), flagged.at("deviation_mm").get<double>() + 10.0);
    EXPECT_FALSE(flagged.contains("force_mean_N"));
}

// Presses the wand's middle 20 mm off the axis halfway through the tube: what the hand is given, and whether it
// touches.
haptics::TickRecord pressed(const Protocol& protocol, const Stage& stage, const Group& group, const FeltWorld& world,
                            double off_m = 0.02) {
    RepeatedTouch repeated(protocol, stage, group, world);
    const StageTouch& touch = repeated.touch();
    haptics::TickRecord last;
    for (std::size_t i = 0; i < 2500; ++i) {
        const double share = std::min(1.0, static_cast<double>(i) / 2000.0);
        last = repeated.tick(sample_at(touch, beside(world.world(), 0.5 * share, off_m * share, 0.0), i),
                             static_cast<Nanoseconds>(i + 1) * kTick_ns);
    }
    return last;
}

TEST(StudyTouch, GroupsThatDoNotFeelTheTubeTouchItWithoutForce) {
    const Protocol protocol = kinesthetic_path();
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    const Stage& training = *protocol.stage("interactive");
    const Group &haptic = protocol.groups[0], &visual = protocol.groups[1];
    const haptics::TickRecord felt = pressed(protocol, training, haptic, **world);
    EXPECT_TRUE(felt.in_contact());
    EXPECT_GT(glm::length(felt.gate.given.force_device_N), 0.5);
    EXPECT_LT(felt.gate.given.force_device_N.y, 0.0);  // back to the axis
    const Stage* test = protocol.stage("test");
    for (const auto& [stage, group] :
         {std::pair{&training, &visual}, std::pair{test, &haptic}, std::pair{test, &visual}}) {
        const haptics::TickRecord unfelt = pressed(protocol, *stage, *group, **world);
        EXPECT_TRUE(unfelt.in_contact()) << stage->name;
        EXPECT_EQ(unfelt.gate.given.force_device_N, Vec3(0.0)) << stage->name;
        // The top point is 30 + 20 mm off the axis, 5 mm beyond the wall; up there the wall leans a little.
        EXPECT_NEAR(unfelt.contact.points[0].penetration_m, 0.005, 0.0005) << stage->name;
        EXPECT_EQ(unfelt.contact.points[1].constraints, 0u) << stage->name;
    }
}

TEST(StudyTouch, GivesNoMoreThanTheConsentFormPromises) {
    Protocol protocol = kinesthetic_path();
    protocol.force_limit_N = 1.2;
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    const haptics::TickRecord hard =
        pressed(protocol, *protocol.stage("interactive"), protocol.groups[0], **world, 0.03);
    EXPECT_GT(glm::length(hard.wanted.force_device_N), 1.2);
    EXPECT_LE(glm::length(hard.gate.given.force_device_N), 1.2 + 1e-9);
    EXPECT_TRUE(hard.gate.saturated);
}

TEST(StudyTouch, LedTrainingFadesAndLeadsForthAndBack) {
    Protocol protocol = kinesthetic_path();
    Stage stage = *protocol.stage("led");
    stage.guidance_first = 1.0;
    stage.guidance_last = 0.0;
    stage.ends_after_s = 60.0;
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    RepeatedTouch repeated(protocol, stage, protocol.groups[0], **world);
    const StageTouch& touch = repeated.touch();
    ASSERT_TRUE(touch.leads());
    EXPECT_FALSE(StageTouch(protocol, stage, protocol.groups[1], **world).leads());
    // A hand that goes wherever it is led: to the attracting point of the tick before.
    Vec3 middle = (*world)->world().spine_m.front();
    double farthest_m = -1.0, stiffness_first = 0.0;
    std::size_t came_back_at = 0;
    for (std::size_t i = 0; i < 30'000; ++i) {
        const haptics::TickRecord& record =
            repeated.tick(sample_at(touch, middle, i), static_cast<Nanoseconds>(i + 1) * kTick_ns);
        if (i == 10) stiffness_first = touch.parameters().guidance.stiffness_N_per_m;
        EXPECT_LE(glm::length(record.gate.given.force_device_N), protocol.force_limit_N + 1e-9);
        middle += 0.0001 * record.wanted.force_device_N;
        farthest_m = std::max(farthest_m, middle.x);
        if (farthest_m > 0.15 && middle.x < -0.1 && came_back_at == 0) came_back_at = i;
    }
    EXPECT_NEAR(stiffness_first, protocol.guidance_N_per_m, 0.01 * protocol.guidance_N_per_m);
    EXPECT_NEAR(touch.parameters().guidance.stiffness_N_per_m, 0.5 * protocol.guidance_N_per_m,
                0.01 * protocol.guidance_N_per_m);
    EXPECT_GT(farthest_m, 0.15);
    EXPECT_GT(came_back_at, 0u);
}

TEST(StudySession, SetsTheProxiesOnTheAxisAtTheStartCap) {
    const Protocol protocol = kinesthetic_path();
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    const StudyWorld& tube = (*world)->world();
    RepeatedStage stage(protocol, *protocol.stage("test"), protocol.groups[0], **world);
    const StageSession& session = stage.session();
    // Begins far outside, beside the tube's middle, and only then comes to the start cap.
    std::size_t tick = 0;
    const auto move = [&](const Vec3& from, const Vec3& to, std::size_t ticks) {
        for (std::size_t i = 0; i < ticks; ++i, ++tick) {
            const Vec3 at = from + (static_cast<double>(i) / static_cast<double>(ticks)) * (to - from);
            const devices::DeviceSample sample = sample_at(session.touch(), at, tick);
            stage.take(sample, sample.time_ns);
        }
    };
    const Vec3 start = tube.spine_m.front() + 0.5 * tube.cap_depth_m * start_cap(tube).z;
    move(beside(tube, 0.5, 0.09, 0.0), start, 800);
    move(start, start, 300);
    for (std::size_t i = 0; i < 600; ++i) {
        const Vec3 at = beside(tube, static_cast<double>(i) / 2000.0, 0.0, 0.0);
        move(at, at, 1);
    }
    EXPECT_EQ(session.state().phase, StagePhase::running);
    const devices::DeviceSample sample = sample_at(session.touch(), beside(tube, 0.3, 0.0, 0.0), tick);
    const haptics::TickRecord& record = stage.take(sample, sample.time_ns);
    for (std::size_t p = 0; p < 2; ++p)
        EXPECT_LT(glm::distance(record.contact.points[p].proxy_object_m, record.contact.points[p].hip_object_m), 1e-6);
}

}  // namespace
}  // namespace burin::study
