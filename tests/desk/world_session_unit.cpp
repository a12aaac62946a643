// SPDX-License-Identifier: MIT
// A live session of a world: what commands change of its objects, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "compute/engine/chosen_engine.hpp"
#include "desk/live/desk.hpp"
#include "desk/run/session_frames.hpp"
#include "haptics/channels.hpp"
#include "session/drive/executors.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_settings.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

const std::string kTetrahedron = "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string object_text(const std::string& name, const std::string& more) {
    return "[[object]]\nname = \"" + name + "\"\nmesh = \"t.off\"\nmesh_units = \"m\"\n" + more + "\n";
}

// A world of a rock and a bird that flies up and down, with or without a ball that can be carved.
class OpenWorld {
public:
    explicit OpenWorld(bool with_workpiece = false) {
        place_.write("t.off", kTetrahedron);
        place_.write("w.toml", object_text("rock", "material = { stiffness = 900 }") +
                                   object_text("bird",
                                               "position = [0.2, 0.1, 0.0]\nmaterial = { stiffness = 200 }\n"
                                               "[[object.path]]\ntime = 0.0\n[[object.path]]\ntime = 1.0\n"
                                               "position = [0.0, 0.05, 0.0]\n[[object.path]]\ntime = 2.0"));
        options.scene.world = (place_ / "w.toml").string();
        options.scene.no_workpiece = !with_workpiece;
        options.carve.workpiece = {"ball:0.03", 32, false};
        options.carve.engine = compute::EngineChoice::cpu;
        auto made = Desk::create(options, session_wall(options.desk).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        desk->take_loaded();
    }
    // A frame with these commands; then the scene has updated and the frame knows of it.
    void frame(const std::vector<CommandInput>& commands) {
        clock.sleep_until(clock.now_ns() + 10'000'000);
        std::vector<InputEvent> events;
        for (const CommandInput& command : commands) events.push_back({clock.now_ns(), command});
        desk->step({clock.now_ns(), clock.now_ns(), events}, {.size = {640, 360}}, desk->session().newest_tool(),
                   [](const scene::SceneThread::Order& order) { order(); });
        ASSERT_TRUE(desk->session().scene().update(clock.now_ns()));
        static_cast<void>(desk->session().collect({}));
        desk->take_news(Executor::kAllCollected);
    }
    [[nodiscard]] std::vector<double> stiffnesses() {
        std::vector<double> found;
        for (const auto& material : desk->session().channels().parameters.newest().materials)
            found.push_back(material.stiffness_N_per_m);
        return found;
    }
    [[nodiscard]] bool feels(double stiffness_N_per_m) {
        const std::vector<double> all = stiffnesses();
        return std::ranges::find(all, stiffness_N_per_m) != all.end();
    }

    SessionSetup options = carving_setup();
    SimulatedClock clock;
    std::unique_ptr<Desk> desk;

private:
    Workplace place_;
};

std::string told_by(OpenWorld& world, const std::vector<CommandInput>& commands) {
    testing::internal::CaptureStderr();
    world.frame(commands);
    return testing::internal::GetCapturedStderr();
}

}  // namespace

TEST(WorldSession, ItsMaterialsAreThoseOfTheTick) {
    OpenWorld world;
    EXPECT_TRUE(world.feels(900.0) && world.feels(200.0));
    EXPECT_EQ(world.desk->session().channels().parameters.newest().action, haptics::ToolAction::touch);
    world.frame({{"object", {"rock", "stiffness", "333"}}});
    EXPECT_TRUE(world.feels(333.0) && world.feels(200.0));
    EXPECT_FALSE(world.feels(900.0)) << "nothing feels like it any more";
    EXPECT_EQ(world.desk->session().state().world->find(1)->material.stiffness_N_per_m, 333.0);
}

TEST(WorldSession, FrictionThatGrowsWithTheSpeedOfSlidingIsThatOfTheTick) {
    OpenWorld world;
    const auto velocities = [&] {
        std::set<double> found;
        for (const auto& material : world.desk->session().channels().parameters.newest().materials)
            found.insert(material.coulomb_velocity_m_per_s);
        return found;
    };
    EXPECT_EQ(velocities(), std::set{0.0}) << "friction sticks unless somebody says otherwise";
    world.frame({{"object", {"rock", "friction", "0.4"}}, {"object", {"rock", "coulomb-velocity", "0.02"}}});
    EXPECT_EQ(velocities(), (std::set{0.0, 0.02}));
    EXPECT_TRUE(told_by(world, {{"object", {"rock", "coulomb-velocity", "20"}}}).contains("give a number from 0 to 1"));
    EXPECT_EQ(world.desk->session().state().world->find(1)->material.coulomb_velocity_m_per_s, 0.02);
}

TEST(WorldSession, CommandsMoveAndHideObjects) {
    OpenWorld world;
    world.frame({{"object", {"rock", "position", "0.3,0,0"}}, {"object", {"bird", "seen", "off"}}});
    EXPECT_EQ(world.desk->session().scene_side().objects()->pose(1).position_m, Vec3(0.3, 0.0, 0.0));
    const auto scene = world.desk->scene_on(0);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->objects.size(), 1u) << "the bird is not seen";
    world.frame({{"object", {"rock", "colour", "1,0,0"}}});
    EXPECT_EQ(world.desk->scene_on(0)->objects.at(0).colour, Vec3(1.0, 0.0, 0.0));
}

// Who looks into a tube through its end sees its wall from within.
TEST(WorldSession, SheetsAreSeenFromBothSides) {
    scene::SceneObject solid;
    solid.id = 1;
    solid.mesh = std::make_shared<const geometry::TriangleMesh>(
        geometry::TriangleMesh{{Vec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}, {}, {}, {}});
    scene::SceneObject sheet = solid;
    sheet.id = 2;
    sheet.both_sides = true;
    const auto drawn = DrawnWorld(std::vector{solid, sheet}).in_world({});
    ASSERT_EQ(drawn.size(), 2u);
    EXPECT_EQ(drawn[0].mesh->indices.size(), 3u);
    ASSERT_EQ(drawn[1].mesh->indices.size(), 6u);
    const auto normal_of = [&](std::size_t corner) {
        return drawn[1].mesh->vertices[drawn[1].mesh->indices[corner]].normal;
    };
    EXPECT_NE(normal_of(0), normal_of(3)) << "each side is lit as what it is";
}

TEST(WorldSession, WhatMovesIsDrawnWhereItIs) {
    OpenWorld world;
    world.frame({});
    const Vec3 before = world.desk->scene_on(0)->objects.at(1).world_from_mesh.position_m;
    for (int i = 0; i < 50; ++i) world.frame({});
    const double rise = glm::length(world.desk->scene_on(0)->objects.at(1).world_from_mesh.position_m - before) /
                        world.desk->session().state().world_from_object.scale;
    EXPECT_GT(rise, 0.01);
    EXPECT_LT(rise, 0.05);
}

TEST(WorldSession, RefusesWhatItDoesNotKnowAndWhatNeedsAWorkpiece) {
    OpenWorld world;
    EXPECT_TRUE(told_by(world, {{"object", {"rok", "stiffness", "3"}}}).contains("did you mean rock"));
    EXPECT_TRUE(told_by(world, {{"object", {"rock", "stiffness", "-3"}}}).contains("stiffness"));
    EXPECT_TRUE(told_by(world, {{"undo", {}}}).contains("nothing to take back"));
    EXPECT_TRUE(world.feels(900.0)) << "nothing has changed";
}

TEST(WorldSession, RefusesMoreMaterialsThanThereIsRoomFor) {
    WorldObjects many;
    for (std::size_t i = 0; i <= scene::kMaxWorldMaterials; ++i) {
        scene::SceneObject object;
        object.id = i + 1;
        object.name = "o" + std::to_string(i);
        object.material.stiffness_N_per_m = 100.0 + static_cast<double>(std::min(i, scene::kMaxWorldMaterials - 1));
        many.objects.push_back(std::make_shared<const scene::SceneObject>(object));
    }
    const auto one_more = edited(many, {"o15", scene::ObjectProperty::stiffness, {50.0}});
    ASSERT_FALSE(one_more);
    EXPECT_TRUE(one_more.error().line().contains("room for 15 materials")) << one_more.error().line();
    EXPECT_TRUE(edited(many, {"o15", scene::ObjectProperty::stiffness, {100.0}})) << "like another";
}

TEST(WorldSession, AWorkpieceIsCarvedAmongObjects) {
    OpenWorld world(true);
    EXPECT_EQ(world.desk->session().channels().parameters.newest().action, haptics::ToolAction::cut);
    EXPECT_NE(world.desk->session().scene_side().surface(), nullptr);
    world.frame({});
    const geometry::LocalSurface& touched = world.desk->session().channels().surface.newest();
    EXPECT_GE(touched.tiles.triangles + touched.meshes.size(), 1u);
    EXPECT_TRUE(told_by(world, {{"undo", {}}}).contains("no stroke to undo"));
}

// The hand goes into the rock's slanted face, takes hold, and goes aside: in simulated time, through the device.
TEST(WorldSession, TheSecondButtonTakesAnObjectAlong) {
    OpenWorld world;
    Session& s = world.desk->session();
    const scene::MeshPart& objects = *s.scene_side().objects();
    SteppedExecutor executor(world.clock, s.loop(), s.channels_of_parts(), s.scene(),
                             [&](const auto& ended) { static_cast<void>(s.collect(ended)); });
    const Vec3 start = objects.pose(1).position_m;
    bool touched = false;
    const auto frame = [&](std::vector<InputEvent> events) {
        const Nanoseconds now_ns = world.clock.now_ns() + 16'000'000;
        ASSERT_TRUE(executor.advance_to(now_ns));
        for (InputEvent& event : events) event.time_ns = now_ns;
        world.desk->step({now_ns, now_ns, events}, {.size = {640, 400}}, s.newest_tool(),
                         [&](scene::SceneThread::Order order) { executor.order(std::move(order)); });
        world.desk->take_news(executor.take_updates()->collected);
        touched = touched || (s.newest_tool().flags & haptics::kTickInContact) != 0;
    };
    // Straight in from the front until something is touched.
    // From the middle to before the rock's face, at the lower left of the picture.
    frame({{0, MouseMove{{320.0, 200.0}}}});
    for (int i = 1; i <= 20; ++i) frame({{0, MouseMove{{320.0 - 6.65 * i, 200.0 + 4.0 * i}}}});
    for (int i = 0; i < 200 && !touched; ++i) frame({{0, Scroll{{0.0, 1.0}, {}}}});
    ASSERT_TRUE(touched) << "the hand met nothing";
    for (int i = 0; i < 10; ++i) frame({});
    frame({{0, MouseClick{MouseButton::right, true, {}}}});
    for (int i = 0; i < 30; ++i) frame({{0, MouseMove{{187.0 + 2.0 * i, 280.0 - i}}}});
    EXPECT_TRUE(std::holds_alternative<scene::HeldMotion>(objects.object(1).motion));
    EXPECT_GT(glm::length(objects.pose(1).position_m - start), 0.002);
    frame({{0, MouseClick{MouseButton::right, false, {}}}});
    frame({});
    const Vec3 left_at = objects.pose(1).position_m;
    for (int i = 0; i < 20; ++i) frame({{0, MouseMove{{245.0 - 2.0 * i, 251.0}}}});
    EXPECT_EQ(objects.pose(1).position_m, left_at);
    EXPECT_EQ(s.state().world->find(1)->pose.position_m, left_at) << "the frame knows";
}

TEST(SessionSettings, NameTheWorldOfARecording) {
    const OpenWorld world;
    const std::string line = settings_line(world.options);
    EXPECT_TRUE(line.contains("--world ")) << line;
    EXPECT_TRUE(line.contains("--no-workpiece")) << line;
    const SessionSetup none;
    const auto again = options_as_recorded(line, none);
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ(again->options.scene.world, world.options.scene.world);
    EXPECT_TRUE(again->options.scene.no_workpiece);
}

TEST(WorldSession, StrokesAndEditsOfObjectsAreUndoneInTheOrderInWhichTheyWereDone) {
    OpenWorld world(true);
    SessionState state = world.desk->session().state();
    const auto orders_of = [&](const SessionCommand& command) {
        SessionOrders orders;
        EXPECT_TRUE(run_command(state, orders, command));
        return orders;
    };
    const EditObject louder{"rock", scene::ObjectProperty::scale, {2.0}},
        back{"bird", scene::ObjectProperty::scale, {3.0}};
    scene::PartSteps strokes;
    const auto stroke = [&] {
        strokes.last = ++strokes.done;
        ++strokes.made;
        state.history.follow(SessionState::kWorkpiecePart, strokes);
    };
    // What the workpiece says once it has carried an order out: after three of them, since who undoes is quick.
    const auto goes = [&](Action action, scene::StepWay way) {
        const auto orders = orders_of(RunAction{action});
        EXPECT_EQ(orders.world.size(), 0u);
        ASSERT_EQ(orders.goes.size(), 1u);
        EXPECT_EQ(orders.goes[0].part, SessionState::kWorkpiecePart);
        EXPECT_EQ(orders.goes[0].way, way);
        ++strokes.walked;
        strokes.done += way == scene::StepWay::back ? -1 : 1;
    };
    stroke();
    static_cast<void>(orders_of(louder));
    stroke();
    stroke();
    static_cast<void>(orders_of(back));
    EXPECT_EQ(orders_of(RunAction{Action::undo}).world.size(), 1u);
    EXPECT_EQ(state.world->find(2)->scale, 1.0);
    goes(Action::undo, scene::StepWay::back);
    goes(Action::undo, scene::StepWay::back);
    EXPECT_EQ(orders_of(RunAction{Action::undo}).world.size(), 1u);
    EXPECT_EQ(state.world->find(1)->scale, 1.0);
    goes(Action::undo, scene::StepWay::back);
    state.history.follow(SessionState::kWorkpiecePart, strokes);
    goes(Action::redo, scene::StepWay::forward);
    EXPECT_EQ(orders_of(RunAction{Action::redo}).world.size(), 1u);
    EXPECT_EQ(state.world->find(1)->scale, 2.0);
    goes(Action::redo, scene::StepWay::forward);
    // An edit ends what could be repeated, of the workpiece as well.
    const auto edited = orders_of(EditObject{"rock", scene::ObjectProperty::opacity, {0.5}});
    ASSERT_EQ(edited.goes.size(), 1u);
    EXPECT_EQ(edited.goes[0].way, scene::StepWay::forget);
    EXPECT_FALSE(state.history.forward());
}

TEST(WorldSession, WhatAHandHoldsIsNotUndoneUnderIt) {
    OpenWorld world;
    SessionState state = world.desk->session().state();
    SessionOrders orders;
    ASSERT_TRUE(run_command(state, orders, EditObject{"rock", scene::ObjectProperty::scale, {2.0}}));
    auto held = std::make_shared<scene::SceneObject>(*state.world->find(1));
    held->motion = scene::HeldMotion{.parts = {0}, .hand_from_object = {}};
    auto now = std::make_shared<WorldObjects>(*state.world);
    now->objects[0] = held;
    state.world = now;
    const auto undone = run_command(state, orders, RunAction{Action::undo});
    ASSERT_FALSE(undone);
    EXPECT_TRUE(undone.error().line().contains("is held by a hand; let go of it first")) << undone.error().line();
    EXPECT_EQ(state.edits.undoable(), 1u);
}

TEST(WorldSession, AnEditOfWhatAHandHeldIsUndoneWithoutPuttingItBackIntoTheHand) {
    OpenWorld world;
    SessionState state = world.desk->session().state();
    SessionOrders orders;
    const auto with = [&](scene::ObjectMotion motion, double scale) {
        auto object = std::make_shared<scene::SceneObject>(*state.world->find(1));
        object->motion = std::move(motion);
        object->scale = scale;
        auto now = std::make_shared<WorldObjects>(*state.world);
        now->objects[0] = object;
        state.world = now;
    };
    with(scene::HeldMotion{.parts = {0}, .hand_from_object = {}}, 1.0);
    ASSERT_TRUE(run_command(state, orders, EditObject{"rock", scene::ObjectProperty::stiffness, {50.0}}));
    with(scene::FixedMotion{}, 1.0);
    ASSERT_TRUE(run_command(state, orders, RunAction{Action::undo}));
    EXPECT_TRUE(std::holds_alternative<scene::FixedMotion>(state.world->find(1)->motion));
    EXPECT_EQ(state.world->find(1)->material.stiffness_N_per_m, 900.0);
    EXPECT_TRUE(run_command(state, orders, RunAction{Action::redo}));
    EXPECT_EQ(state.world->find(1)->material.stiffness_N_per_m, 50.0);
}

}  // namespace burin::session
