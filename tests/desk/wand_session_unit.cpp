// SPDX-License-Identifier: MIT
// A live session whose hand holds a wand: both its ends touch, it is drawn, steered, calibrated and recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "desk/live/desk.hpp"
#include "desk/run/session_frames.hpp"
#include "devices/haptic/wand_file.hpp"
#include "haptics/channels.hpp"
#include "session/state/session_settings.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// A box of 10 cm about its origin.
const std::string kBlock =
    "OFF\n8 12 0\n-0.05 -0.05 -0.05\n0.05 -0.05 -0.05\n0.05 0.05 -0.05\n-0.05 0.05 -0.05\n"
    "-0.05 -0.05 0.05\n0.05 -0.05 0.05\n0.05 0.05 0.05\n-0.05 0.05 0.05\n"
    "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 2 3 7\n3 2 7 6\n3 0 4 7\n3 0 7 3\n3 1 2 6\n3 1 6 5\n";
constexpr double kBlockFront_m = 0.1, kBallOfPoint_m = 0.004;

// A block low before the wand, so that only its bottom end meets it.
class WandDesk {
public:
    explicit WandDesk(const std::string& description = "", const std::string& points = "top,bottom") {
        place_.write("b.off", kBlock);
        place_.write("w.toml",
                     "[[object]]\nname = \"block\"\nmesh = \"b.off\"\nmesh_units = \"m\"\n"
                     "position = [0.0, 0.13, 0.05]\nmaterial = { stiffness = 700 }\n");
        place_.write("wand.toml", description);
        options.scene.world = (place_ / "w.toml").string();
        options.scene.no_workpiece = true;
        options.hands.tool.shape = "ball:0.004";
        options.hands.points = points;
        options.hands.device = "simulated-wand:" + (place_ / "wand.toml").string();
        auto made = Desk::create(options, session_wall(options.desk).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        frame({});
    }
    // Ten ticks, an update of the scene, and a frame with these inputs.
    void frame(const std::vector<Input>& inputs) {
        for (int i = 0; i < 10; ++i) {
            clock.sleep_until(clock.now_ns() + desk->session().loop().period_ns());
            last = desk->session().loop().step();
        }
        ASSERT_TRUE(desk->session().scene().update(clock.now_ns()));
        std::vector<InputEvent> events;
        for (const Input& input : inputs) events.push_back({clock.now_ns(), input});
        desk->step({clock.now_ns(), clock.now_ns(), events}, {.size = {640, 360}}, desk->session().newest_tool(),
                   [](const scene::SceneThread::Order& order) { order(); });
        static_cast<void>(desk->session().collect({}));
        desk->take_news(Executor::kAllCollected);
    }
    void rest(int frames) {
        for (int i = 0; i < frames; ++i) frame({});
    }
    [[nodiscard]] haptics::TickParameters parameters() { return desk->session().channels().parameters.newest(); }
    [[nodiscard]] std::string told_by(const CommandInput& command) {
        testing::internal::CaptureStderr();
        frame({command});
        return testing::internal::GetCapturedStderr();
    }

    SessionSetup options = carving_setup();
    SimulatedClock clock;
    std::unique_ptr<Desk> desk;
    haptics::TickRecord last;

private:
    Workplace place_;
};

}  // namespace

TEST(WandSession, ItsPointsAreTheTicksProbeWhereTheDescriptionHasThem) {
    WandDesk desk;
    const haptics::TickParameters p = desk.parameters();
    ASSERT_EQ(p.probe.count, 2u);
    EXPECT_EQ(p.probe.points[0].offset_device_m, Vec3(0.0, 0.08, 0.0));
    EXPECT_EQ(p.probe.points[1].offset_device_m, Vec3(0.0, -0.08, 0.0));
    EXPECT_EQ(p.probe.points[1].radius_m, kBallOfPoint_m);
    EXPECT_EQ(p.clearance_ratio, 0.0) << "nothing is carved";
    // The world is touched where it is drawn: the middle of the workspace is at its place in the maker's frame.
    EXPECT_LT(glm::length(p.workspace.object_from_device * Vec3(0.0) - Vec3(0.0, 0.21, 0.01)), 1e-12);
    EXPECT_NEAR(p.workspace.object_from_device.scale, 1.0, 1e-12);
    EXPECT_LT(glm::length(p.workspace.workspace_device_m - Vec3(0.48, 0.25, 0.45)), 1e-12);
}

TEST(WandSession, AnotherHandleStandsElsewhereThanTheDevice) {
    WandDesk desk("[handle]\nposition = [0, 0.1, 0]\norientation = [0, 0, 0.7071067811865476, 0.7071067811865476]\n");
    const haptics::Probe probe = desk.parameters().probe;
    EXPECT_LT(glm::length(probe.points[0].offset_device_m - Vec3(-0.08, 0.1, 0.0)), 1e-12);
    EXPECT_LT(glm::length(probe.points[1].offset_device_m - Vec3(0.08, 0.1, 0.0)), 1e-12);
}

TEST(WandSession, IsDrawnAsARodWithARedAndAGreenBallWhereTheyTouch) {
    WandDesk desk;
    desk.frame({Scroll{{0.0, 12.0}, {}}});
    desk.rest(80);
    const auto scene = desk.desk->scene_on(0);
    ASSERT_TRUE(scene);
    EXPECT_FALSE(scene->tool.visible);
    ASSERT_EQ(scene->objects.size(), 4u) << "rod, two balls, the block";
    const Similarity& world_from_object = desk.desk->session().state().world_from_object;
    const haptics::ToolState tool = desk.desk->session().newest_tool();
    const picture::DrawnObject &top = scene->objects[1], &bottom = scene->objects[2];
    EXPECT_GT(top.colour.x, top.colour.y + 0.5);
    EXPECT_GT(bottom.colour.y, bottom.colour.x + 0.5);
    EXPECT_NEAR(top.world_from_mesh.scale, kBallOfPoint_m * world_from_object.scale, 1e-12) << "its mesh has a metre";
    const Vec3 bottom_object = inverse(world_from_object) * bottom.world_from_mesh.position_m;
    EXPECT_GT(bottom_object.z, kBlockFront_m + 0.9 * kBallOfPoint_m) << "it rests on the block";
    EXPECT_LT(bottom_object.z, kBlockFront_m + 1.1 * kBallOfPoint_m);
    // The rod follows the wand, which is pressed farther.
    const Vec3 middle_object = tool.workspace.object_from_device * tool.position_device_m;
    const Vec3 rod_world =
        scene->objects[0].world_from_mesh * Vec3(0.0, 0.5 * devices::WandDescription{}.handle_m, 0.0);
    EXPECT_LT(glm::length(rod_world - world_from_object * middle_object), 1e-9);
    EXPECT_LT(middle_object.z, bottom_object.z);
}

// The sum of r x F (W6), here about x alone, and the surface is known as far as both ends.
TEST(WandSession, ItsBottomEndAloneIsPushedBackAndTurned) {
    WandDesk desk;
    desk.frame({Scroll{{0.0, 12.0}, {}}});
    desk.rest(100);
    ASSERT_TRUE(desk.last.in_contact());
    EXPECT_EQ(desk.last.flags & haptics::kTickOutsideKnown, 0u);
    EXPECT_EQ(desk.last.contact.points[0].constraints, 0u) << "the top is free";
    EXPECT_GT(desk.last.contact.points[1].constraints, 0u);
    const devices::DeviceWrench& given = desk.last.gate.given;
    EXPECT_GT(given.force_device_N.z, 0.3) << "towards the user";
    EXPECT_NEAR(given.torque_device_Nm.x, -0.08 * given.force_device_N.z, 0.01) << "the hand lets it lean a little";
    EXPECT_LT(given.torque_device_Nm.x, -0.02);
    EXPECT_EQ(given.torque_device_Nm.y, 0.0) << "it has no motor about y";
    EXPECT_EQ(desk.last.gate.cause, haptics::GateCause::none);
}

TEST(WandSession, IsTurnedAndLeantByTheMouse) {
    WandDesk desk;
    const Modifiers ctrl{.ctrl = true}, both{.shift = true, .ctrl = true};
    const auto drag = [&](const Modifiers& held, const Vec2& by_px) {
        desk.frame({MouseMove{{100.0, 100.0}}, MouseClick{MouseButton::middle, true, held}});
        desk.frame({MouseMove{{100.0 + by_px.x, 100.0 + by_px.y}}});
        desk.frame({MouseClick{MouseButton::middle, false, held}});
        desk.rest(60);
        return desk.last.sample.orientation_device * Vec3(0.0, 1.0, 0.0);
    };
    const Vec3 leant = drag(both, {80.0, 0.0});
    EXPECT_GT(leant.x, 0.3) << "to the right, as it was dragged";
    EXPECT_NEAR(leant.z, 0.0, 0.02);
    const Vec3 nodded = drag(ctrl, {0.0, 80.0});
    EXPECT_GT(nodded.z, 0.3) << "towards the user";
}

TEST(WandSession, WhatIsKnownAroundItFollowsTheScenesScale) {
    WandDesk desk;
    desk.frame({Scroll{{0.0, -6.0}, {.ctrl = true}}});  // a smaller scene: the wand is larger in it
    desk.rest(10);
    EXPECT_GT(desk.parameters().workspace.object_from_device.scale, 1.5);
    EXPECT_EQ(desk.last.flags & haptics::kTickOutsideKnown, 0u);
}

TEST(WandSession, HoldsBallsAlone) {
    WandDesk desk;
    EXPECT_NE(desk.told_by({"tool", {"cylinder:0.004,0.02"}}).find("is no ball"), std::string::npos);
    EXPECT_EQ(desk.told_by({"radius", {"0.006"}}), "");
    EXPECT_EQ(desk.parameters().probe.points[1].radius_m, 0.006);
    SessionSetup options = desk.options;
    options.hands.points = "tpo";
    const auto refused = Desk::create(options, session_wall(options.desk).value(), desk.clock);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("did you mean top?"), std::string::npos);
}

// ---- Calibration. The hand rests at 0, 0.21, 0.2345 m of the maker's frame.

TEST(WandSession, IsCalibratedInItsJigWithinTheToleranceAlone) {
    WandDesk desk("[calibration]\nposition = [0, 0.212, 0.2345]\ntolerance = 0.003\n");
    desk.rest(20);
    const Pose read{desk.last.sample.position_device_m, desk.last.sample.orientation_device};
    EXPECT_NE(desk.told_by({"calibrate", {}}).find("calibrated: the wand read 2.0 mm"), std::string::npos);
    const Similarity calibrated = desk.parameters().workspace.object_from_device;
    EXPECT_LT(glm::length(calibrated * read.position_m - Vec3(0.0, 0.212, 0.2345)), 1e-12);
    EXPECT_EQ(desk.told_by({"calibrate", {"reset"}}), "");
    EXPECT_LT(glm::length(desk.parameters().workspace.object_from_device * Vec3(0.0) - Vec3(0.0, 0.21, 0.01)), 1e-12);

    WandDesk away("[calibration]\nposition = [0, 0.212, 0.2345]\ntolerance = 0.001\n");
    away.rest(20);
    const haptics::TickParameters before = away.parameters();
    const std::string refused = away.told_by({"calibrate", {}});
    EXPECT_NE(refused.find("reads 2.0 mm and 0.00 degrees off the jig's pose, where at most 1.0 mm"), std::string::npos)
        << refused;
    EXPECT_NE(refused.find("put it into the jig"), std::string::npos);
    EXPECT_EQ(away.parameters().workspace.object_from_device, before.workspace.object_from_device);
}

// ---- Options of a recording

TEST(WandSession, ARecordingNamesDeviceAndPoints) {
    SessionSetup options = carving_setup();
    options.hands.points = "top,centre";
    options.hands.device = "simulated-wand:w.toml";
    const std::string line = settings_line(options);
    EXPECT_NE(line.find("--points top,centre"), std::string::npos) << line;
    EXPECT_NE(line.find("--device simulated-wand:w.toml"), std::string::npos) << line;
    const auto again = options_as_recorded(line, {});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->options.hands.points, options.hands.points);
    EXPECT_EQ(again->options.hands.device, options.hands.device);
    EXPECT_TRUE(again->overruled.empty());
    // Recordings of the usual device do not name it: older programs read them, and theirs are read.
    EXPECT_EQ(settings_line({}).find("--device"), std::string::npos);
    const auto usual = options_as_recorded(settings_line({}), options);
    ASSERT_TRUE(usual);
    EXPECT_EQ(usual->options.hands.device, devices::kDefaultHapticDevice);
    EXPECT_EQ(usual->options.hands.points, "");
    EXPECT_EQ(usual->overruled.size(), 2u);
}

// Nothing in a session could enable them again.
TEST(WandSession, ItsAmplifiersAreEnabledAgainAndTheForceComesBackFromZero) {
    WandDesk desk;
    desk.frame({Scroll{{0.0, 12.0}, {}}});
    desk.rest(80);
    const double pressed_N = glm::length(desk.last.gate.given.force_device_N);
    ASSERT_GT(pressed_N, 0.3) << "an end rests on the block";
    EXPECT_TRUE(desk.told_by({"amplifiers", {"off"}}).contains("the amplifiers are off"));
    desk.rest(3);
    EXPECT_EQ(desk.last.gate.given.force_device_N, Vec3(0.0));
    EXPECT_EQ(desk.last.gate.cause, haptics::GateCause::device_fault);
    desk.rest(30);
    EXPECT_EQ(desk.last.gate.cause, haptics::GateCause::device_fault) << "nothing enables them by itself";
    EXPECT_TRUE(desk.told_by({"amplifiers", {"on"}}).contains("the amplifiers are on"));
    const double most_change_N = 1e-3 * desk.parameters().limits.max_slew_N_per_s;
    Vec3 before_N(0.0);
    double largest_N = 0.0;
    for (int tick = 0; tick < 600; ++tick) {
        desk.clock.sleep_until(desk.clock.now_ns() + desk.desk->session().loop().period_ns());
        const Vec3 given_N = desk.desk->session().loop().step().gate.given.force_device_N;
        EXPECT_LE(glm::length(given_N - before_N), most_change_N * (1.0 + 1e-9)) << tick;
        // The gate waits for 50 ms after a fault, and fades in over 200 ms.
        const double most_N = tick < 30 ? 0.0 : tick < 100 ? 0.6 * pressed_N : HUGE_VAL;
        EXPECT_LE(glm::length(given_N), most_N) << tick;
        largest_N = std::max(largest_N, glm::length(given_N));
        before_N = given_N;
        if (tick % 10 == 9) {
            ASSERT_TRUE(desk.desk->session().scene().update(desk.clock.now_ns()));
        }
    }
    EXPECT_GT(largest_N, 0.7 * pressed_N);
}

}  // namespace burin::session
