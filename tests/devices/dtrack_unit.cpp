// SPDX-License-Identifier: MIT
// ART's DTrack: a packet of its public documentation, packets that are not sound, and the emulated one over loopback.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/emulators/dtrack_wire.hpp"
#include "devices/emulators/emulated_dtrack.hpp"
#include "devices/trackers/dtrack_tracker.hpp"

namespace burin::devices {
namespace {

using std::chrono::milliseconds;

// A tracker on a free port of this machine, and a socket that sends to it.
class HeardDTrack {
public:
    explicit HeardDTrack(const std::string& settings = "")
        : tracker_(DTrackTracker::open("dtrack:0" + settings, {clock_, {}, {}}).value()),
          sender_(sender_to({"127.0.0.1", tracker_->port()}).value()) {}
    void send(const std::string& datagram) const { send_datagram(sender_, datagram); }
    // Waits until so many samples have come, but not for ever.
    [[nodiscard]] std::vector<TrackerSample> heard(std::size_t count) {
        std::vector<TrackerSample> all;
        for (int i = 0; i < 10'000 && all.size() < count; ++i) {
            for (TrackerSample& sample : tracker_->take()) all.push_back(std::move(sample));
            if (all.size() < count) std::this_thread::sleep_for(milliseconds(1));
        }
        return all;
    }
    // Waits until so much has been refused, but not for ever.
    [[nodiscard]] std::uint64_t refused(std::uint64_t count) {
        for (int i = 0; i < 5000 && tracker_->refused() < count; ++i) std::this_thread::sleep_for(milliseconds(1));
        return tracker_->refused();
    }
    [[nodiscard]] std::string messages() {
        for (const std::string& message : tracker_->take_messages()) said_ += message + "\n";
        return said_;
    }
    [[nodiscard]] DTrackTracker& tracker() { return *tracker_; }

private:
    MonotonicClock clock_;
    std::unique_ptr<DTrackTracker> tracker_;
    OwnedFile sender_;
    std::string said_;
};

const std::string kHead = "fr 1\r\n6d 1 [0 1.000][100 1650 2000 0 0 0][1 0 0 0 1 0 0 0 1]\r\n";

}  // namespace

// The sample of DTrackSDK's documentation.
TEST(DTrackProtocol, ReadsThePublicSample) {
    const DTrackFrame frame = dtrack_frame(
        "fr 3823\r\nts 44597.741924\r\n6dcal 1\r\n6df2 1 1 [0 -1.000 8 3][0.000 0.000 0.000][0.000000 0.000000 "
        "0.000000 "
        "0.000000 0.000000 0.000000 0.000000 0.000000 0.000000][0 0.00 0.00 0.00] \r\n6d 1 [0 1.000][84.203 37.681 "
        "172.102 99.1970 6.7130 9.6575][0.979069 0.086946 0.184021 -0.166608 -0.176923 0.970021 0.116897 -0.980377 "
        "-0.158734] \r\n3d 0\r\n");
    EXPECT_EQ(frame.fault, "");
    EXPECT_EQ(frame.number, 3823u);
    ASSERT_EQ(frame.bodies.size(), 1u);
    EXPECT_TRUE(frame.bodies[0].is_tracked);
    EXPECT_LT(glm::distance(frame.bodies[0].pose.position_m, Vec3(0.084203, 0.037681, 0.172102)), 1e-12);
    // Its three angles say the same rotation: R = Rx(99.1970) Ry(6.7130) Rz(9.6575), in degrees.
    const auto about = [](double degrees, const Vec3& axis) { return glm::angleAxis(glm::radians(degrees), axis); };
    const Quat by_angles = about(99.1970, {1, 0, 0}) * about(6.7130, {0, 1, 0}) * about(9.6575, {0, 0, 1});
    EXPECT_GT(std::abs(glm::dot(frame.bodies[0].pose.orientation, by_angles)), 1.0 - 1e-8);
    ASSERT_EQ(frame.flysticks.size(), 1u);
    EXPECT_FALSE(frame.flysticks[0].body.is_tracked);
    EXPECT_EQ(frame.flysticks[0].button_count, 8u);
    EXPECT_EQ(frame.flysticks[0].sticks.size(), 3u);
}

TEST(DTrackProtocol, ReadsBothFormsOfFlysticksAndTheNewerWhereBothAreThere) {
    const std::string block = "[1 2 3][1 0 0 0 1 0 0 0 1]";
    const DTrackFrame older = dtrack_frame("6df 1 [0 1.0 161][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n");
    ASSERT_EQ(older.flysticks.size(), 1u);
    EXPECT_EQ(older.flysticks[0].buttons, 161u);  // 0xa1: the first button, and both 0x20 and 0x80
    EXPECT_EQ(older.flysticks[0].sticks, (std::vector<double>{-1.0, 0.0}));
    EXPECT_EQ(dtrack_frame("6df 1 [0 1 192]" + block).flysticks[0].sticks, (std::vector<double>{1.0, 1.0}));
    const DTrackFrame both =
        dtrack_frame("6df2 2 1 [1 1.0 4 2]" + block + "[21 0.5 -0.25 9 9 9]\n6df 1 [0 1 0]" + block);
    ASSERT_EQ(both.flysticks.size(), 1u);
    EXPECT_EQ(both.flysticks[0].body.number, 1);
    EXPECT_EQ(both.flysticks[0].buttons, 5u) << "it has four buttons: the fifth bit is none";
    EXPECT_EQ(both.flysticks[0].sticks, (std::vector<double>{0.5, -0.25}));
}

// Each passes some of the checks of a rotation: a stretched one of the volume 1, and one whose third column leans.
TEST(DTrackProtocol, TakesNoOtherMatrixForARotationAndNoOtherNumberForABody) {
    for (const std::string turn : {"1 0 0 0 2 0 0 0 0.5", "1 0 0 0 1 0 3 0 1"}) {
        const DTrackFrame frame = dtrack_frame("6d 1 [0 1.0][100 200 300 0 0 0][" + turn + "]");
        ASSERT_EQ(frame.bodies.size(), 1u) << frame.fault;
        EXPECT_EQ(glm::length(frame.bodies[0].pose.orientation), 0.0) << turn;
    }
    for (const std::string number : {"-1", "nan", "1e9"}) {
        const DTrackFrame frame = dtrack_frame("6d 1 [" + number + " 1.0][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1]");
        ASSERT_EQ(frame.bodies.size(), 1u) << frame.fault;
        EXPECT_EQ(frame.bodies[0].number, -1) << number;
    }
}

TEST(DTrackProtocol, WritesWhatItReads) {
    DTrackFrame frame;
    frame.number = 7;
    const Quat turned = glm::angleAxis(1.1, glm::normalize(Vec3(1.0, -2.0, 0.5)));
    frame.bodies = {{0, true, {{0.1, 1.65, 2.0}, turned}}, {3, false, {}}};
    frame.flysticks = {{{1, true, {{-0.4, 1.2, 1.4}, turned}}, 5, 9u, {0.25, -1.0}}};
    const DTrackFrame again = dtrack_frame(controller_datagram(frame));
    EXPECT_EQ(again.fault, "");
    ASSERT_EQ(again.bodies.size(), 2u);
    ASSERT_EQ(again.flysticks.size(), 1u);
    EXPECT_LT(glm::distance(again.bodies[0].pose.position_m, frame.bodies[0].pose.position_m), 1e-6);
    EXPECT_GT(std::abs(glm::dot(again.bodies[0].pose.orientation, turned)), 1.0 - 1e-9);
    EXPECT_FALSE(again.bodies[1].is_tracked);
    EXPECT_EQ(again.flysticks[0].buttons, 9u);
    EXPECT_EQ(again.flysticks[0].sticks, frame.flysticks[0].sticks);
}

TEST(DTrackProtocol, LeavesOutALineThatIsCutAndNamesIt) {
    const std::string whole = kHead;
    int with_body = 0;
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        const DTrackFrame frame = dtrack_frame(std::string_view(whole).substr(0, length));
        if (frame.bodies.empty()) continue;
        ++with_body;
        EXPECT_EQ(frame.bodies[0].pose.orientation, Quat(1.0, 0.0, 0.0, 0.0)) << length;
    }
    EXPECT_EQ(with_body, 3) << "with its last bracket, and with either end of the line behind that";
    EXPECT_EQ(dtrack_frame("6d 1 [0 1.0][1 2").fault, "6d");
    EXPECT_EQ(dtrack_frame("6d 4000000000 [0 1.0]").fault, "6d");
    EXPECT_EQ(dtrack_frame("6d 2 [0 1.0][1 2 3][1 0 0 0 1 0 0 0 1]").fault, "6d") << "two are said, and one comes";
    EXPECT_EQ(dtrack_frame("6df2 1 1 [0 1.0 9999 2][1 2 3][1 0 0 0 1 0 0 0 1][0 0 0]").fault, "6df2");
    EXPECT_EQ(dtrack_frame("6df2 1 1 [0 1.0 -5 nan][1 2 3][1 0 0 0 1 0 0 0 1][]").fault, "");
    EXPECT_EQ(dtrack_frame("fr x").fault, "fr");
    EXPECT_EQ(dtrack_frame("6di 1").fault, "6di");
    EXPECT_EQ(dtrack_frame("6dj 1 whatever [[\n6dmt 1\ngl 0\n").fault, "") << "lines of other kinds are no fault";
}

TEST(DTrackTracker, P2HearsHeadAndFlystickOfTheEmulatedOne) {
    HeardDTrack dtrack;
    std::atomic<bool> ends = false;
    std::thread sends([&] {
        constexpr double kBeforePress_s = 2.8;  // of the emulated motion
        EXPECT_TRUE(run_emulated_dtrack(
            {"127.0.0.1", dtrack.tracker().port()}, {}, [&] { return ends.load(); }, kBeforePress_s));
    });
    int heads = 0, wands = 0;
    std::vector<WandClick> clicks;
    for (int i = 0; i < 100 && clicks.size() < 2; ++i)
        for (const TrackerSample& sample : dtrack.heard(10)) {
            if (const auto* head = std::get_if<HeadInput>(&sample.input)) {
                ++heads;
                EXPECT_NEAR(head->pose_world.position_m.z, 2.0, 1e-7);
                // Six decimals of the rotation, and three of the millimetres.
                EXPECT_NEAR(2.0 * std::atan2(head->pose_world.orientation.y, head->pose_world.orientation.w),
                            0.15 * head->pose_world.position_m.x / 0.2, 2e-6);
            }
            if (const auto* wand = std::get_if<WandInput>(&sample.input)) {
                ++wands;
                EXPECT_NEAR(glm::length(wand->pose_world.position_m - Vec3(0.3, 1.2, 1.4)), 0.15, 1e-6);
            }
            if (const auto* click = std::get_if<WandClick>(&sample.input)) clicks.push_back(*click);
        }
    ends = true;
    sends.join();
    EXPECT_GT(heads, 100);
    EXPECT_GT(wands, 100);
    ASSERT_GE(clicks.size(), 2u);
    EXPECT_EQ(clicks[0], (WandClick{0, 0, true}));
    EXPECT_EQ(clicks[1], (WandClick{0, 0, false}));
    EXPECT_EQ(dtrack.tracker().refused(), 0u);
    EXPECT_TRUE(dtrack.messages().contains("DTrack at 127.0.0.1 is there"));
}

// Text as the controller's, in which nothing of the one flystick is as the other's: buttons 1 and 3 of the first, 2
// and 5 of the second.
TEST(DTrackTracker, GivesEachOfTwoFlysticksItsOwnPlaceButtonsAndStick) {
    HeardDTrack dtrack;
    dtrack.send(
        "fr 21\r\n6df2 2 2 [0 1.000 8 2][-312.500 1250.000 437.500][0 1 0 0 0 1 1 0 0][5 0.25 -0.75] "
        "[1 1.000 8 2][187.500 875.000 -625.000][0 0 1 1 0 0 0 1 0][18 -0.50 0.60] \r\n"
        "6d 2 [0 1.000][125.000 1656.250 2031.250 0 0 0][1 0 0 0 1 0 0 0 1] "
        "[1 1.000][999.000 998.000 997.000 0 0 0][1 0 0 0 1 0 0 0 1] \r\n");
    const auto heard = dtrack.heard(9);
    const std::array<Vec3, 2> places_m{Vec3(-0.3125, 1.25, 0.4375), Vec3(0.1875, 0.875, -0.625)};
    const std::array<Quat, 2> turns{Quat(0.5, 0.5, 0.5, 0.5), Quat(0.5, -0.5, -0.5, -0.5)};
    std::vector<WandClick> clicks;
    std::vector<WandStick> sticks;
    std::vector<std::uint32_t> wands;
    for (const TrackerSample& sample : heard) {
        if (const auto* head = std::get_if<HeadInput>(&sample.input)) {
            EXPECT_LT(glm::distance(head->pose_world.position_m, Vec3(0.125, 1.65625, 2.03125)), 1e-12);
        } else if (const auto* wand = std::get_if<WandInput>(&sample.input)) {
            wands.push_back(wand->wand);
            ASSERT_LT(wand->wand, 2u);
            EXPECT_LT(glm::distance(wand->pose_world.position_m, places_m[wand->wand]), 1e-12) << wand->wand;
            EXPECT_GT(std::abs(glm::dot(wand->pose_world.orientation, turns[wand->wand])), 1.0 - 1e-12) << wand->wand;
        } else if (const auto* click = std::get_if<WandClick>(&sample.input)) {
            clicks.push_back(*click);
        } else if (const auto* stick = std::get_if<WandStick>(&sample.input)) {
            sticks.push_back(*stick);
        }
    }
    EXPECT_EQ(heard.size(), 9u) << "a head, two wands, two presses of each and its stick";
    EXPECT_EQ(wands, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(clicks, (std::vector<WandClick>{{0, 0, true}, {0, 2, true}, {1, 1, true}, {1, 4, true}}));
    EXPECT_EQ(sticks, (std::vector<WandStick>{{0, {0.25, -0.75}}, {1, {-0.5, 0.6}}}));
}

TEST(DTrackTracker, AbsorbsTenThousandMeasurementsASecondAndHasTheNewest) {
    HeardDTrack dtrack;
    constexpr std::uint32_t kMeasurements = 10'000;
    std::thread sends([&] {
        DTrackFrame frame;
        frame.bodies = {{0, true, {}}};
        for (std::uint32_t number = 1; number <= kMeasurements; ++number) {
            frame.number = number;
            frame.bodies[0].pose.position_m.x = 0.0001 * number;
            dtrack.send(controller_datagram(frame));
            // Datagrams that a busy machine does not take in time are lost: a few at a time.
            if (number % 20 == 0) std::this_thread::sleep_for(milliseconds(2));
        }
    });
    std::size_t count = 0;
    double newest_m = 0.0;
    for (int i = 0; i < 2000 && newest_m < 0.99999; ++i) {
        for (const TrackerSample& sample : dtrack.tracker().take()) {
            ++count;
            newest_m = std::get<HeadInput>(sample.input).pose_world.position_m.x;
        }
        std::this_thread::sleep_for(milliseconds(16));
    }
    sends.join();
    EXPECT_EQ(count, std::size_t{kMeasurements});
    EXPECT_NEAR(newest_m, 1.0, 1e-9);
    EXPECT_EQ(dtrack.tracker().refused(), 0u);
}

TEST(DTrackTracker, LeavesOutWhatIsOvertakenAndWhatIsNoMeasurement) {
    HeardDTrack dtrack(",head=body/0,axes=+x+z-y");
    dtrack.send("fr 10\r\n6d 1 [0 1.0][100 200 300 0 0 0][1 0 0 0 1 0 0 0 1]\r\n");
    const auto heard = dtrack.heard(1);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_LT(glm::distance(std::get<HeadInput>(heard[0].input).pose_world.position_m, Vec3(0.1, 0.3, -0.2)), 1e-12);
    dtrack.send("fr 9\r\n6d 1 [0 1.0][999 200 300 0 0 0][1 0 0 0 1 0 0 0 1]\r\n");
    EXPECT_EQ(dtrack.refused(1), 1u);
    dtrack.send("hello\n");
    EXPECT_EQ(dtrack.refused(2), 2u);
    dtrack.send("fr 11\r\n6d 1 [0 1.0][nan 200 300 0 0 0][1 0 0 0 1 0 0 0 1]\r\n");
    EXPECT_EQ(dtrack.refused(3), 3u) << "a place that is no number";
    dtrack.send("fr 12\r\n6d 1 [0 1.0][100 200 300 0 0 0][2 0 0 0 1 0 0 0 1]\r\n");
    EXPECT_EQ(dtrack.refused(4), 4u) << "a rotation that is none";
    dtrack.send("fr 13\r\n6d 1 [0 1.0][100 200 300 0 0 0][1 0");
    EXPECT_EQ(dtrack.refused(5), 5u) << "a line that is cut";
    EXPECT_TRUE(dtrack.tracker().take().empty());
    dtrack.send("fr 14\r\n6d 1 [0 -1.0][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0]\r\n");
    const auto lost = dtrack.heard(1);
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_FALSE(std::get<HeadInput>(lost[0].input).tracked);
    EXPECT_LT(glm::distance(std::get<HeadInput>(lost[0].input).pose_world.position_m, Vec3(0.1, 0.3, -0.2)), 1e-12)
        << "where it was last";
}

// As DTrackSDK's parser reads the line (DTrackParser.cpp, parseLine_6di): "iid", "ddd", nine.
TEST(DTrackTracker, HearsAHybridBodyByItsStateAndLosesOneThatIsNotSeen) {
    HeardDTrack dtrack(",head=hybrid/1,wand0=hybrid/0");
    dtrack.send(
        "fr 1\r\n6di 2 [0 1 0.250][100 1650 2000][0 1 0 -1 0 0 0 0 1] [1 3 0.100][-300 1700 900][1 0 0 0 1 0 0 0 "
        "1]\r\n");
    const auto heard = dtrack.heard(2);
    ASSERT_EQ(heard.size(), 2u);
    const auto& wand = std::get<WandInput>(heard[0].input);
    EXPECT_LT(glm::distance(wand.pose_world.position_m, Vec3(0.1, 1.65, 2.0)), 1e-12);
    EXPECT_LT(glm::distance(wand.pose_world.orientation * Vec3(1, 0, 0), Vec3(0, 1, 0)), 1e-12) << "column by column";
    const auto& head = std::get<HeadInput>(heard[1].input);
    EXPECT_TRUE(head.tracked && wand.tracked) << "by the inertial sensor alone, and by both";
    EXPECT_LT(glm::distance(head.pose_world.position_m, Vec3(-0.3, 1.7, 0.9)), 1e-12);
    dtrack.send("fr 2\r\n6di 2 [0 0 0.0][0 0 0][0 0 0 0 0 0 0 0 0] [1 2 0.1][-300 1700 901][1 0 0 0 1 0 0 0 1]\r\n");
    const auto lost = dtrack.heard(2);
    ASSERT_EQ(lost.size(), 2u);
    EXPECT_FALSE(std::get<WandInput>(lost[0].input).tracked);
    EXPECT_TRUE(std::get<HeadInput>(lost[1].input).tracked) << "by the cameras";
    dtrack.send("fr 3\r\n6di 1 [0 2]\r\n");
    EXPECT_EQ(dtrack.refused(1), 1u);
    EXPECT_TRUE(dtrack.messages().contains("cannot read a line of measurements that begins with 6di"));
}

TEST(DTrackTracker, HearsAMulticastGroup) {
    MonotonicClock clock;
    constexpr const char* kGroup = "239.255.43.21";
    const auto tracker = DTrackTracker::open(std::string("dtrack:") + kGroup + ":0", {clock, {}, {}});
    ASSERT_TRUE(tracker) << tracker.error().line();
    // A controller on this machine's own network, so that nothing leaves it.
    const auto sender = receive_at({"127.0.0.1", 0}).value();
    in_addr loopback{};
    loopback.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::setsockopt(sender.socket.get(), IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof(loopback)), 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons((*tracker)->port());
    ASSERT_EQ(::inet_pton(AF_INET, kGroup, &to.sin_addr), 1);
    std::vector<TrackerSample> heard;
    for (int i = 0; i < 10'000 && heard.empty(); ++i) {
        static_cast<void>(::sendto(sender.socket.get(), kHead.data(), kHead.size(), 0,
                                   reinterpret_cast<const sockaddr*>(&to), sizeof(to)));
        std::this_thread::sleep_for(milliseconds(1));
        heard = (*tracker)->take();
    }
    ASSERT_FALSE(heard.empty());
    EXPECT_TRUE(std::get<HeadInput>(heard[0].input).tracked);
}

TEST(DTrackTracker, ListensToOneMachineUntilThatIsSilent) {
    HeardDTrack dtrack;
    // Its 60th measurement; the other machine's first is not older, as it counts by itself.
    dtrack.send("fr 60" + kHead.substr(4));
    ASSERT_EQ(dtrack.heard(1).size(), 1u);
    // All of 127.0.0.0/8 is this machine: a second sender.
    const auto other = receive_at({"127.0.0.2", 0}).value();
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(dtrack.tracker().port());
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const auto send_from_other = [&](const std::string& datagram) {
        ASSERT_EQ(::sendto(other.socket.get(), datagram.data(), datagram.size(), 0,
                           reinterpret_cast<const sockaddr*>(&to), sizeof(to)),
                  static_cast<ssize_t>(datagram.size()));
    };
    send_from_other(kHead);
    EXPECT_EQ(dtrack.refused(1), 1u);
    EXPECT_TRUE(dtrack.messages().contains("gets measurements of a second machine"));
    const auto lost = dtrack.heard(1);  // the first one is silent now
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_FALSE(std::get<HeadInput>(lost[0].input).tracked);
    EXPECT_TRUE(dtrack.messages().contains("DTrack is silent"));
    send_from_other(kHead);
    ASSERT_EQ(dtrack.heard(1).size(), 1u);
    EXPECT_TRUE(dtrack.messages().contains("DTrack at 127.0.0.2 is there"));
}

TEST(DTrackTracker, SaysWhatIsWrongWithAnAddress) {
    MonotonicClock clock;
    const auto refusal = [&](const std::string& where) {
        const auto tracker = open_tracker(where, {clock, {}, {}});
        return tracker ? "nothing" : tracker.error().line();
    };
    EXPECT_TRUE(refusal("dtrack:localhost:x").contains("has no such port or address"));
    EXPECT_TRUE(refusal("dtrack:99999").contains("has no such port or address")) << "99999 is no machine's name";
    EXPECT_TRUE(refusal("dtrack:no.such.invalid").contains("has no such port or address")) << "nor is that";
    EXPECT_TRUE(refusal("dtrack:no.such.invalid").contains("write dtrack:PORT"));
    EXPECT_TRUE(refusal("dtrack:10.255.255.1:0").contains("cannot be listened to"));
    EXPECT_TRUE(refusal("dtrack:0,haed=body/0").contains("the nearest is head="));
    HeardDTrack first;
    EXPECT_TRUE(refusal("dtrack:" + std::to_string(first.tracker().port())).contains("another program may have"));
}

}  // namespace burin::devices
