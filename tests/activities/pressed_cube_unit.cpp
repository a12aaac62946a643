// SPDX-License-Identifier: MIT
// The cube test with a simulated wand, and that it tells when a sign is wrong.
#include "activities/wand/pressed_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "activities/wand/wand_view.hpp"
#include "base/json.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "scene/vrml_world.hpp"
#include "scene/world_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

constexpr double kBall_m = 0.004, kCubeStiffness_N_per_m = 700.0;  // as assets/worlds/wand-cube.wrl has it

struct CubeScene {
    ExploredWorld world;
    Box bounds_m;

    CubeScene() {
        scene::WorldOrProblems read = scene::read_any_world("assets/worlds/wand-cube.wrl");
        if (!read) return;
        for (const scene::SceneObject& object : read->objects)
            for (const Vec3& p : object.mesh->positions_m) bounds_m.include(object.pose * p);
        world = {.scene = std::make_shared<const scene::World>(std::move(*read)),
                 .device = std::string(devices::kSimulatedWand)};
    }
    [[nodiscard]] Result<PressedCube> test(const devices::WandDescription& wand = {}) {
        return press_cube(world, bounds_m, wand, kBall_m);
    }
};

// The test as it stands, run once for all tests.
const PressedCube& usual() {
    static CubeScene scene;
    static const Result<PressedCube> test = scene.test();
    EXPECT_TRUE(test);
    return *test;
}

const CubeMeasure& measure_of(const PressedCube& test, CubeCase which) {
    return test.measures[static_cast<std::size_t>(which)];
}

}  // namespace

TEST(PressedCube, HasTheSignsOfTheThesis) {
    const PressedCube& test = usual();
    ASSERT_EQ(test.measures.size(), kCubeCases);
    for (const CubeFinding& finding : test.findings)
        EXPECT_TRUE(finding.holds) << text(finding.which) << ": " << finding.expected << "; found " << finding.found;
    EXPECT_TRUE(test.holds());
    EXPECT_LT(measure_of(test, CubeCase::top).mean.given_torque_Nm.x, -0.01);
    EXPECT_GT(measure_of(test, CubeCase::bottom).mean.given_torque_Nm.x, 0.01);
    EXPECT_LT(measure_of(test, CubeCase::both).mean.given_force_N.z,
              1.2 * measure_of(test, CubeCase::top).mean.given_force_N.z)
        << "two springs are stiffer than one";
}

// The force is the stiffness of the file times the depth at which the handle holds the ball, whatever hand and arm do.
TEST(PressedCube, EachEndIsPushedBackAsItsDepthAsks) {
    const PressedCube& test = usual();
    for (const CubeCase which : {CubeCase::top, CubeCase::bottom, CubeCase::both}) {
        const CubeMeasure& m = measure_of(test, which);
        for (std::size_t i = 0; i < 2; ++i) {
            const Vec3& end = i == 0 ? m.mean.top_scene_m : m.mean.bottom_scene_m;
            const double depth_m = end.z + kBall_m - test.face_m;
            const double expected_N = m.mean.touches[i] ? -kCubeStiffness_N_per_m * depth_m : 0.0;
            EXPECT_NEAR(m.mean.point_forces_N[i].z, expected_N, 0.02 * std::abs(expected_N) + 1e-9) << text(which) << i;
        }
    }
}

// The thing that a torque is for: pressed with one end, the wand leans out of the hand's way.
TEST(PressedCube, ATorqueTurnsTheWandInTheHand) {
    const auto leans = [](CubeCase which) {
        const Quat q = measure_of(usual(), which).mean.scene_from_handle.orientation;
        return 2.0 * q.x;
    };
    EXPECT_LT(leans(CubeCase::top), -0.01);
    EXPECT_GT(leans(CubeCase::bottom), 0.01);
    EXPECT_NEAR(leans(CubeCase::both), 0.0, 0.002);
}

TEST(PressedCube, SameRunsGiveSameBits) {
    CubeScene scene;
    const Result<PressedCube> again = scene.test();
    ASSERT_TRUE(again);
    const PressedCube& test = usual();
    ASSERT_EQ(again->two_points.size(), test.two_points.size());
    for (std::size_t i = 0; i < test.two_points.size(); ++i) {
        ASSERT_EQ(again->two_points[i].given_force_N, test.two_points[i].given_force_N) << i;
        ASSERT_EQ(again->two_points[i].scene_from_handle, test.two_points[i].scene_from_handle) << i;
    }
    EXPECT_EQ(test.two_points_run.trips, 0u);
}

TEST(PressedCube, TellsAWrongSign) {
    std::vector<CubeMeasure> measures = usual().measures;
    measures[0].mean.given_torque_Nm.x *= -1.0;
    const std::vector<CubeFinding> findings = findings_of(measures);
    const auto wrong = std::ranges::find(findings, false, &CubeFinding::holds);
    ASSERT_NE(wrong, findings.end());
    EXPECT_EQ(wrong->expected, "negative torque about x");
    measures = usual().measures;
    measures[2].mean.given_force_N.x = 0.1;
    EXPECT_FALSE(std::ranges::all_of(findings_of(measures), &CubeFinding::holds));
    measures = usual().measures;
    measures[3].mean.given_force_N.z = -0.1;
    EXPECT_FALSE(std::ranges::all_of(findings_of(measures), &CubeFinding::holds));
}

// By the thesis' table torque is driven about x and y: then the test holds as well, since nothing turns about z.
TEST(PressedCube, HoldsAlsoWithTheTorquesOfTheThesisTable) {
    devices::WandDescription wand;
    wand.max_torque_maker_Nm = {0.230, 0.250, 0.0};
    CubeScene scene;
    const Result<PressedCube> test = scene.test(wand);
    ASSERT_TRUE(test) << test.error().line();
    EXPECT_TRUE(test->holds());
}

TEST(PressedCube, RefusesACubeThatDoesNotSuit) {
    CubeScene scene;
    ASSERT_NE(scene.world.scene, nullptr);
    const auto refused = [&](const Box& cube) {
        const Result<PressedCube> test = press_cube(scene.world, cube, {}, kBall_m);
        return test ? std::string("not refused") : test.error().line();
    };
    EXPECT_NE(refused({{-0.05, 0.15, -0.05}, {0.05, 0.25, 0.05}}).find("both ends need a face of 168 mm"),
              std::string::npos);
    EXPECT_NE(refused({{-0.2, 0.0, -0.1}, {0.2, 0.4, 0.1}}).find("make it lower"), std::string::npos);
    EXPECT_NE(refused({{0.4, 0.1, -0.1}, {0.6, 0.3, 0.1}}).find("move the cube"), std::string::npos);
}

TEST(PressedCube, FiguresAndTableHoldEveryCase) {
    const PressedCube& test = usual();
    const std::string table = cube_table(test);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(table, '\n')),
              3 + test.two_points.size() + test.one_point.size());
    for (std::size_t i = 0; i < kCubeCases; ++i)
        EXPECT_NE(table.find(text(static_cast<CubeCase>(i))), std::string::npos) << i;
    EXPECT_NE(figure_forces(test).find("Figure 23"), std::string::npos);
    EXPECT_NE(figure_torques(test).find("Figure 24"), std::string::npos);
    EXPECT_NE(figure_sums(test).find("Figure 25"), std::string::npos);
    EXPECT_NE(figure_control(test).find("Figure 15"), std::string::npos);
}

// ---- Which points touch

TEST(WandPoints, AreNamedOrCounted) {
    const devices::WandDescription wand;
    const auto both = points_named(wand, "bottom,top");
    ASSERT_TRUE(both);
    ASSERT_EQ(both->size(), 2u);
    EXPECT_EQ((*both)[0].offset_m.y, -0.08);
    const auto centre = points_named(wand, "centre");
    ASSERT_TRUE(centre);
    EXPECT_EQ(centre->front().offset_m, Vec3(0.0));
    const auto five = points_named(wand, "5");
    ASSERT_TRUE(five);
    ASSERT_EQ(five->size(), 5u);
    EXPECT_NEAR((*five)[1].offset_m.y, 0.04, 1e-15);
    const auto one = points_named(wand, "1");
    ASSERT_TRUE(one);
    EXPECT_EQ(one->front().offset_m, Vec3(0.0));
    for (const char* wrong : {"tpo", "top,,bottom", "", "0", "21", "-1", "top,5"})
        EXPECT_FALSE(points_named(wand, wrong)) << wrong;
    EXPECT_NE(points_named(wand, "tpo").error().line().find("did you mean top?"), std::string::npos);
}

TEST(WandView, DrawsARodAndABallForEachPoint) {
    CubeScene scene;
    const WorldView world(session::DrawnWorld(scene.world.scene->objects), kBall_m);
    const WandView avatar({}, 1.0, kBall_m);
    WandPose pose;
    pose.scene_from_tool = {{0.0, 0.2, -0.11}, {1, 0, 0, 0}};
    pose.points_scene = {{0.0, 0.28, -0.11}, {0.0, 0.2, -0.11}, {0.0, 0.12, -0.11}};
    const picture::Picture drawn = avatar.close_scene(world, pose, {{0, 0.5, -1}, {0.0, 0.2, 0.0}, 0.2});
    ASSERT_EQ(drawn.objects.size(), 1u + 1u + 3u) << "cube, rod, balls";
    const double scale = drawn.objects[1].world_from_mesh.scale;
    // The rod's foot is half a handle below its middle, and the first ball half of 160 mm above it.
    EXPECT_NEAR(drawn.objects[2].world_from_mesh.position_m.y - drawn.objects[1].world_from_mesh.position_m.y,
                scale * (0.0795 + 0.08), 1e-12);
    EXPECT_GT(drawn.objects[2].colour.x, 0.7) << "the top ball is red";
    EXPECT_GT(drawn.objects[4].colour.y, 0.6) << "the bottom ball is green";
    EXPECT_FALSE(drawn.tool.visible);
}

// ---- The command

TEST(DemoWandCommand, WritesFiguresTableAndReportAndPrintsTheSigns) {
    const Workplace place;
    const std::string world = std::filesystem::absolute("assets/worlds/wand-cube.wrl").string();
    const auto outcome =
        place.run(std::string(kBurinCommand) + " demo wand --out w --no-pictures --world '" + world + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("top end alone: negative torque about x"), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find("WRONG"), std::string::npos) << outcome.output;
    const Json report = Json::parse(place.read("w/report.json"));
    EXPECT_EQ(report["as_expected"], true);
    EXPECT_LT(report["cases"][0]["torque_Nm"][0].get<double>(), -0.01);
    for (const char* name : {"figure-15.svg", "figure-23.svg", "figure-24.svg", "figure-25.svg"})
        EXPECT_TRUE(place.read(std::string("w/") + name).starts_with("<svg")) << name;
    EXPECT_EQ(place.run(std::string(kBurinCommand) + " demo wand").status, 2);
    EXPECT_EQ(place.run(std::string(kBurinCommand) + " demo wand --out w --world nothing.wrl").status, 1);
}

// A cube that pulls nothing back: the demo has to say so, and fail.
TEST(DemoWandCommand, FailsWhereTheForcesAreWrong) {
    const Workplace place;
    place.write(
        "soft.wrl",
        "#VRML V2.0 utf8\nPROTO HapticMaterial [ field SFFloat stiffness 1 ] { Material { } }\n"
        "Transform { translation 0 0.2 0 children DEF Cube Shape {\n"
        "appearance Appearance { material HapticMaterial { stiffness 1 } } geometry Box { size .2 .2 .2 } } }\n");
    const auto outcome = place.run(std::string(kBurinCommand) + " demo wand --out w --no-pictures --world soft.wrl");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_NE(outcome.output.find("WRONG"), std::string::npos) << outcome.output;
}

}  // namespace burin::activities
