// SPDX-License-Identifier: MIT
// The session's state and its carving side, without any picture.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "haptics/tick.hpp"
#include "sculpt/sculpt_thread.hpp"
#include "sculpt/workpiece.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

Room test_room() {
    Room room;
    room.workpiece_object = {Vec3(-0.1), Vec3(0.1)};
    room.wall = *session_wall({});
    room.desk.home_head_world = {{0.0, 1.6, 2.0}, Quat{1, 0, 0, 0}};
    return room;
}

constexpr sculpt::ToolSizes kBall_m{0.01};

SessionState test_state(const Room& room) {
    return begin_session(room, {.shape = {sculpt::ToolKind::ball, kBall_m, {}}}, {}, {});
}

Result<void> run(SessionState& state, SessionOrders& orders, const std::string& name,
                 std::vector<std::string> arguments = {}) {
    return run_command(state, orders, {name, std::move(arguments)});
}

// A ball under a tool that a script moves by hand-made samples.
struct Bench {
    WorkerPool pool{1};
    sculpt::Sculpture carving;
    haptics::HapticChannels channels;
    sculpt::SculptService desk;

    Bench() : carving(engine(pool), pool), desk(carving, channels, tool(), 0.0, 0.02, 1 << 24) {
        desk.start_at({0.0, 0.0, 0.15});
    }
    static std::unique_ptr<compute::CarvingEngine> engine(WorkerPool& pool) {
        return std::move(
            sculpt::choose_engine(sculpt::EngineChoice::cpu, *compute::make_ball(0.1, 32, {"skin"}), pool)->engine);
    }
    static sculpt::Tool tool() { return {compute::BallTool{0.02}}; }
    // The tool at a place, with its button up or down; material without hardness goes away where the hand is.
    void sample(const Vec3& place, bool pressed) {
        haptics::StrokeSample s;
        s.tick = ++ticks;
        s.time_ns = static_cast<Nanoseconds>(ticks) * 1'000'000;
        s.position_object_m = s.cut_object_m = s.proxy_object_m = place;
        s.buttons = pressed ? 1u : 0u;
        ASSERT_TRUE(channels.stroke.push(s));
    }
    void stroke() {
        for (int i = 0; i < 10; ++i) sample({0.01 * i - 0.05, 0.0, 0.1}, true);
        sample({0.05, 0.0, 0.2}, false);
    }
    std::uint64_t ticks = 0;
};

}  // namespace

TEST(SessionState, BeginsWithTheWorkpieceInViewAndTheHandBeforeIt) {
    const Room room = test_room();
    const SessionState state = test_state(room);
    const renderer::Scene scene = *scene_of(state, room, 0, Vec3(-0.1), {});
    const wall::Eyes eyes = wall::eyes_of(scene.viewer);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 0.1 : -0.1, corner & 2 ? 0.1 : -0.1, corner & 4 ? 0.1 : -0.1};
        const Vec3 at = state.world_from_object * p;
        EXPECT_LT(at.z, eyes.left_world.z - 0.3);
        EXPECT_GT(at.y, 0.0);
    }
    const Vec3 hand = state.world_from_device * state.desk.target_device_m;
    EXPECT_GT(hand.z, (state.world_from_object * Vec3(0.0, 0.0, 0.1)).z) << "in front of the workpiece";
    EXPECT_TRUE(haptics::parameters_are_sensible(parameters_of(state, room)));
}

TEST(SessionState, AToolThatIsWrongLeavesTheOldOne) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    for (const auto& [name, argument] : std::vector<std::pair<std::string, std::string>>{{"radius", "0"},
                                                                                         {"radius", "x"},
                                                                                         {"tool", "ball:"},
                                                                                         {"tool", "box:0.1,0.1,0.1"},
                                                                                         {"stiffness", "200000"},
                                                                                         {"colour", "red"},
                                                                                         {"hardness", "-3"},
                                                                                         {"friction", "nan"},
                                                                                         {"operation", "drill"},
                                                                                         {"technique", "teleport"},
                                                                                         {"stereo-mode", "hologram"},
                                                                                         {"force-filter", "1"}}) {
        const auto refused = run(state, orders, name, {argument});
        ASSERT_FALSE(refused) << name << " " << argument;
        EXPECT_FALSE(refused.error().line().empty());
    }
    EXPECT_EQ(state.tool, test_state(room).tool);
    EXPECT_EQ(state.feel, test_state(room).feel);
    EXPECT_TRUE(orders.carving.empty());
    EXPECT_FALSE(orders.parameters);
}

TEST(SessionState, EveryCommandThatChangesTheToolTellsCarvingAndTouch) {
    const Room room = test_room();
    for (const auto& [name, argument] : std::vector<std::pair<std::string, std::string>>{{"radius", "0.02"},
                                                                                         {"tool", "ball:0.03"},
                                                                                         {"colour", "0.1,0.2,0.3"},
                                                                                         {"operation", "fill"},
                                                                                         {"hardness", "500000"},
                                                                                         {"friction", "0.3"},
                                                                                         {"stiffness", "400"}}) {
        SessionState state = test_state(room);
        SessionOrders orders;
        ASSERT_TRUE(run(state, orders, name, {argument})) << name;
        EXPECT_EQ(orders.carving.size(), 1u) << name;
        EXPECT_TRUE(orders.parameters) << name;
        EXPECT_TRUE(haptics::parameters_are_sensible(parameters_of(state, room))) << name;
    }
}

TEST(SessionState, OnlyTouchingEndsWithTheNextTool) {
    const Room room = test_room();
    for (const auto& [name, arguments] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"tool-1", {}}, {"tool-2", {}}, {"tool-3", {}}, {"tool-4", {}}, {"operation", {"cut"}}}) {
        SessionState state = test_state(room);
        SessionOrders orders;
        ASSERT_TRUE(run(state, orders, "tool-5"));
        EXPECT_TRUE(std::isinf(parameters_of(state, room).materials[0].hardness_Ns_per_m3)) << "it can be cut";
        ASSERT_TRUE(run(state, orders, name, arguments)) << name;
        EXPECT_TRUE(std::isfinite(parameters_of(state, room).materials[0].hardness_Ns_per_m3)) << name;
        const auto* use = std::get_if<sculpt::UseTool>(&orders.carving.back());
        ASSERT_NE(use, nullptr) << name;
        EXPECT_TRUE(std::isfinite(use->hardness_Ns_per_m3)) << name;
    }
}

// A step reads no file: the same events would give another state when it has changed.
TEST(SessionState, AMeshToolIsRefusedWithoutALookAtItsFile) {
    const Room room = test_room();
    for (const char* file : {"assets/workpieces/soccer_ball.obj", "no/such/file.stl"}) {
        SessionState state = test_state(room);
        SessionOrders orders;
        const auto refused = run(state, orders, "tool", {"mesh:" + std::string(file)});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().line(),
                  "tool mesh:" + std::string(file) + ": cannot be felt: the hand feels with a ball; use ball:R");
    }
}

// Recordings hold commands and are replayed to the bit, so what these make of a state must not change.
TEST(SessionState, CommandsSetToolAndFeelToTheBitsTheyAlwaysHad) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    ASSERT_TRUE(run(state, orders, "larger-radius"));
    EXPECT_EQ(state.tool.shape.sizes_m[0], 0.01122462) << "nine digits";
    ASSERT_TRUE(run(state, orders, "larger-radius"));
    EXPECT_EQ(state.tool.shape.sizes_m[0], 0.0125992094) << "of 0.01259920941444";
    ASSERT_TRUE(run(state, orders, "radius", {"0.00123456789123"}));
    EXPECT_EQ(state.tool.shape.sizes_m[0], 0.00123456789);
    ASSERT_TRUE(run(state, orders, "tool", {"ball:0.00123456789123"}));
    EXPECT_EQ(state.tool.shape.sizes_m[0], 0.00123456789123) << "a tool's own sizes are kept as they are";
    state.feel = {.preset = sculpt::FeelPreset::soft};
    ASSERT_TRUE(run(state, orders, "hardness", {"1234567.891234"}));
    const haptics::TouchMaterial material = parameters_of(state, room).materials[0];
    EXPECT_EQ(material.hardness_Ns_per_m3, 1.23456789 * 1e6);
    EXPECT_EQ(material.stiffness_N_per_m, 600.0) << "the medium preset's, as with --hardness and a number";
    ASSERT_TRUE(run(state, orders, "colour", {"0.1,0.5,1"}));
    EXPECT_EQ(sculpt::material_of(state.tool).colour, (std::array<std::uint8_t, 3>{26, 128, 255}));
}

TEST(SessionState, EveryQuantityIsReadWhereItsCommandSetIt) {
    const Room room = test_room();
    for (const QuantityDescriptor& quantity : quantities()) {
        SessionState state = test_state(room);
        SessionOrders orders;
        const double middle = quantity.by_ratio ? std::sqrt(quantity.from * quantity.to) : 0.5 * quantity.to;
        ASSERT_TRUE(run(state, orders, std::string(quantity.name), {std::to_string(middle)})) << quantity.name;
        EXPECT_NEAR(quantity.value(state), middle, 1e-3 * middle) << quantity.name;
        EXPECT_EQ(&descriptor_of(quantity.quantity), &quantity);
        const bool seen = quantity.concern == QuantityConcern::picture;
        EXPECT_EQ(orders.parameters, !seen) << quantity.name;
        EXPECT_EQ(orders.carving.size(), quantity.concern == QuantityConcern::tool_and_touch ? 1u : 0u);
    }
}

TEST(SessionState, TheNextTechniqueComesRoundToTheFirstOverAllOthers) {
    SessionState state = test_state(test_room());
    SessionOrders orders;
    for (std::size_t i = 1; i <= techniques().size(); ++i) {
        ASSERT_TRUE(run(state, orders, "next-workspace-technique"));
        EXPECT_EQ(state.technique, techniques()[i % techniques().size()].technique);
        EXPECT_EQ(descriptor_of(state.technique).name, haptics::text(state.technique));
    }
}

TEST(SessionState, TheNextStereoModeComesRoundToTheFirst) {
    SessionState state = test_state(test_room());
    SessionOrders orders;
    const wall::StereoMode first = state.output.mode;
    int steps = 0;
    do {
        ASSERT_TRUE(run(state, orders, "next-stereo-mode"));
        EXPECT_NE(state.output.mode, wall::StereoMode::two_windows) << "one window cannot show it";
    } while (state.output.mode != first && ++steps < 100);
    EXPECT_EQ(steps, 12) << "thirteen modes";
}

TEST(SessionState, TurningTheSceneTakesTheWorkpieceAndNotTheHand) {
    const Room room = test_room();
    SessionState state = test_state(room);
    const std::vector<InputEvent> events{{0, MouseMove{{100, 100}}},
                                         {0, MouseClick{MouseButton::middle, true, {}}},
                                         {0, MouseMove{{160, 100}}},
                                         {0, MouseClick{MouseButton::middle, false, {}}}};
    const SessionStep step =
        step_session(state, room, events, {.dt_s = 0.02, .eye_size = {1280, 720}, .tool = {}, .captured = {}});
    EXPECT_TRUE(step.orders.parameters);
    EXPECT_NE(step.state.world_from_object.orientation, state.world_from_object.orientation);
    const Vec3 middle = state.world_from_object * room.workpiece_object.center();
    EXPECT_LT(glm::length(step.state.world_from_object * room.workpiece_object.center() - middle), 1e-9);
    // The hand's workspace stays where it was in the room.
    const Similarity before = state.world_from_object * parameters_of(state, room).workspace.object_from_device;
    const Similarity after =
        step.state.world_from_object * parameters_of(step.state, room).workspace.object_from_device;
    EXPECT_LT(glm::length(before.position_m - after.position_m), 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(before.orientation, after.orientation)), 1.0, 1e-12);
}

TEST(SculptService, OnePressIsOneUndoAlsoWhereTheToolLosesTouch) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    static_cast<void>(bench.desk.take_surface_update());
    // Pressed twice into the ball's front without letting go, paused between in an update of its own.
    for (const double z : {0.1, 0.2, 0.1}) {
        for (int i = 0; i < 5; ++i) bench.sample({0.01 * i, 0.0, z}, true);
        ASSERT_TRUE(bench.desk.update(0));
    }
    bench.sample({0.05, 0.0, 0.2}, false);
    ASSERT_TRUE(bench.desk.update(0));
    const auto news = bench.desk.take_surface_update();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->undoable, 1u);
}

TEST(SculptService, OneStrokeIsOneUndoAndNewsTellOnlyWhatChanged) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    const auto first = bench.desk.take_surface_update();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->undoable, 0u);
    EXPECT_FALSE(bench.desk.take_surface_update()) << "nothing has happened since";
    bench.stroke();
    ASSERT_TRUE(bench.desk.update(20'000'000));
    ASSERT_TRUE(bench.desk.update(30'000'000));
    const auto carved = bench.desk.take_surface_update();
    ASSERT_TRUE(carved);
    EXPECT_EQ(carved->undoable, 1u);
    EXPECT_GT(carved->cut_ns, 0);
    EXPECT_FALSE(carved->tiles.empty());
    EXPECT_LT(carved->tiles.size(), first->tiles.size());
    bench.desk.order(sculpt::UndoStroke{});
    const auto undone = bench.desk.take_surface_update();
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->undoable, 0u);
    EXPECT_EQ(undone->redoable, 1u);
    EXPECT_EQ(undone->tiles.size(), carved->tiles.size());
}

// Orders come while strokes are carved on another thread; what is left is what the same orders leave one after the
// other.
TEST(SculptThread, CarvesAndTakesOrdersBesideTheFrame) {
    MonotonicClock clock;
    Bench bench;
    sculpt::SculptThread thread(bench.desk, clock, [] {});
    bench.stroke();
    thread.start();
    std::optional<sculpt::SurfaceUpdate> seen;
    const auto gather_until = [&](auto&& enough) {
        for (int i = 0; i < 3000 && !(seen && enough(*seen)); ++i) {  // a guard against hanging, not a measure
            sculpt::add(seen, thread.take_surface_update().surface);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    };
    gather_until([](const sculpt::SurfaceUpdate& n) { return n.undoable == 1; });
    ASSERT_TRUE(seen && seen->undoable == 1);
    thread.order(sculpt::UndoStroke{});
    gather_until([](const sculpt::SurfaceUpdate& n) { return n.redoable == 1; });
    ASSERT_EQ(seen->redoable, 1u);
    thread.order(sculpt::RedoStroke{});
    thread.stop();  // carries out what was ordered
    EXPECT_FALSE(thread.failure());
    EXPECT_EQ(bench.carving.history()->undoable(), 1u);

    Bench alone;
    alone.stroke();
    ASSERT_TRUE(alone.desk.update(0));
    ASSERT_TRUE(alone.desk.update(0));
    EXPECT_TRUE(bench.carving.engine().solid().same_content(alone.carving.engine().solid()));
}

// ---- Strokes and undo

namespace {
// A press at a place of its own on the ball's front, each of which carves.
void press_at(Bench& bench, double x) {
    for (int i = 0; i < 5; ++i) bench.sample({x, 0.002 * i, 0.09}, true);
}
void release_at(Bench& bench, double x) { bench.sample({x, 0.0, 0.2}, false); }

// Undoes one stroke after the other; what was left each time must be what the strokes before it leave alone.
void expect_each_is_undone_alone(Bench& bench, const std::vector<double>& strokes) {
    for (std::size_t left = strokes.size(); left-- > 0;) {
        ASSERT_EQ(bench.carving.history()->undoable(), left + 1);
        bench.desk.order(sculpt::UndoStroke{});
        Bench alone;
        for (std::size_t i = 0; i < left; ++i) {
            press_at(alone, strokes[i]);
            release_at(alone, strokes[i]);
        }
        ASSERT_TRUE(alone.desk.update(0));
        EXPECT_TRUE(bench.carving.engine().solid().same_content(alone.carving.engine().solid())) << left;
    }
    EXPECT_EQ(bench.carving.history()->undoable(), 0u);
}
}  // namespace

TEST(SculptService, EachReleaseOfTheButtonEndsAStrokeThatIsUndoneAlone) {
    const std::vector<double> strokes{-0.05, 0.0, 0.05};
    Bench bench;
    for (const double x : strokes) {  // as in a session: pressed over several updates, released in a later one
        press_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
        press_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
        release_at(bench, x);
        ASSERT_TRUE(bench.desk.update(0));
    }
    expect_each_is_undone_alone(bench, strokes);
}

TEST(SculptService, QuickClicksAreStrokesOfTheirOwnAlsoWithinOneUpdate) {
    const std::vector<double> strokes{-0.05, 0.0, 0.05};
    Bench bench;
    press_at(bench, strokes[0]);  // pressed and released between two updates
    release_at(bench, strokes[0]);
    ASSERT_TRUE(bench.desk.update(0));
    for (const double x : {strokes[1], strokes[2]}) {  // carving came late: two clicks wait for it
        press_at(bench, x);
        release_at(bench, x);
    }
    ASSERT_TRUE(bench.desk.update(0));
    EXPECT_FALSE(bench.channels.stroke.oldest()) << "all samples were taken";
    expect_each_is_undone_alone(bench, strokes);
}

TEST(SurfaceUpdate, MergedTellsTheNewestOfEverythingAndEveryMessage) {
    const auto tile = std::make_shared<const geometry::SurfaceTile>();
    sculpt::SurfaceUpdate news, later;
    news.tiles = {{3, nullptr, nullptr}, {5, tile, nullptr}};
    news.inner_boxes_object = {Box{Vec3(0.0), Vec3(1.0)}};
    news.cut_ns = 1000;
    news.undoable = 1, news.redoable = 2;
    news.exporting = true;
    news.messages = {"first"};
    later.tiles = {{3, tile, nullptr}, {7, tile, nullptr}};
    later.inner_boxes_object = {Box{Vec3(0.0), Vec3(2.0)}};
    later.cut_ns = 2000;
    later.undoable = 4, later.redoable = 0;
    later.messages = {"second"};
    sculpt::merge(news, later);
    ASSERT_EQ(news.tiles.size(), 3u);
    EXPECT_EQ(news.tiles[0].tile, 3u);
    EXPECT_EQ(news.tiles[0].surface, tile) << "the later one of the same tile";
    EXPECT_EQ(news.tiles[1].tile, 5u);
    EXPECT_EQ(news.tiles[2].tile, 7u);
    ASSERT_EQ(news.inner_boxes_object.size(), 1u);
    EXPECT_EQ(news.inner_boxes_object[0].hi, Vec3(2.0));
    EXPECT_EQ(news.cut_ns, 2000);
    EXPECT_EQ(news.undoable, 4u);
    EXPECT_EQ(news.redoable, 0u);
    EXPECT_FALSE(news.exporting) << "it has ended";
    EXPECT_EQ(news.messages, (std::vector<std::string>{"first", "second"}));
    sculpt::merge(news, {});  // news of a desk that has not cut since it was made
    EXPECT_EQ(news.cut_ns, 2000);
}

// ---- Where the tool works

namespace {
// As Bench::sample, with all places of its own.
void push(Bench& bench, const Vec3& hand, const Vec3& proxy, std::uint32_t flags,
          haptics::WorkspacePhase phase = haptics::WorkspacePhase::editing) {
    haptics::StrokeSample s;
    s.tick = ++bench.ticks;
    s.time_ns = static_cast<Nanoseconds>(s.tick) * 1'000'000;
    s.position_object_m = s.cut_object_m = hand;
    s.proxy_object_m = proxy;
    s.buttons = 1;
    s.flags = flags;
    s.phase = phase;
    ASSERT_TRUE(bench.channels.stroke.push(s));
}

std::uint64_t changed_rays(Bench& bench) {
    EXPECT_TRUE(bench.desk.update(0));
    return bench.carving.figures().rays_changed;
}

sculpt::Tool tool_for(compute::Operation operation) {
    sculpt::Tool tool = Bench::tool();
    tool.operation = operation;
    return tool;
}
}  // namespace

TEST(SculptService, AStrokeOverSeveralUpdatesCarvesWhatItDoesInOne) {
    Bench whole, parts;
    for (int i = 0; i < 12; ++i) {  // 15 mm a sample: what lies between two of them is swept
        const Vec3 at(0.015 * i - 0.08, 0.0, 0.08);
        whole.sample(at, true);
        parts.sample(at, true);
        ASSERT_TRUE(parts.desk.update(0));
    }
    ASSERT_TRUE(whole.desk.update(0));
    // In one update the samples, which lie on a line, make one sweep; where several meet they round ends differently.
    const auto removed_m3 = [](Bench& bench) {
        return bench.carving.initial_volume_m3() - bench.carving.surface().volume_m3();
    };
    EXPECT_GT(removed_m3(whole), 1e-5);
    EXPECT_NEAR(removed_m3(parts) / removed_m3(whole), 1.0, 1e-4);
}

TEST(SculptService, NothingIsCarvedWhileTheWorkspaceMoves) {
    Bench bench;
    for (const haptics::WorkspacePhase phase :
         {haptics::WorkspacePhase::paused, haptics::WorkspacePhase::dragging, haptics::WorkspacePhase::jumping,
          haptics::WorkspacePhase::clutched, haptics::WorkspacePhase::gliding})
        push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0, phase);
    EXPECT_EQ(changed_rays(bench), 0u);
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0);
    EXPECT_GT(changed_rays(bench), 0u);
}

TEST(SculptService, FillingWorksWhereTheToolRestsAndPaintingOnlyWhereItTouches) {
    {
        Bench bench;  // the hand is deep inside, where there is nothing to fill
        bench.desk.order(sculpt::UseTool{tool_for(compute::Operation::fill), {"skin"}, 0.0});
        push(bench, Vec3(0.0), {0.0, 0.0, 0.11}, haptics::kTickInContact);
        EXPECT_GT(changed_rays(bench), 0u);
    }
    Bench bench;
    bench.desk.order(sculpt::UseTool{tool_for(compute::Operation::paint), {"paint", {255, 0, 0}}, 0.0});
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 0);
    EXPECT_EQ(changed_rays(bench), 0u) << "in the air";
    push(bench, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.12}, haptics::kTickInContact);
    EXPECT_GT(changed_rays(bench), 0u);
}

TEST(SculptService, AnotherToolBeginsWhereItIsAndNotWhereTheOldOneWas) {
    const auto carved = [](bool begins_apart) {
        Bench bench;
        bench.sample({-0.08, 0.0, 0.08}, true);
        EXPECT_TRUE(bench.desk.update(0));
        if (begins_apart) {
            bench.sample({-0.08, 0.0, 0.2}, false);
            EXPECT_TRUE(bench.desk.update(0));
        }
        bench.desk.order(sculpt::UseTool{Bench::tool(), {"skin"}, 0.0});
        bench.sample({0.08, 0.0, 0.08}, true);
        EXPECT_TRUE(bench.desk.update(0));
        return bench.carving.engine().solid();
    };
    EXPECT_TRUE(carved(false).same_content(carved(true))) << "nothing between the two was swept";
}

TEST(SculptService, EachUpdateHandsTouchASurfaceOfItsOwnNumberAndTime) {
    Bench bench;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        ASSERT_TRUE(bench.desk.update(static_cast<Nanoseconds>(i) * 10'000'000));
        const geometry::LocalSurface& surface = bench.channels.surface.newest();
        EXPECT_EQ(surface.sequence, i);
        EXPECT_EQ(surface.made_ns, static_cast<Nanoseconds>(i) * 10'000'000);
    }
}

}  // namespace burin::session
