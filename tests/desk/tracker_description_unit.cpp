// SPDX-License-Identifier: MIT
// Descriptions of trackers from end to end: emulated systems over this machine's loopback, read by the real drivers, up
// to the eyes before the wall.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "desk/view/session_head.hpp"
#include "desk/view/session_tracker.hpp"
#include "devices/emulators/emulated_dtrack.hpp"
#include "devices/emulators/emulated_vrpn.hpp"
#include "devices/trackers/dtrack_tracker.hpp"
#include "devices/trackers/udp_tracker.hpp"
#include "session/input/input_line.hpp"
#include "session/record/input_source.hpp"
#include "wall/wall_file.hpp"

namespace burin::session {
namespace {

using devices::TrackerSample;

std::string written(const std::string& name, const std::string& text) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(path) << text;
    return path.string();
}

constexpr const char* kWall = R"(units = "m"
[world_from_tracker]            # a quarter turn about +y: (x, y, z) becomes (z, y, -x)
position = [1, 0, -0.5]
orientation = [0, 0.70710678118654757, 0, 0.70710678118654757]
[[screen]]
lower_left = [-2, 0, 0]
lower_right = [2, 0, 0]
upper_left = [-2, 3, 0]
)";
constexpr const char* kMeaning = R"(units = "mm"
axes = ["+z", "+y", "-x"]
[head]
body = "HEAD"
position = [0, -70, 90]
[[wand]]
body = "WAND"
position = [0, 0, -120]
)";

std::string with_bodies(std::string text, const std::string& head, const std::string& wand) {
    text.replace(text.find("HEAD"), 4, head);
    return text.replace(text.find("WAND"), 4, wand);
}

// A wall's file that names a tracker's, opened as a session does.
struct Opened {
    wall::WallSetup setup;
    std::unique_ptr<devices::Tracker> tracker;
};
Opened opened(const std::string& description, Clock& clock, const std::string& option = {}) {
    static_cast<void>(written("tracker_of_wall.toml", description));
    SessionSetup options;
    options.desk.wall =
        written("wall_of_tracker.toml", std::string(kWall) + "[tracker]\nfile = \"tracker_of_wall.toml\"\n");
    options.desk.tracker = option;
    Opened made{wall::read_wall(options.desk.wall).value(), nullptr};
    const auto resolved = session_tracker(options, made.setup);
    EXPECT_TRUE(resolved) << resolved.error().line();
    auto tracker = open_tracker(*resolved, made.setup, {clock, {}, parse_tracker_line});
    EXPECT_TRUE(tracker) << tracker.error().line();
    made.tracker = std::move(*tracker);
    return made;
}

template <typename Enough>
std::vector<TrackerSample> heard_until(devices::Tracker& tracker, Enough enough) {
    std::vector<TrackerSample> all;
    for (int i = 0; i < 30'000 && !enough(all); ++i) {
        for (TrackerSample& sample : tracker.take()) all.push_back(std::move(sample));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
}

template <typename Kind>
std::size_t count_of(const std::vector<TrackerSample>& samples) {
    return static_cast<std::size_t>(std::ranges::count_if(
        samples, [](const TrackerSample& sample) { return std::holds_alternative<Kind>(sample.input); }));
}

// The middle of both eyes before the wall, of one sample alone and at its own time.
Vec3 eyes_of(const wall::WallSetup& setup, const TrackerSample& sample, Quat* orientation_world) {
    const std::vector<InputEvent> events{{sample.time_ns, input_of(sample.input)}};
    const SessionHead head = follow_head({}, setup, setup.timing, events, sample.time_ns, {});
    const wall::Eyes eyes = wall::eyes_world(setup, head.poses);
    *orientation_world = head_world(setup, head).orientation;
    return 0.5 * (eyes.left_world + eyes.right_world);
}

// The emulators' viewer (emulated_motion.hpp) is at (0.2 s, 1.65 + 0.02 r, 2), turned about +y by 0.15 s, with s and r
// from -1 to 1. By the axes of kMeaning the head is at (2, ..., -0.2 s) in the tracker's frame, turned alike; its eyes
// are off by (0.09 sin, -0.07, 0.09 cos); and the wall's quarter turn and offset come last.
void expect_eyes_as_emulated(const wall::WallSetup& setup, const std::vector<TrackerSample>& heard) {
    for (const TrackerSample& sample : heard) {
        if (!std::holds_alternative<devices::HeadInput>(sample.input)) continue;
        Quat turned{};
        const Vec3 eyes = eyes_of(setup, sample, &turned);
        const double yaw = 2.0 * std::atan2(turned.y, turned.w) - std::acos(0.0), s = yaw / 0.15;
        // DTrack writes rotations with six decimals: 1e-6 rad, which s has 1 / 0.15 times.
        EXPECT_LE(std::abs(s), 1.0 + 1e-5);
        EXPECT_NEAR(eyes.x, 1.0 + (-0.2 * s + 0.09 * std::cos(yaw)), 3e-6);
        EXPECT_NEAR(eyes.y, 1.65 - 0.07, 0.02 + 3e-6);
        EXPECT_NEAR(eyes.z, -0.5 - (2.0 + 0.09 * std::sin(yaw)), 3e-6);
    }
}

// The wand circles around (0.3, 1.2, 1.4) with 0.15 m, in the emulator's plane of x and y, and nods about +x by at most
// 0.3 rad, which the axes of kMeaning make a turn about -z: its tip is 0.12 m from there, along -z, and stays so.
void expect_wand_as_emulated(const std::vector<TrackerSample>& heard) {
    for (const TrackerSample& sample : heard) {
        const auto* wand = std::get_if<devices::WandInput>(&sample.input);
        if (wand == nullptr) continue;
        const Pose& pose = wand->pose_world;
        const Vec3 body = pose.position_m + pose.orientation * Vec3(0, 0, 0.12);
        // In the tracker's frame (1.4, 1.2 + 0.15 sin, -0.3 - 0.15 cos); in the world (1 + z, y, -0.5 - x).
        EXPECT_NEAR(body.z, -0.5 - 1.4, 3e-6);
        EXPECT_NEAR(std::hypot(body.x - (1.0 - 0.3), body.y - 1.2), 0.15, 3e-6);
        EXPECT_NEAR(glm::length(pose.position_m - body), 0.12, 1e-9);
    }
}

// Runs while it lives.
class Running {
public:
    explicit Running(std::function<void(const std::function<bool()>&)> run)
        : thread_([this, run = std::move(run)] { run([this] { return ends_.load(); }); }) {}
    ~Running() {
        ends_ = true;
        thread_.join();
    }

private:
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

}  // namespace

TEST(TrackerDescription, P2PutsTheEyesOfAVrpnHeadWhereTheEmulatorsFormulaSays) {
    auto server = devices::EmulatedVrpn::create({"127.0.0.1", 0});
    ASSERT_TRUE(server) << server.error().line();
    const Running serves([&](const auto& ends) { server->run({.rate_Hz = 200.0}, ends); });
    MonotonicClock clock;
    const auto there = opened("address = \"vrpn:127.0.0.1:" + std::to_string(server->address().port) + "\"\n" +
                                  with_bodies(kMeaning, "Tracker0/0", "Tracker0/1"),
                              clock);
    const auto heard = heard_until(*there.tracker, [](const auto& all) { return all.size() >= 200; });
    ASSERT_GE(count_of<devices::HeadInput>(heard), 50u);
    ASSERT_GE(count_of<devices::WandInput>(heard), 50u);
    expect_eyes_as_emulated(there.setup, heard);
    expect_wand_as_emulated(heard);
}

TEST(TrackerDescription, P2PutsTheEyesOfADTrackHeadWhereTheEmulatorsFormulaSays) {
    MonotonicClock clock;
    const auto there = opened("address = \"dtrack:0\"\n" + with_bodies(kMeaning, "body/0", "flystick/0"), clock);
    const auto port = dynamic_cast<devices::DTrackTracker&>(*there.tracker).port();
    const Running sends(
        [&](const auto& ends) { EXPECT_TRUE(devices::run_emulated_dtrack({"127.0.0.1", port}, {}, ends)); });
    const auto heard =
        heard_until(*there.tracker, [](const auto& all) { return count_of<devices::WandClick>(all) >= 1; });
    ASSERT_GE(count_of<devices::HeadInput>(heard), 50u);
    EXPECT_GE(count_of<devices::WandClick>(heard), 1u) << "a flystick's buttons come with it";
    expect_eyes_as_emulated(there.setup, heard);
    expect_wand_as_emulated(heard);
}

// A line of text is in the tracker's frame and unit where a description says what these are.
TEST(TrackerDescription, P2PlacesTheLinesOfABridge) {
    MonotonicClock clock;
    std::string meaning = with_bodies(kMeaning, "head", "wand");
    meaning.insert(0, "reported_units = \"mm\"\n");
    const auto there = opened("address = \"udp:0\"\n" + meaning, clock);
    const auto port = dynamic_cast<devices::UdpTracker&>(*there.tracker).port();
    const auto socket = devices::sender_to({"127.0.0.1", port});
    ASSERT_TRUE(socket);
    devices::send_datagram(*socket, "head 100 1650 2000 0 0 0 1\nwand-button 0 press 0");
    const auto heard = heard_until(*there.tracker, [](const auto& all) { return !all.empty(); });
    ASSERT_GE(heard.size(), 1u);
    Quat turned{};
    // (2, 1.65, -0.1) with the eyes at (2, 1.58, -0.01), and the wall's quarter turn.
    EXPECT_LT(glm::length(eyes_of(there.setup, heard[0], &turned) - Vec3(0.99, 1.58, -2.5)), 1e-12);
    EXPECT_EQ(heard.size(), 1u) << "the wand's buttons are not named";
}

// Corners are in the tracker's frame; so is what the tracker reports.
TEST(TrackerDescription, P2HeadsWithoutADescriptionStandWhereTheWallSaysTheTrackerIs) {
    auto server = devices::EmulatedVrpn::create({"127.0.0.1", 0});
    ASSERT_TRUE(server) << server.error().line();
    const Running serves([&](const auto& ends) { server->run({.rate_Hz = 200.0}, ends); });
    MonotonicClock clock;
    SessionSetup options;
    options.desk.wall = written("bare_wall.toml", kWall);
    options.desk.tracker = "vrpn:127.0.0.1:" + std::to_string(server->address().port);
    const auto setup = wall::read_wall(options.desk.wall).value();
    const auto tracker =
        open_tracker(session_tracker(options, setup).value(), setup, {clock, {}, parse_tracker_line}).value();
    const auto heard = heard_until(*tracker, [](const auto& all) { return all.size() >= 20; });
    ASSERT_GE(count_of<devices::HeadInput>(heard), 5u);
    for (const TrackerSample& sample : heard) {
        const auto* head = std::get_if<devices::HeadInput>(&sample.input);
        if (head == nullptr) continue;
        EXPECT_NEAR(head->pose_world.position_m.x, 1.0 + 2.0, 1e-12) << "2 m before the tracker's origin";
    }
}

TEST(SessionTracker, IsWhatTheOptionSaysOrElseTheWall) {
    const std::string description =
        "address = \"vrpn:a\"\nunits = \"m\"\n[head]\nbody = \"G/1\"\nposition = [0, 0, 0.1]\n";
    const std::string file = written("named.toml", description);
    SessionSetup options;
    options.desk.wall = written("walled.toml", std::string(kWall) + "[tracker]\nfile = \"named.toml\"\n");
    const wall::WallSetup setup = wall::read_wall(options.desk.wall).value();
    const auto resolved = [&](const std::string& option) {
        options.desk.tracker = option;
        return session_tracker(options, setup).value();
    };
    EXPECT_EQ(resolved("").where, "vrpn:a");
    EXPECT_TRUE(resolved("").described);
    EXPECT_EQ(resolved("none").where, "");
    EXPECT_EQ(resolved("vrpn:b,wand0=W").where, "vrpn:b,wand0=W");
    EXPECT_TRUE(resolved("vrpn:b,wand0=W").described) << "the same kind: another address";
    EXPECT_EQ(resolved("dtrack:5000").where, "dtrack:5000");
    EXPECT_FALSE(resolved("dtrack:5000").described) << "another kind: another tracker";
    options.record.input = "script.txt";
    EXPECT_EQ(resolved("").where, "") << "nothing is heard in simulated time";
    options.record.path = "x.session";
    EXPECT_EQ(resolved("").where, "vrpn:a");
    options.record.input.clear();
    const wall::WallSetup bare = wall::read_wall(written("bare.toml", kWall)).value();
    options.desk.wall.clear();
    options.desk.tracker = file;
    EXPECT_EQ(session_tracker(options, bare).value().where, "vrpn:a") << "a description without a wall's file";
    options.desk.tracker = "no.such.toml";
    EXPECT_FALSE(session_tracker(options, bare));
    wall::WallSetup far_eyes = bare;
    far_eyes.eyes = wall::eyes_about({0.0, -0.07, -0.09}, 0.063);
    options.desk.tracker = file;
    const auto twice = session_tracker(options, far_eyes);
    ASSERT_FALSE(twice);
    EXPECT_TRUE(twice.error().line().contains("moves the head's point to the eyes")) << twice.error().line();
}

// A script that is played in real time leads the hand; a tracker that is there leads the head.
TEST(SessionTracker, IsHeardWhileALogIsPlayed) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "played_with_tracker.log";
    std::filesystem::remove(path);
    const auto log = parse_input_log("burin-input 1 test\n0.1 mouse 1 1\n0.3 mouse 3 3\n", "in.log");
    ASSERT_TRUE(log) << log.error().line();
    auto writer = InputLogWriter::create(path, "");
    ASSERT_TRUE(writer) << writer.error().line();
    InputSource source = InputSource::play(*log, std::move(*writer));
    constexpr Nanoseconds kMs = 1'000'000;
    source.push(150 * kMs, HeadInput{});
    source.push(50 * kMs, WandClick{});
    source.push(350 * kMs, HeadInput{});  // not yet, by the frame's clock
    const auto first = source.begin_frame(200 * kMs, 210 * kMs);
    ASSERT_TRUE(first);
    ASSERT_EQ(first->events.size(), 4u);
    EXPECT_TRUE(std::holds_alternative<WandClick>(first->events[0].input));
    EXPECT_TRUE(std::holds_alternative<MouseMove>(first->events[1].input));
    EXPECT_EQ(first->events[2].time_ns, 150 * kMs);
    EXPECT_EQ(first->events[3].time_ns, 200 * kMs) << "never after its frame";
    EXPECT_EQ(source.begin_frame(400 * kMs, 410 * kMs)->events.size(), 1u);
    EXPECT_FALSE(source.recording_error());
    const auto recorded = read_input_log(path);
    ASSERT_TRUE(recorded) << recorded.error().line();
    EXPECT_EQ(recorded->events.size(), 5u + 2u) << "events and frames, in their order";
    std::filesystem::remove(path);
}

TEST(SessionTracker, SaysHowToDoWithoutATrackerThatTheWallNames) {
    MonotonicClock clock;
    SessionSetup options;
    static_cast<void>(written("gone.toml", "address = \"vrpn:127.0.0.1:1\"\nunits = \"m\"\n[head]\nbody = \"G\"\n"));
    options.desk.wall = written("walled.toml", std::string(kWall) + "[tracker]\nfile = \"gone.toml\"\n");
    const wall::WallSetup setup = wall::read_wall(options.desk.wall).value();
    const auto opened = open_tracker(session_tracker(options, setup).value(), setup, {clock, {}, parse_tracker_line});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("--tracker none does without")) << opened.error().line();
}

}  // namespace burin::session
