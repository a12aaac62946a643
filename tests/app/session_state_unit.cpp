// SPDX-License-Identifier: MIT
// The session's state and its carving side, without any picture.
#include <gtest/gtest.h>

#include <chrono>

#include "app/engine_choice.hpp"
#include "app/session/carving_thread.hpp"
#include "app/session/session_state.hpp"
#include "haptics/tick.hpp"

namespace burin {
namespace {

Room test_room() {
    Room room;
    room.workpiece_object = {Vec3(-0.1), Vec3(0.1)};
    room.wall = *session_wall({});
    room.desk.home_head_world = {{0.0, 1.6, 2.0}, Quat{1, 0, 0, 0}};
    return room;
}

ToolOptions ball(const std::string& shape) {
    ToolOptions options;
    options.shape = shape;
    return options;
}

SessionState test_state(const Room& room) { return begin_session(room, ball("ball:0.01"), {}, {}); }

Result<void> run(SessionState& state, SessionOrders& orders, const std::string& name,
                 std::vector<std::string> arguments = {}) {
    return run_command(state, orders, {name, std::move(arguments)});
}

// A ball under a tool that a script moves by hand-made samples.
struct Bench {
    WorkerPool pool{1};
    Carving carving;
    HapticChannels channels;
    CarvingDesk desk;

    Bench() : carving(engine(pool), pool), desk(carving, channels, pool, tool(), 0.0, 0.02, 1 << 24) {
        desk.start_at({0.0, 0.0, 0.15});
    }
    static std::unique_ptr<CarvingEngine> engine(WorkerPool& pool) {
        return std::move(choose_engine(EngineChoice::cpu, *make_ball(0.1, 32, {"skin"}), pool)->engine);
    }
    static Tool tool() { return *parse_tool(ball("ball:0.02")); }
    // The tool at a place, with its button up or down; material without hardness goes away where the hand is.
    void sample(const Vec3& place, bool pressed) {
        StrokeSample s;
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
    const Scene scene = *scene_of(state, room, 0, Vec3(-0.1), {});
    const Eyes eyes = eyes_of(scene.viewer);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 0.1 : -0.1, corner & 2 ? 0.1 : -0.1, corner & 4 ? 0.1 : -0.1};
        const Vec3 at = state.world_from_object * p;
        EXPECT_LT(at.z, eyes.left_world.z - 0.3);
        EXPECT_GT(at.y, 0.0);
    }
    const Vec3 hand = state.world_from_device * state.desk.target_device_m;
    EXPECT_GT(hand.z, (state.world_from_object * Vec3(0.0, 0.0, 0.1)).z) << "in front of the workpiece";
    EXPECT_TRUE(parameters_are_sensible(parameters_of(state, room)));
}

TEST(SessionState, AToolThatIsWrongLeavesTheOldOne) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    for (const auto& [name, argument] : std::vector<std::pair<std::string, std::string>>{{"radius", "0"},
                                                                                         {"radius", "x"},
                                                                                         {"tool", "ball:"},
                                                                                         {"tool", "box:0.1,0.1,0.1"},
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
    EXPECT_EQ(state.tool.shape, "ball:0.01");
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
        EXPECT_TRUE(parameters_are_sensible(parameters_of(state, room))) << name;
    }
}

TEST(SessionState, TheNextStereoModeComesRoundToTheFirst) {
    SessionState state = test_state(test_room());
    SessionOrders orders;
    const StereoMode first = state.output.mode;
    int steps = 0;
    do {
        ASSERT_TRUE(run(state, orders, "next-stereo-mode"));
        EXPECT_NE(state.output.mode, StereoMode::two_windows) << "one window cannot show it";
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

TEST(CarvingDesk, OnePressIsOneUndoAlsoWhereTheToolLosesTouch) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    static_cast<void>(bench.desk.take_news());
    // Pressed twice into the ball's front without letting go, paused between in an update of its own.
    for (const double z : {0.1, 0.2, 0.1}) {
        for (int i = 0; i < 5; ++i) bench.sample({0.01 * i, 0.0, z}, true);
        ASSERT_TRUE(bench.desk.update(0));
    }
    bench.sample({0.05, 0.0, 0.2}, false);
    ASSERT_TRUE(bench.desk.update(0));
    const auto news = bench.desk.take_news();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->undoable, 1u);
}

TEST(CarvingDesk, OneStrokeIsOneUndoAndNewsTellOnlyWhatChanged) {
    Bench bench;
    ASSERT_TRUE(bench.desk.update(0));
    const auto first = bench.desk.take_news();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->undoable, 0u);
    EXPECT_FALSE(bench.desk.take_news()) << "nothing has happened since";
    bench.stroke();
    ASSERT_TRUE(bench.desk.update(20'000'000));
    ASSERT_TRUE(bench.desk.update(30'000'000));
    const auto carved = bench.desk.take_news();
    ASSERT_TRUE(carved);
    EXPECT_EQ(carved->undoable, 1u);
    EXPECT_GT(carved->cut_ns, 0);
    EXPECT_FALSE(carved->tiles.empty());
    EXPECT_LT(carved->tiles.size(), first->tiles.size());
    bench.desk.order(UndoStroke{});
    const auto undone = bench.desk.take_news();
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->undoable, 0u);
    EXPECT_EQ(undone->redoable, 1u);
    EXPECT_EQ(undone->tiles.size(), carved->tiles.size());
}

// Orders come while strokes are carved on another thread; what is left is what the same orders leave one after the other.
TEST(CarvingThread, CarvesAndTakesOrdersBesideTheFrame) {
    MonotonicClock clock;
    Bench bench;
    CarvingThread thread(bench.desk, clock, [] {});
    bench.stroke();
    thread.start();
    std::optional<SurfaceNews> seen;
    const auto gather_until = [&](auto&& enough) {
        for (int i = 0; i < 3000 && !(seen && enough(*seen)); ++i) {  // a guard against hanging, not a measure
            add(seen, thread.take_news().news);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    };
    gather_until([](const SurfaceNews& n) { return n.undoable == 1; });
    ASSERT_TRUE(seen && seen->undoable == 1);
    thread.order(UndoStroke{});
    gather_until([](const SurfaceNews& n) { return n.redoable == 1; });
    ASSERT_EQ(seen->redoable, 1u);
    thread.order(RedoStroke{});
    thread.stop();  // carries out what was ordered
    EXPECT_FALSE(thread.failure());
    EXPECT_EQ(bench.carving.history()->undoable(), 1u);

    Bench alone;
    alone.stroke();
    ASSERT_TRUE(alone.desk.update(0));
    ASSERT_TRUE(alone.desk.update(0));
    EXPECT_TRUE(bench.carving.engine().solid().same_content(alone.carving.engine().solid()));
}

}  // namespace burin
