// SPDX-License-Identifier: MIT
// Paths that the wand can do and cannot: caps, mouths and workspace.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/text.hpp"
#include "study/felt/reach.hpp"
#include "study/felt/stage_touch.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {
namespace {

// A path along x whose start slopes by so much, its middle in the workspace.
StudyWorld sloping(double degrees, double cap_depth_m = 0.02) {
    const double slope = degrees * devices::kDegree_rad;
    StudyWorld world;
    world.name = "ramp";
    world.tube_radius_m = 0.045;
    world.cap_half_width_m = 0.068;
    world.cap_depth_m = cap_depth_m;
    world.funnel_half_width_m = 0.045;
    const Vec3 first(-0.1, 0.2, 0.0);
    world.spine_m = {first, first + 0.03 * Vec3(std::cos(slope), std::sin(slope), 0.0), Vec3(0.1, 0.2, 0.0)};
    world.spine_m.insert(world.spine_m.end() - 1, Vec3(0.06, 0.2, 0.0));
    return world;
}

std::vector<ReachFault> faults_of(const StudyWorld& world, const Protocol& protocol = {}) {
    const auto felt = FeltWorld::create(world);
    EXPECT_TRUE(felt);
    return reach_faults(protocol, world, (*felt)->bounds());
}

// Whether some place of the middle, tried on a fine grid, has both points in the cap by the rule that trials go by.
bool held_somewhere(const CapBox& cap, double offset_m) {
    constexpr int kPlaces = 60;
    for (int x = -kPlaces; x <= kPlaces; x += 6)
        for (int y = -kPlaces; y <= kPlaces; ++y)
            for (int z = 0; z <= kPlaces; ++z) {
                const Vec3 middle = cap.centre_m + cap.half_width_m * (double(x) * cap.x + double(y) * cap.y) / 60.0 +
                                    cap.depth_m * double(z) / 60.0 * cap.z;
                const Vec3 up(0.0, offset_m, 0.0);
                if (inside(cap, middle + up, middle + up) && inside(cap, middle - up, middle - up)) return true;
            }
    return false;
}

TEST(Reach, RefusesACapThatAnUprightWandsPointsAreTooFarApartFor) {
    // 60 mm apart and 20 mm deep: sin(slope) is 1/3 at most.
    EXPECT_NEAR(std::asin(1.0 / 3.0) / devices::kDegree_rad, 19.47, 0.005);
    for (const double degrees : {0.0, 10.0, 19.4, -19.4}) EXPECT_TRUE(faults_of(sloping(degrees)).empty()) << degrees;
    for (const double degrees : {19.5, 20.0, 45.0, -20.0}) {
        const auto faults = faults_of(sloping(degrees));
        ASSERT_EQ(faults.size(), 1u) << degrees;
        EXPECT_TRUE(faults[0].what.contains(
            formatted("the start cap cannot hold both points at %.1f degrees", std::abs(degrees))))
            << faults[0].what;
        EXPECT_TRUE(faults[0].remedy.contains("cap_depth_m")) << faults[0].remedy;
    }
    EXPECT_TRUE(faults_of(sloping(20.0, 0.021)).empty()) << "deeper";
    Protocol near;
    near.point_offset_m = 0.02;
    EXPECT_TRUE(faults_of(sloping(20.0), near).empty()) << "points nearer to each other";
}

TEST(Reach, AgreesWithTheRuleByWhichTrialsGo) {
    const devices::WandDescription wand = study_wand({});
    for (const double degrees : {0.0, 5.0, 15.0, 18.0, 21.0, 30.0, 60.0, 89.0}) {
        for (const double depth_m : {0.01, 0.02, 0.04, 0.07}) {
            const CapBox cap = start_cap(sloping(degrees, depth_m));
            const CapReach reach = cap_reach(cap, wand, {Vec3(-10.0), Vec3(10.0)});
            if (std::abs(reach.room_m) < 0.002) continue;  // the grid's step
            EXPECT_EQ(reach.fits(), held_somewhere(cap, 0.03)) << degrees << " degrees, " << depth_m << " m";
        }
    }
}

TEST(Reach, TellsTheLeastLeanWithWhichAWandWouldFit) {
    const devices::WandDescription wand = study_wand({});
    const Box anywhere{Vec3(-10.0), Vec3(10.0)};
    const CapReach reach = cap_reach(start_cap(sloping(30.0)), wand, anywhere);
    EXPECT_FALSE(reach.fits());
    ASSERT_TRUE(reach.least_lean_degrees);
    EXPECT_NEAR(*reach.least_lean_degrees, 30.0 - 19.47, 1.0);
    EXPECT_EQ(cap_reach(start_cap(sloping(10.0)), wand, anywhere).least_lean_degrees, 0.0);
    devices::WandDescription stiff = wand;
    stiff.lowest_turn_rad = stiff.highest_turn_rad = Vec3(0.0);
    EXPECT_FALSE(cap_reach(start_cap(sloping(30.0)), stiff, anywhere).least_lean_degrees);
}

TEST(Reach, RefusesWhatLiesBeyondTheWandsWorkspace) {
    StudyWorld wide = sloping(0.0);
    for (Vec3& p : wide.spine_m) p.x *= 4.0;  // 0.8 m; the wand reaches 0.48
    const auto faults = faults_of(wide);
    ASSERT_EQ(faults.size(), 3u);
    EXPECT_TRUE(faults[0].what.contains("the start cap cannot be reached")) << faults[0].what;
    EXPECT_TRUE(faults[1].what.contains("the end cap cannot be reached")) << faults[1].what;
    EXPECT_TRUE(faults[2].what.contains("the path goes 160 mm beyond")) << faults[2].what;
    StudyWorld elsewhere = sloping(0.0);
    for (Vec3& p : elsewhere.spine_m) p += Vec3(3.0, 0.0, 0.0);
    EXPECT_TRUE(faults_of(elsewhere).empty()) << "a world is centred in the workspace";
}

TEST(Reach, RefusesAMouthThatBothPointsDoNotPass) {
    StudyWorld narrow = sloping(0.0);
    narrow.funnel_half_width_m = 0.029;
    EXPECT_EQ(faults_of(narrow).size(), 2u) << "at either end";
    narrow.funnel_half_width_m = 0.045;
    narrow.tube_radius_m = 0.029;
    EXPECT_EQ(faults_of(narrow).size(), 2u);
}

TEST(Reach, IsCheckedBeforeAStudyIsMade) {
    const Workplace place;
    const std::string study = std::string(kBurinCommand) + " study ";
    std::string text{known_protocol("kinesthetic-path").value()};
    EXPECT_EQ(place.run(study + "check " + "/dev/null").status, 1);
    place.write("good.toml", text);
    const auto good = place.run(study + "check good.toml");
    EXPECT_EQ(good.status, 0) << good.output;
    const std::size_t spine = text.find("spine_m"), end = text.find("\n]", spine);
    text.replace(spine, end + 2 - spine,
                 "spine_m = [[-0.16, 0.205, -0.04], [-0.12, 0.19, -0.03], [0.0, 0.16, 0.0], "
                 "[0.12, 0.19, -0.03], [0.16, 0.205, -0.04]]");
    place.write("thin.toml", text);
    for (const std::string command : {"check thin.toml", "init thin.toml s"}) {
        const auto refused = place.run(study + command);
        EXPECT_EQ(refused.status, 1) << refused.output;
        EXPECT_TRUE(refused.output.contains("the start cap cannot hold both points at 20.0 degrees")) << refused.output;
        EXPECT_TRUE(refused.output.contains("the end cap cannot hold both points at 20.0 degrees")) << refused.output;
    }
    EXPECT_FALSE(std::filesystem::exists(place / "s"));
}

}  // namespace
}  // namespace burin::study
