// SPDX-License-Identifier: MIT
// A wand that explores a world along a stroke with turns.
#include "activities/wand/felt_wand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/json.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "scene/scene_object.hpp"
#include "scene/world_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

constexpr double kWandBall_m = 0.003;

// A plate of 200 mm square whose top is at a height; felt from above.
scene::SceneObject plate(scene::ObjectId id, const std::string& name, const Vec3& middle_of_top) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    const Vec3 half(0.1, 0.01, 0.1);
    for (int i = 0; i < 8; ++i)
        mesh->positions_m.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                       (i & 4) != 0 ? half.z : -half.z);
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    scene::SceneObject object;
    object.id = id;
    object.name = name;
    object.mesh = mesh;
    object.pose.position_m = middle_of_top - Vec3(0.0, half.y, 0.0);
    object.material = {.stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0};
    return object;
}

ExploredWorld plates() {
    return {.scene = std::make_shared<const scene::World>(scene::World{
                "plates", {plate(1, "left", {-0.12, 0.16, 0.0}), plate(2, "right", {0.12, 0.12, 0.0})}, {}}),
            .device = std::string(devices::kSimulatedWand)};
}

// A wand that lies along x: rolled by so much towards it. Its first point is the left one, and goes down.
sculpt::Stroke lowered(double from_m, double to_m, double roll_rad) {
    const Quat lying = glm::angleAxis(roll_rad, Vec3(0, 0, 1));
    sculpt::Stroke stroke;
    for (const auto& [time_s, height_m] : {std::pair(0.0, from_m), std::pair(1.0, to_m), std::pair(2.0, to_m)})
        stroke.push_back({time_s, {0.0, height_m, 0.0}, lying, false});
    return stroke;
}

WandOptions options_with(const std::string& points) {
    WandOptions options;
    options.radius_m = kWandBall_m;
    options.points = *points_named(options.wand, points);
    return options;
}

}  // namespace

TEST(FeltWand, EachPointFeelsTheObjectThatItTouches) {
    // Rolled by 1.3, the top end is 77 mm to the left and 21 mm above the middle, the bottom end to the right and
    // below: they meet the plates, one of which is 40 mm lower, within 3 mm of each other.
    const WandOptions options = options_with("top,bottom");
    const auto explored = explore_with_wand(plates(), lowered(0.18, 0.128, 1.3), options, {});
    ASSERT_TRUE(explored) << explored.error().line();
    EXPECT_FALSE(explored->fitted);
    ASSERT_EQ(explored->touches.size(), 2u);
    EXPECT_EQ(explored->touches[0].object_name, "left");
    EXPECT_EQ(explored->touches[0].point_name, "top");
    EXPECT_EQ(explored->touches[1].object_name, "right");
    EXPECT_EQ(explored->touches[1].point_name, "bottom");
    const WandFelt& last = explored->trace.back();
    Vec3 springs_N(0.0);  // along the deviations, by the stiffness of the plates
    for (const PointFelt& point : last.points) springs_N -= 500.0 * (point.place_m - point.proxy_m);
    const double share = glm::length(last.given_force_N) / glm::length(springs_N);  // what the energy account leaves
    EXPECT_GT(share, 0.5);
    EXPECT_LT(share, 1.01);
    for (const PointFelt& point : last.points) {
        EXPECT_GT(point.force_N.y, 0.1);
        EXPECT_LT(glm::length(point.force_N + share * 500.0 * (point.place_m - point.proxy_m)), 0.03);
    }
    EXPECT_EQ(explored->run.trips, 0u);
    EXPECT_EQ(explored->ticks_faulted, 0u);
}

// It used to say what was asked: 100.3 N of a wand that gave 3.
TEST(FeltWand, APointsForceIsWhatTheWandGave) {
    const WandOptions options = options_with("top,bottom");
    const auto explored = explore_with_wand(plates(), lowered(0.18, 0.1, 1.3), options, {});
    ASSERT_TRUE(explored) << explored.error().line();
    ASSERT_FALSE(explored->touches.empty());
    EXPECT_GT(explored->force_max_N, 1.0);
    for (const PointTouch& touch : explored->touches) {
        EXPECT_GT(touch.force_max_N, 0.1) << touch.object_name;
        EXPECT_LE(touch.force_max_N, explored->force_max_N * (1.0 + 1e-9)) << touch.object_name;
        EXPECT_EQ(touch.wall.asked().stiffness_N_per_m, 500.0);
        EXPECT_EQ(touch.wall.rendered().stiffness_N_per_m, 500.0);
    }
}

TEST(FeltWand, AStrokeOutsideOfTheWorkspaceIsCentredInIt) {
    sculpt::Stroke stroke = lowered(0.18, 0.14, 0.0);
    for (sculpt::StrokeRow& row : stroke) row.position_object_m += Vec3(0.0, 1.0, 0.0);
    const auto explored = explore_with_wand(plates(), stroke, options_with("centre"), {});
    ASSERT_TRUE(explored);
    EXPECT_TRUE(explored->fitted);
    EXPECT_TRUE(explored->touches.empty());
    EXPECT_NEAR(explored->trace.back().scene_from_tool.position_m.y, 1.14, 0.003);
}

TEST(FeltWand, AFailureOfAMomentEndsIt) {
    const auto failed = explore_with_wand(plates(), lowered(0.2, 0.18, 0.0), options_with("3"),
                                          [](const WandMoment& moment) -> Result<void> {
                                              if (moment.time_s < 0.1) return {};
                                              return fail("picture", "cannot be written");
                                          });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().where, "picture");
}

// Rodrigues' formula, as the thesis has it, from what axis_angle() gives.
TEST(FeltWand, AxisAndAngleTurnAsTheQuaternionDoes) {
    for (const Quat& q : {glm::normalize(Quat(0.9, 0.1, -0.3, 0.2)), glm::normalize(Quat(-0.2, 0.5, 0.1, -0.7)),
                          Quat(0.0, 0.0, 1.0, 0.0)}) {
        const AxisAngle turn = axis_angle(q);
        EXPECT_NEAR(glm::length(turn.axis), 1.0, 1e-15);
        const Vec3 v(0.3, -0.7, 0.2), &k = turn.axis;
        const double c = std::cos(turn.angle_rad), s = std::sin(turn.angle_rad);
        EXPECT_LT(glm::length(c * v + s * glm::cross(k, v) + (1.0 - c) * glm::dot(k, v) * k - q * v), 1e-14);
    }
    EXPECT_EQ(axis_angle(Quat(1, 0, 0, 0)).angle_rad, 0.0);
}

TEST(FeltWand, TheTableHasALineAnUpdateAndAColumnEach) {
    const WandOptions options = options_with("top,centre,bottom");
    const auto explored = explore_with_wand(plates(), lowered(0.18, 0.14, 1.3), options, {});
    ASSERT_TRUE(explored);
    std::istringstream table(wand_table(*explored, *plates().scene, options.points));
    std::string line;
    std::size_t lines = 0, columns = 0;
    while (std::getline(table, line)) {
        const auto here = static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
        if (lines == 0) columns = here;
        ASSERT_EQ(here, columns) << line;
        ++lines;
    }
    EXPECT_EQ(columns, 8u + 3u * 13u + 12u);
    EXPECT_EQ(lines, 1 + explored->trace.size());
    EXPECT_TRUE(wand_figure(*explored, options.points).starts_with("<svg"));
}

// ---- The command

TEST(ExploreWithWandCommand, TellsWhatEachEndFeltInTheTube) {
    const Workplace place;
    const std::string assets = std::filesystem::absolute("assets").string();
    const auto outcome = place.run(std::string(kBurinCommand) + " world '" + assets + "/worlds/tube.wrl' --stroke '" +
                                   assets + "/strokes/tube.csv' --device 'simulated-wand:" + assets +
                                   "/devices/short-wand.toml' --report r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const Json report = Json::parse(place.read("r.json"));
    EXPECT_EQ(report["amplifiers_tripped"], 0);
    EXPECT_EQ(report["motion_fitted"], false);
    std::set<std::string> tube_points;
    for (const Json& touch : report["touches"])
        if (touch["object"] == "Tube") tube_points.insert(touch["point"].get<std::string>());
    EXPECT_EQ(tube_points, (std::set<std::string>{"bottom", "top"})) << outcome.output;
    EXPECT_TRUE(place.read("r-felt.csv").starts_with("time_s,x_m"));
    EXPECT_TRUE(place.read("r-felt.svg").starts_with("<svg"));
}

// The points were said to be top and bottom, which such a description does not have.
TEST(ExploreWithWandCommand, TouchesWithThePointsThatTheDescriptionNames) {
    const Workplace place;
    place.write(
        "wand.toml",
        "[[point]]\nname = \"tip\"\noffset = [0, 0.08, 0]\n[[point]]\nname = \"tail\"\noffset = [0, -0.08, 0]\n");
    place.write("w.wrl", "#VRML V2.0 utf8\nDEF Block Shape { geometry Box { size 0.1 0.1 0.1 } }\n");
    place.write("s.csv", "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n0,0,0.2,0,0,0,0,1,0\n0.2,0,0.1,0,0,0,0,1,0\n");
    const std::string burin = kBurinCommand;
    const auto felt = place.run(burin +
                                " world w.wrl --stroke s.csv --device simulated-wand:wand.toml --report r.json "
                                "--record a.session");
    ASSERT_EQ(felt.status, 0) << felt.output;
    EXPECT_EQ(Json::parse(place.read("r.json"))["points"], (Json{"tip", "tail"}));
    EXPECT_EQ(place.run(burin + " replay a.session").status, 0);
    const auto through = place.run(burin + " replay a.session --through w.wrl");
    EXPECT_EQ(through.status, 0) << through.output;
    EXPECT_NE(through.output.find("the proxy of tail begins at the hand"), std::string::npos) << through.output;
}

TEST(ExploreWithWandCommand, RefusesWhatItDoesNotKnow) {
    const Workplace place;
    const std::string world = std::string(kBurinCommand) + " world w.wrl --stroke s.csv --device ";
    const auto unknown = place.run(world + "simulated-wandd");
    EXPECT_EQ(unknown.status, 2) << unknown.output;
    const auto missing = place.run(world + "simulated-wand:none.toml");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find("none.toml"), std::string::npos) << missing.output;
    const auto points = place.run(world + "simulated-wand --points top,botom");
    EXPECT_EQ(points.status, 1);
    EXPECT_NE(points.output.find("did you mean bottom?"), std::string::npos) << points.output;
}

}  // namespace burin::activities
