// SPDX-License-Identifier: MIT
// A VRPN tracker from end to end, over this machine's loopback: the emulated server, and servers that are not sound.
#include "devices/trackers/vrpn_tracker.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "devices/emulators/emulated_vrpn.hpp"
#include "tests/devices/raw_vrpn_server.hpp"
#include "tests/devices/told_clock.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

using std::chrono::milliseconds;

// An emulated server that runs while it lives.
class RunningServer {
public:
    explicit RunningServer(EmulatedVrpnOptions options = {}, std::uint16_t port = 0) {
        // A port that was in use a moment ago may take another one to be free.
        for (int i = 0; i < 100 && !server_; ++i) {
            auto made = EmulatedVrpn::create({"127.0.0.1", port});
            if (made)
                server_.emplace(std::move(*made));
            else
                std::this_thread::sleep_for(milliseconds(20));
        }
        thread_ = std::thread([this, options] { server_->run(options, [this] { return ends_.load(); }); });
    }
    ~RunningServer() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] std::uint16_t port() const { return server_->address().port; }
    [[nodiscard]] std::string where() const { return "vrpn:127.0.0.1:" + std::to_string(port()); }
    [[nodiscard]] std::uint64_t pings() const { return server_->pings(); }

private:
    std::optional<EmulatedVrpn> server_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Of the emulated motion: just before the wand's button goes down.
constexpr double kBeforePress_s = 2.8;

std::string refused(const std::string& where) {
    MonotonicClock clock;
    const auto tracker = open_tracker(where, {clock, {}, {}});
    return tracker ? "nothing" : tracker.error().line();
}

}  // namespace

TEST(VrpnTracker, P2HearsHeadWandButtonAndStickOfTheEmulatedServer) {
    RunningServer server({.rate_Hz = 100.0, .begins_s = kBeforePress_s});
    MonotonicClock clock;
    auto tracker = open_tracker(server.where(), {clock, {}, {}});
    ASSERT_TRUE(tracker) << tracker.error().line();
    const auto heard = heard_until(**tracker, [](const auto& all) { return of_kind<WandClick>(all).size() >= 2; });
    const auto heads = of_kind<HeadInput>(heard);
    const auto wands = of_kind<WandInput>(heard);
    ASSERT_GE(heads.size(), 50u);
    ASSERT_GE(wands.size(), 50u);
    EXPECT_TRUE(heads[0].tracked);
    // Each pose is one that the emulator's motion has at some time: the head on its line, the wand on its circle.
    for (const HeadInput& head : heads) {
        EXPECT_EQ(head.pose_world.position_m.z, 2.0);
        EXPECT_NEAR(2.0 * std::atan2(head.pose_world.orientation.y, head.pose_world.orientation.w),
                    0.15 * head.pose_world.position_m.x / 0.2, 1e-9);
    }
    for (const WandInput& wand : wands)
        EXPECT_NEAR(glm::length(wand.pose_world.position_m - Vec3(0.3, 1.2, 1.4)), 0.15, 1e-12);
    const auto clicks = of_kind<WandClick>(heard);
    ASSERT_GE(clicks.size(), 2u);
    EXPECT_EQ(clicks[0], (WandClick{0, 0, true}));
    EXPECT_EQ(clicks[1], (WandClick{0, 0, false}));
    EXPECT_EQ((*tracker)->refused(), 0u);
    EXPECT_TRUE(all_messages(**tracker).contains("is there, version 07.38"));
}

TEST(VrpnTracker, AbsorbsTenThousandReportsASecondAndHasTheNewest) {
    RawServer server;
    MonotonicClock clock;
    const auto tracker = server.opened(clock);
    // A second's worth, as fast as the line takes them; taken once a frame.
    constexpr int kReports = 10'000;
    std::thread sends([&] {
        for (int i = 1; i <= kReports; ++i) {
            server.send_pose({0.0001 * i, 0.0, 0.0});
            if (i % 160 == 0) std::this_thread::sleep_for(milliseconds(16));
        }
    });
    std::size_t count = 0;
    Vec3 newest(0.0);
    for (int i = 0; i < 2000 && newest.x < 0.99999; ++i) {
        for (const TrackerSample& sample : tracker->take()) {
            ++count;
            newest = std::get<HeadInput>(sample.input).pose_world.position_m;
        }
        std::this_thread::sleep_for(milliseconds(16));
    }
    sends.join();
    EXPECT_EQ(count, static_cast<std::size_t>(kReports));
    EXPECT_EQ(newest.x, 0.0001 * kReports) << "the last one sent";
    EXPECT_EQ(tracker->refused(), 0u);
}

// Nothing of the one wand is as the other's. The server's numbers of devices and types are none that the client uses.
TEST(VrpnTracker, GivesEachOfTwoWandsItsOwnSensorButtonsAndStick) {
    RawServer server;
    MonotonicClock clock;
    const auto tracker = server.opened(
        clock,
        ",head=Tracker0/0,wand0=Tracker0/1,wand1=Tracker0/2,buttons0=Button0,buttons1=Button1,stick0=Analog0,"
        "stick1=Analog1");
    VrpnServerBytes said;
    said.sender(4, "Button0").sender(6, "Button1").sender(2, "Analog1").sender(3, "Analog0");
    said.type(11, "vrpn_Button Change").type(12, "vrpn_Analog Channel").type(13, "vrpn_Button States");
    for (const int sensor : {0, 1, 2}) {
        Pose pose = uneven_pose(static_cast<std::size_t>(sensor));
        said.message(9, 7, vrpn_pos_quat(sensor, pose));
    }
    said.message(4, 11, vrpn_button_change(1, 1)).message(6, 13, vrpn_button_states(std::array{0, 0, 1}));
    said.message(3, 12, vrpn_analog_channels(std::array{0.25, -0.75}));
    said.message(2, 12, vrpn_analog_channels(std::array{-0.5, 0.6}));
    said.message(6, 11, vrpn_button_change(2, 0));
    server.send(said.bytes());
    const auto heard = heard_until(*tracker, [](const auto& all) { return of_kind<WandClick>(all).size() >= 3; });
    const auto is_at = [](const Pose& pose, std::size_t index) {
        return glm::distance(pose.position_m, uneven_offset(index)) < 1e-12 &&
               std::abs(glm::dot(pose.orientation, uneven_turn(index))) > 1.0 - 1e-12;
    };
    const auto heads = of_kind<HeadInput>(heard);
    const auto wands = of_kind<WandInput>(heard);
    ASSERT_EQ(heads.size(), 1u);
    EXPECT_TRUE(is_at(heads[0].pose_world, 0));
    ASSERT_EQ(wands.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(wands[i].wand, i);
        EXPECT_TRUE(is_at(wands[i].pose_world, i + 1)) << i;
    }
    EXPECT_EQ(of_kind<WandClick>(heard), (std::vector<WandClick>{{0, 1, true}, {1, 2, true}, {1, 2, false}}));
    EXPECT_EQ(of_kind<WandStick>(heard), (std::vector<WandStick>{{0, {0.25, -0.75}}, {1, {-0.5, 0.6}}}));
    EXPECT_EQ(tracker->refused(), 0u);
}

TEST(VrpnTracker, TheUsualSecondWandIsTheTrackersThirdSensor) {
    RawServer server;
    MonotonicClock clock;
    const auto tracker = server.opened(clock);
    for (const int sensor : {2, 1, 0}) server.send_pose({0.3 + sensor, 1.0, 2.0}, {1, 0, 0, 0}, sensor);
    const auto heard = heard_until(*tracker, [](const auto& all) { return all.size() >= 3; });
    ASSERT_EQ(heard.size(), 3u);
    EXPECT_EQ(std::get<WandInput>(heard[0].input).wand, 1u);
    EXPECT_EQ(std::get<WandInput>(heard[0].input).pose_world.position_m.x, 2.3);
    EXPECT_EQ(std::get<WandInput>(heard[1].input).wand, 0u);
    EXPECT_EQ(std::get<WandInput>(heard[1].input).pose_world.position_m.x, 1.3);
    EXPECT_EQ(std::get<HeadInput>(heard[2].input).pose_world.position_m.x, 0.3);
}

TEST(VrpnTracker, RenamesAxesOfPlacesAndTurnsAlike) {
    RawServer server;
    MonotonicClock clock;
    // A system whose z is up and whose y points away from the viewer.
    const auto tracker = server.opened(clock, ",head=Tracker0/4,axes=+x+z-y");
    const double half = 0.5 * 0.3;
    server.send_pose({1.0, 2.0, 3.0}, Quat(std::cos(half), 0.0, 0.0, std::sin(half)), 4);  // turned about its z
    const auto heard = heard_until(*tracker, [](const auto& all) { return !all.empty(); });
    ASSERT_EQ(heard.size(), 1u);
    const auto head = std::get<HeadInput>(heard[0].input);
    EXPECT_LT(glm::distance(head.pose_world.position_m, Vec3(1.0, 3.0, -2.0)), 1e-12);
    EXPECT_NEAR(head.pose_world.orientation.y, std::sin(half), 1e-12) << "turned about the world's y";
    EXPECT_NEAR(head.pose_world.orientation.w, std::cos(half), 1e-12);
}

TEST(VrpnTracker, LeavesOutWhatIsNoPoseAndSaysSo) {
    RawServer server;
    MonotonicClock clock;
    const auto tracker = server.opened(clock);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    server.send_pose({nan, 0.0, 0.0});
    server.send_pose({0.0, 0.0, 0.0}, {nan, 0.0, 0.0, 0.0});
    server.send_pose({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0});
    server.send_pose({0.0, 1650.0, 0.0});                  // millimetres
    server.send_pose({0.0, 1.65, 0.0}, {1, 0, 0, 0}, 77);  // a sensor that nobody asked for
    server.send(VrpnServerBytes().message(9, 7, std::vector<std::byte>(63)).bytes());
    server.send(VrpnServerBytes().message(1234, 4321, std::vector<std::byte>(64)).bytes());  // numbers without a name
    server.send_pose({0.0, 1.65, 0.0}, {1.005, 0.0, 0.0, 0.0});
    const auto heard = heard_until(*tracker, [](const auto& all) { return !all.empty(); });
    ASSERT_EQ(heard.size(), 1u);
    const auto head = std::get<HeadInput>(heard[0].input);
    EXPECT_EQ(head.pose_world.position_m, Vec3(0.0, 1.65, 0.0));
    EXPECT_NEAR(glm::length(head.pose_world.orientation), 1.0, 1e-12);
    EXPECT_EQ(tracker->refused(), 5u);
    const std::string said = all_messages(*tracker);
    EXPECT_TRUE(said.contains("pose of Tracker0/0 that is none")) << said;
}

TEST(VrpnTracker, LosesWhatItTrackedWithItsServerAndFindsItAgain) {
    auto server = std::make_unique<RunningServer>(EmulatedVrpnOptions{.begins_s = kBeforePress_s});
    const std::uint16_t port = server->port();
    MonotonicClock clock;
    const auto tracker = open_tracker(server->where(), {clock, {}, {}}).value();
    // While the first button is down.
    const auto before = heard_until(*tracker, [](const auto& all) { return of_kind<WandClick>(all).size() == 1; });
    ASSERT_EQ(of_kind<WandClick>(before).size(), 1u);
    server.reset();
    const auto lost = heard_until(*tracker, [](const auto& all) {
        const auto wands = of_kind<WandInput>(all);
        return !of_kind<WandClick>(all).empty() && !wands.empty() && !wands.back().tracked;
    });
    ASSERT_FALSE(of_kind<WandClick>(lost).empty());
    EXPECT_EQ(of_kind<WandClick>(lost)[0], (WandClick{0, 0, false})) << "no button stays down";
    ASSERT_FALSE(of_kind<HeadInput>(lost).empty());
    EXPECT_FALSE(of_kind<HeadInput>(lost).back().tracked);
    EXPECT_EQ(of_kind<HeadInput>(lost).back().pose_world.position_m.z, 2.0) << "where it was last";
    EXPECT_TRUE(all_messages(*tracker).contains("has closed the connection: it is looked for again"));
    server = std::make_unique<RunningServer>(EmulatedVrpnOptions{}, port);
    const auto again = heard_until(*tracker, [](const auto& all) { return !of_kind<HeadInput>(all).empty(); });
    ASSERT_FALSE(of_kind<HeadInput>(again).empty());
    EXPECT_TRUE(of_kind<HeadInput>(again).back().tracked);
}

// A network that is cut says nothing at all; a tracker that rests says nothing either, but answers.
TEST(VrpnTracker, PingsAServerThatIsQuietAndLeavesOneThatIsSilent) {
    RunningServer quiet({.rate_Hz = 0.05});
    RawServer silent;
    MonotonicClock clock;
    const auto keeps = open_tracker(quiet.where(), {clock, {}, {}}).value();
    const auto leaves = silent.opened(clock);
    silent.send_pose({0.0, 1.65, 0.0});
    const auto lost = heard_until(*leaves, [](const auto& all) { return all.size() >= 2; });
    ASSERT_EQ(lost.size(), 2u);
    EXPECT_FALSE(std::get<HeadInput>(lost[1].input).tracked);
    EXPECT_GE(lost[1].time_ns - lost[0].time_ns, TrackerTranslator::kStopped_ns);
    std::string said;
    for (int i = 0; i < 10'000 && !said.contains("is silent"); ++i) {
        said += all_messages(*leaves);
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_TRUE(said.contains("no new pose of Tracker0/0 has come for 1 s: it is lost where it was")) << said;
    EXPECT_TRUE(said.contains("is silent")) << said;
    EXPECT_LT(said.find("no new pose"), said.find("is silent")) << "before the server is given up: " << said;
    EXPECT_GE(quiet.pings(), 1u);
    EXPECT_FALSE(all_messages(*keeps).contains("silent"));
}

// What was on its way for too long is no place of now, and the pose before says nothing twice. The server's clock is
// its own: ten years behind.
TEST(VrpnTracker, TakesNoPoseThatIsStaleByTheServersOwnTime) {
    RawServer server;
    // All arrive at one time, so that the stamps alone say how late they come, on a busy machine too.
    ToldClock clock;
    const auto tracker = server.opened(clock);
    constexpr std::int64_t kThen_us = 1'480'000'000'000'000;
    VrpnServerBytes report;
    const auto add = [&](double x_m, std::int64_t time_us) {
        report.message(9, 7, vrpn_pos_quat(0, {{x_m, 1.6, 2.0}, {1, 0, 0, 0}}), time_us);
    };
    add(0.1, kThen_us);
    for (int i = 0; i < 4; ++i) add(0.2, kThen_us + 1);
    add(0.3, kThen_us + 1 - 700'000);
    add(0.4, kThen_us + 2);
    server.send(report.bytes());
    const auto heads = of_kind<HeadInput>(heard_until(*tracker, [](const auto& all) { return all.size() >= 4; }));
    ASSERT_EQ(heads.size(), 4u);
    EXPECT_EQ(heads[0].pose_world.position_m.x, 0.1);
    EXPECT_EQ(heads[1].pose_world.position_m.x, 0.2);
    EXPECT_FALSE(heads[2].tracked);
    EXPECT_EQ(heads[2].pose_world.position_m.x, 0.2) << "where it was last";
    EXPECT_TRUE(heads[3].tracked);
    const std::string said = all_messages(*tracker);
    EXPECT_TRUE(said.contains("sends poses of Tracker0/0 that are 0.7 s late")) << said;
}

TEST(VrpnTracker, TheListSaysHowOldTheNewestPoseIs) {
    const RunningServer fresh({.rate_Hz = 100.0});
    auto found = look_for_vrpn_at({"127.0.0.1", fresh.port()});
    // A busy machine may keep the server from sending, or us from reading, for longer than that.
    for (int i = 0; i < 20 && found.size() == 1 && !found[0].cause.contains("less than 0.1 s old"); ++i)
        found = look_for_vrpn_at({"127.0.0.1", fresh.port()});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].cause.contains("; its poses are less than 0.1 s old")) << found[0].cause;
    RawServer old;
    std::thread greets([&] {
        old.greet();
        const auto now = std::chrono::system_clock::now().time_since_epoch();
        old.send_pose({0.1, 1.6, 2.0}, {1, 0, 0, 0}, 0,
                      std::chrono::duration_cast<std::chrono::microseconds>(now).count() - 5'000'000);
    });
    const auto stale = look_for_vrpn_at(*network_address(old.where().substr(5), {}));
    greets.join();
    ASSERT_EQ(stale.size(), 1u);
    // At least the five seconds; more where a busy machine has read it late.
    const std::string_view words = "its newest pose is ";
    const std::size_t at = stale[0].cause.find(words);
    ASSERT_NE(at, std::string::npos) << stale[0].cause;
    const double age_s = std::strtod(stale[0].cause.c_str() + at + words.size(), nullptr);
    EXPECT_TRUE(age_s >= 5.0 && age_s < 35.0) << stale[0].cause;
    EXPECT_TRUE(stale[0].cause.contains("stale")) << stale[0].cause;
}

TEST(VrpnTracker, LeavesAStreamThatItCannotFollow) {
    RawServer server;
    MonotonicClock clock;
    const auto tracker = server.opened(clock);
    server.send(std::vector<std::byte>(64, static_cast<std::byte>(0xee)));
    std::string said;
    for (int i = 0; i < 5000 && !said.contains("a message of"); ++i) {
        said += all_messages(*tracker);
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_TRUE(said.contains("sends a message of -286331154 bytes")) << said;
    server.hang_up();
    server.greet();  // it is looked for again
    server.send_pose({0.0, 1.65, 0.0});
    EXPECT_EQ(heard_until(*tracker, [](const auto& all) { return !all.empty(); }).size(), 1u);
}

TEST(VrpnTracker, SaysWhatIsWrongWithAnAddressAServerAndASetting) {
    EXPECT_TRUE(refused("vrpn:127.0.0.1:1").contains("cannot be reached at 127.0.0.1:1: Connection refused"))
        << refused("vrpn:127.0.0.1:1");
    EXPECT_TRUE(refused("vrpn:127.0.0.1:1").contains("burin devices emulate vrpn"));
    EXPECT_TRUE(refused("vrpn:no.such.machine.invalid").contains("no such machine"));
    EXPECT_TRUE(refused("vrpn:localhost:x").contains("names no server"));
    EXPECT_TRUE(refused("vrpn:Tracker0@localhost").contains("vrpn:localhost,head=Tracker0"));
    EXPECT_TRUE(refused("vrpn:localhost,haed=Tracker0").contains("the nearest is head="));
    EXPECT_TRUE(refused("vrpn:localhost,head=Tracker0/x").contains("names nothing"));
    EXPECT_TRUE(refused("vrpn:localhost,head=/1").contains("names nothing"));
    EXPECT_TRUE(refused("vrpn:localhost,axes=+x+y-z").contains("no mirror image"));
    EXPECT_TRUE(refused("vrpn:localhost,axes=+x+x+z").contains("are no axes"));
    RawServer other;
    std::thread answers([&] {
        other.accept();
        const std::string text = "vrpn: ver. 08.00  0, later";
        other.send(std::as_bytes(std::span(text)));
    });
    EXPECT_TRUE(refused(other.where()).contains("speaks version 08.00 of VRPN, and Burin version 07"));
    answers.join();
}

TEST(EmulatedVrpn, CallsAClientBackThatAsksByADatagramAsVrpnsOwnDo) {
    RunningServer server;
    const auto waits = listen_at({"127.0.0.1", 0}).value();
    const auto asks = receive_at({"127.0.0.1", 0}).value();
    const auto to = connect_to({"127.0.0.1", server.port()}, 1'000'000'000).value();  // and leaves it alone
    sockaddr_storage server_address{};
    socklen_t size = sizeof(server_address);
    ASSERT_EQ(::getpeername(to.get(), reinterpret_cast<sockaddr*>(&server_address), &size), 0);
    const std::string lob = "10.1.2.3 " + std::to_string(waits.bound.port);  // not where the sender is
    ASSERT_EQ(::sendto(asks.socket.get(), lob.c_str(), lob.size() + 1, 0,
                       reinterpret_cast<const sockaddr*>(&server_address), size),
              static_cast<ssize_t>(lob.size() + 1));
    OwnedFile called;
    for (int i = 0; i < 5000 && !called; ++i) {
        called = OwnedFile(::accept4(waits.socket.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (!called) std::this_thread::sleep_for(milliseconds(1));
    }
    ASSERT_TRUE(called);
    std::array<char, kVrpnCookieBytes> cookie{};
    ASSERT_EQ(::recv(called.get(), cookie.data(), cookie.size(), MSG_WAITALL), static_cast<ssize_t>(cookie.size()));
    EXPECT_EQ(std::string(cookie.data()), "vrpn: ver. 07.38  0");
}

}  // namespace burin::devices
