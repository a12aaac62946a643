// SPDX-License-Identifier: MIT
// A VRPN server that says little or the same again and again: what is asked of it, and what a person is told.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "devices/emulators/vrpn_wire.hpp"
#include "devices/trackers/vrpn_tracker.hpp"
#include "tests/devices/raw_vrpn_server.hpp"
#include "tests/devices/told_clock.hpp"

namespace burin::devices {

// A strict server: it answers the pings of the devices that it has, and of no others.
TEST(VrpnQuiet, KeepsAHeldButtonOfAQuietServerByPingsOfADeviceThatTheServerNames) {
    RawServer server;
    ToldClock clock;
    std::thread greets([&] {
        server.accept();
        server.send(VrpnServerBytes()
                        .cookie()
                        .sender(0, "VRPN Control")
                        .sender(9, "Pad0")
                        .type(3, "vrpn_Button States")
                        .type(4, "vrpn_Base pong_message")
                        .message(9, 3, vrpn_button_states(std::array{1}))
                        .bytes());
    });
    std::atomic<int> arrivals = 0;
    const std::string settings = ",head=Traker0/0,buttons0=Pad0";
    auto opened = VrpnTracker::open(server.where() + settings, {clock, [&] { ++arrivals; }, {}});
    greets.join();
    ASSERT_TRUE(opened) << opened.error().line();
    Tracker& tracker = **opened;
    ASSERT_EQ(of_kind<WandClick>(heard_until(tracker, [](const auto& all) { return !all.empty(); })),
              (std::vector<WandClick>{{0, 0, true}}));
    VrpnServerEar ear;
    constexpr int kRounds = 5;  // of more than a second each: without an answer it would be given up after three
    for (int round = 0; round < kRounds; ++round) {
        clock.move_on(VrpnTracker::kQuiet_ns + 100'000'000);
        bool is_pinged = false;
        for (int i = 0; i < 10'000 && !is_pinged; ++i) {
            for (const HeardVrpn& said : ear.take(server.heard()))
                is_pinged = is_pinged || (said.type == "vrpn_Base ping_message" && said.sender == "Pad0");
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ASSERT_TRUE(is_pinged) << "of a device that is there, in round " << round;
        const int before = arrivals;
        server.send(VrpnServerBytes().message(9, 4).bytes());
        for (int i = 0; i < 10'000 && arrivals == before; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_GT(arrivals, before) << "it has the answer";
    }
    EXPECT_TRUE(of_kind<WandClick>(tracker.take()).empty()) << "it is still held";
    const std::string said = all_messages(tracker);
    EXPECT_FALSE(said.contains("is silent")) << said;
    EXPECT_TRUE(said.contains("has no device for head = Traker0; it names Pad0")) << "told what is mistyped: " << said;
}

TEST(VrpnQuiet, TellsOfAStampThatNeverChanges) {
    RawServer server;
    ToldClock clock;
    const auto tracker = server.opened(clock);
    constexpr std::int64_t kThen_us = 1'480'000'000'000'000;
    for (int i = 0; i < 5; ++i) server.send_pose({0.01 * i, 1.65, 0.0}, {1, 0, 0, 0}, 0, kThen_us);
    const auto heard = heard_until(*tracker, [](const auto& all) { return !all.empty(); });
    ASSERT_EQ(heard.size(), 1u) << "the others say nothing new";
    std::string said;
    for (int i = 0; i < 10'000 && !said.contains("is lost where it was"); ++i) {
        server.send_pose({0.5, 1.65, 0.0}, {1, 0, 0, 0}, 0, kThen_us);
        clock.move_on(10'000'000);
        said += all_messages(*tracker);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(said.contains("poses of Tracker0/0 come with a time stamp that never changes")) << said;
}

}  // namespace burin::devices
