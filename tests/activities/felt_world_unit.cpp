// SPDX-License-Identifier: MIT
// A simulated hand in a small world: it feels each object as its material says.
#include "activities/world/felt_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "activities/world/touch_pictures.hpp"
#include "activities/world/world_view.hpp"
#include "haptics/tick_parameters.hpp"
#include "scene/world_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

std::shared_ptr<const geometry::TriangleMesh> cube(double half_m) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    for (int i = 0; i < 8; ++i)
        mesh->positions_m.emplace_back((i & 1) != 0 ? half_m : -half_m, (i & 2) != 0 ? half_m : -half_m,
                                       (i & 4) != 0 ? half_m : -half_m);
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

constexpr double kHalf_m = 0.01, kApart_m = 0.03, kDeep_m = 0.004;

// Cubes in a row along x, their tops at y = 0.
std::vector<scene::SceneObject> row_of(const std::vector<double>& stiffness_N_per_m) {
    std::vector<scene::SceneObject> objects;
    const auto mesh = cube(kHalf_m);
    for (const double k : stiffness_N_per_m) {
        scene::SceneObject object;
        object.id = objects.size() + 1;
        object.name = "cube " + std::to_string(object.id);
        object.mesh = mesh;
        object.pose.position_m = {kApart_m * static_cast<double>(objects.size()), -kHalf_m, 0.0};
        object.material = {.stiffness_N_per_m = k, .damping_Ns_per_m = 0.3};
        objects.push_back(std::move(object));
    }
    return objects;
}

// Down onto each cube's top, kDeep_m beyond touching, a rest of a second, and up again.
sculpt::Stroke press_on_each(std::size_t cubes, double radius_m) {
    sculpt::Stroke stroke;
    double t = 0.0;
    const auto go = [&](double x, double y, double seconds) {
        t += seconds;
        stroke.push_back({t, {x, y, 0.0}, Quat{1, 0, 0, 0}, false});
    };
    for (std::size_t i = 0; i < cubes; ++i) {
        const double x = kApart_m * static_cast<double>(i);
        go(x, 0.015, 0.5);
        go(x, radius_m - kDeep_m, 0.5);
        go(x, radius_m - kDeep_m, 1.0);
        go(x, 0.015, 0.5);
    }
    return stroke;
}

std::shared_ptr<const scene::World> world_of(std::vector<scene::SceneObject> objects) {
    return std::make_shared<const scene::World>(scene::World{"cubes", std::move(objects), {}});
}

struct Explored {
    ExploredWorld world;
    WorldFigures figures;

    explicit Explored(std::vector<scene::SceneObject> objects) { world.scene = world_of(std::move(objects)); }
    void explore(const sculpt::Stroke& stroke, const ExploreOptions& options, const OnUpdate& on_update = {}) {
        auto done = explore_by_feel(world, stroke, options, on_update);
        ASSERT_TRUE(done) << done.error().line();
        figures = std::move(*done);
    }
    [[nodiscard]] session::DrawnWorld drawn() const { return session::DrawnWorld(world.scene->objects); }
};

}  // namespace

// Force over how far the hand holds the ball inside is the stiffness. (How far that is, the device's friction and the
// grip decide.)
TEST(FeltWorld, EachObjectPushesBackAsItsStiffnessSays) {
    const ExploreOptions options;
    const std::vector<double> stiffness{100.0, 250.0, 500.0};
    Explored world(row_of(stiffness));
    std::vector<double> at_rest_N(stiffness.size(), 0.0), inside_m(stiffness.size(), 0.0);
    const double felt_radius_m = (1.0 - haptics::TickParameters{}.clearance_ratio) * options.tool_radius_m;
    world.explore(press_on_each(stiffness.size(), options.tool_radius_m), options,
                  [&](const WorldMoment& moment) -> Result<void> {
                      const double time_s = moment.time_s;
                      const double in_visit_s = std::fmod(time_s - 0.3, 2.5);
                      const auto visit = static_cast<std::size_t>(std::max(time_s - 0.3, 0.0) / 2.5);
                      if (in_visit_s > 1.4 && in_visit_s < 1.45 && visit < at_rest_N.size()) {
                          at_rest_N[visit] = moment.tool.given.force_device_N.y;
                          inside_m[visit] = felt_radius_m - moment.tool.hip_object_m.y;
                      }
                      return {};
                  });
    ASSERT_EQ(world.figures.touches.size(), stiffness.size());
    for (std::size_t i = 0; i < stiffness.size(); ++i) {
        EXPECT_EQ(world.figures.touches[i].name, "cube " + std::to_string(i + 1));
        EXPECT_GT(inside_m[i], 0.2 * kDeep_m) << stiffness[i];
        EXPECT_LT(inside_m[i], kDeep_m) << stiffness[i];
        EXPECT_NEAR(at_rest_N[i] / inside_m[i], stiffness[i], 0.03 * stiffness[i]);
    }
}

TEST(FeltWorld, MoreThanTheStylusRendersIsToldBesideWhatWasRenderedAndFelt) {
    Explored world(row_of({300.0, 1200.0}));
    world.explore(press_on_each(2, 0.004), {});
    ASSERT_EQ(world.figures.touches.size(), 2u);
    const session::RenderedTally& soft = world.figures.touches[0].wall;
    const session::RenderedTally& hard = world.figures.touches[1].wall;
    EXPECT_EQ(soft.asked().stiffness_N_per_m, 300.0);
    EXPECT_EQ(soft.rendered().stiffness_N_per_m, 300.0);
    EXPECT_EQ(soft.bound(), haptics::StiffnessBound::none);
    EXPECT_NEAR(soft.felt_N_per_m(), 300.0, 9.0);
    EXPECT_EQ(hard.asked().stiffness_N_per_m, 1200.0);
    EXPECT_EQ(hard.rendered().stiffness_N_per_m, 700.0);
    EXPECT_EQ(hard.bound(), haptics::StiffnessBound::device);
    EXPECT_NEAR(hard.felt_N_per_m(), 700.0, 21.0);
    EXPECT_FALSE(hard.is_limited_by_energy());
}

TEST(FeltWorld, WhatIsNotFeltIsPassedAndWhatIsNotSeenIsNotDrawn) {
    std::vector<scene::SceneObject> objects = row_of({300.0, 300.0, 300.0});
    objects[0].felt = false;
    objects[1].seen = false;
    Explored world(std::move(objects));
    const WorldView view(world.drawn(), 0.004);
    EXPECT_EQ(view.wall_scene({}).objects.size(), 2u);
    world.explore(press_on_each(3, 0.004), {});
    ASSERT_EQ(world.figures.touches.size(), 2u);
    EXPECT_EQ(world.figures.touches[0].name, "cube 2");
    EXPECT_EQ(world.figures.touches[1].name, "cube 3");
}

// A cube that rises pushes a hand that rests above it.
TEST(FeltWorld, AnObjectOnItsPathPushesTheHand) {
    std::vector<scene::SceneObject> objects = row_of({300.0});
    objects[0].motion = scene::PathMotion{{{0.0, {}}, {1.0, {{0.0, 0.006, 0.0}}}, {2.0, {}}}, true};
    Explored world(std::move(objects));
    sculpt::Stroke stroke;
    for (const double t : {0.0, 3.7}) stroke.push_back({t, {0.0, 0.006, 0.0}, Quat{1, 0, 0, 0}, false});
    std::vector<Vec3> drawn;
    WorldView view(world.drawn(), 0.004);
    world.explore(stroke, {}, [&](const WorldMoment& moment) -> Result<void> {
        view.take(*moment.drawn);
        drawn.push_back(view.wall_scene({}).objects[0].world_from_mesh.position_m);
        return {};
    });
    ASSERT_EQ(world.figures.touches.size(), 1u);
    EXPECT_GT(world.figures.touches[0].force_max_N, 0.3);
    const auto [lowest, highest] = std::ranges::minmax(drawn, {}, &Vec3::y);
    EXPECT_NEAR(highest.y - lowest.y, 0.006 * view.world_from_scene().scale, 1e-3) << "it is drawn where it is";
}

TEST(FeltWorld, AFailureOfAFrameEndsIt) {
    Explored world(row_of({300.0}));
    const auto done =
        explore_by_feel(world.world, press_on_each(1, 0.004), {}, [](const WorldMoment& moment) -> Result<void> {
            if (moment.time_s < 0.1) return {};
            return fail("picture", "cannot be written", "free some space");
        });
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().where, "picture");
}

// ---- Pictures

TEST(TouchPictures, AreOfTheWorldAtFirstAndOfEachObjectAsItIsFirstPressed) {
    const ExploreOptions options;
    for (const bool draws : {true, false}) {
        Explored world(row_of({250.0, 500.0}));
        std::vector<std::string> drawn;
        PictureDrawer draw;
        if (draws)
            draw = [&](const picture::Picture&, const std::string& file) -> Result<void> {
                drawn.push_back(file);
                return {};
            };
        TouchPictures pictures(*world.world.scene, options.tool_radius_m, draw);
        world.explore(press_on_each(2, options.tool_radius_m), options,
                      [&](const WorldMoment& moment) { return pictures.at(moment); });
        const std::vector<std::string> wanted{"world.png", "touched-1-cube-1.png", "touched-2-cube-2.png"};
        EXPECT_EQ(drawn, draws ? wanted : std::vector<std::string>{});
    }
}

// ---- The command

TEST(ExploreCommand, TellsWhatIsWrongWithItsFiles) {
    struct Case {
        std::string arguments, said;
        int status;
    };
    const Workplace place;
    for (const Case& wrong : std::vector<Case>{{" world", "needs a file", 2},
                                               {" world no-such.toml", "no-such.toml", 1},
                                               {" world no-such.toml --stroke no-such.csv", "no-such.csv", 1},
                                               {" world no-such.toml --radius -1 --stroke a.csv", "--radius", 2}}) {
        const auto outcome = place.run(kBurinCommand + wrong.arguments);
        EXPECT_EQ(outcome.status, wrong.status) << wrong.arguments << "\n" << outcome.output;
        EXPECT_NE(outcome.output.find(wrong.said), std::string::npos) << outcome.output;
    }
}

}  // namespace burin::activities
