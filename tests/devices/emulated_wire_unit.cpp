// SPDX-License-Identifier: MIT
// Bytes of a session of several frames with the emulated SpaceMouse, VRPN server and DTrack controller, written out by
// hand. Poses, axes and indices differ from one another; counts, flags and padding repeat. Both ends are asked about
// the same bytes, so a fault that driver and emulator have in common shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "devices/emulators/dtrack_wire.hpp"
#include "devices/emulators/emulated_dtrack.hpp"
#include "devices/emulators/emulated_spacemouse.hpp"
#include "devices/emulators/emulated_vrpn.hpp"
#include "devices/spacemouse/spacemouse_report.hpp"
#include "devices/trackers/vrpn_protocol.hpp"
#include "tests/devices/hand_written_bytes.hpp"

namespace burin::devices {
namespace {

using WireBytesList = std::vector<std::vector<std::byte>>;

// Frames one after the other.
std::vector<std::byte> stream_of(const WireBytesList& frames) {
    std::vector<std::byte> stream;
    for (const auto& frame : frames) stream.insert(stream.end(), frame.begin(), frame.end());
    return stream;
}

// A message of VRPN that names something: its length, the number that is named, 0xff for a sender or 0xfe for a type,
// the length of the name with its zero, the name, and how many zeros follow.
std::vector<std::byte> named_by_hand(unsigned length, unsigned number, unsigned kind, unsigned name_length,
                                     std::string_view name, std::size_t zeros) {
    auto bytes = hand_written({0, 0,      0,    length, 0,    0,    0, 0, 0, 0, 0, 0, 0, 0,
                               0, number, 0xff, 0xff,   0xff, kind, 0, 0, 0, 0, 0, 0, 0, name_length});
    for (const char character : name) bytes.push_back(static_cast<std::byte>(character));
    bytes.resize(bytes.size() + zeros);
    return bytes;
}

std::vector<std::byte> text_by_hand(std::string_view text, std::size_t zeros) {
    std::vector<std::byte> bytes;
    for (const char character : text) bytes.push_back(static_cast<std::byte>(character));
    bytes.resize(bytes.size() + zeros);
    return bytes;
}

// 16,909,060 s and 329,223 us: 0x01020304 and 0x00050607.
constexpr std::int64_t kStamp_us = 16'909'060'329'223;

// Two poses whose numbers are sums of few powers of two, and so have short bytes.
const Pose kHeadOfWire{{1.5, -2.25, 0.125}, Quat(0.375, 0.5, -0.25, 0.75)};
const Pose kWandOfWire{{-3.0, 0.625, 5.0}, Quat(0.1875, -0.125, 0.875, -0.6875)};

// A pose in a report of the server's; each line is a number.
std::vector<std::byte> head_by_hand(unsigned sensor) {
    return hand_written({0,    0,    0, 0x58,   1, 2, 3, 4,      0, 5, 6, 7,  // 88 bytes, at that time
                         0,    0,    0, 2,      0, 0, 0, 3,      0, 0, 0, 0,  // of Tracker0, of a pose
                         0,    0,    0, sensor, 0, 0, 0, sensor,              //
                         0x3f, 0xf8, 0, 0,      0, 0, 0, 0,                   // x 1.5
                         0xc0, 0x02, 0, 0,      0, 0, 0, 0,                   // y -2.25
                         0x3f, 0xc0, 0, 0,      0, 0, 0, 0,                   // z 0.125
                         0x3f, 0xe0, 0, 0,      0, 0, 0, 0,                   // turn's x 0.5
                         0xbf, 0xd0, 0, 0,      0, 0, 0, 0,                   // y -0.25
                         0x3f, 0xe8, 0, 0,      0, 0, 0, 0,                   // z 0.75
                         0x3f, 0xd8, 0, 0,      0, 0, 0, 0});                 // w 0.375
}

std::vector<std::byte> wand_by_hand(unsigned sensor) {
    return hand_written({0,    0,    0, 0x58,   1, 2, 3, 4,      0, 5, 6, 7,  //
                         0,    0,    0, 2,      0, 0, 0, 3,      0, 0, 0, 0,  //
                         0,    0,    0, sensor, 0, 0, 0, sensor,              //
                         0xc0, 0x08, 0, 0,      0, 0, 0, 0,                   // x -3
                         0x3f, 0xe4, 0, 0,      0, 0, 0, 0,                   // y 0.625
                         0x40, 0x14, 0, 0,      0, 0, 0, 0,                   // z 5
                         0xbf, 0xc0, 0, 0,      0, 0, 0, 0,                   // turn's x -0.125
                         0x3f, 0xec, 0, 0,      0, 0, 0, 0,                   // y 0.875
                         0xbf, 0xe6, 0, 0,      0, 0, 0, 0,                   // z -0.6875
                         0x3f, 0xc8, 0, 0,      0, 0, 0, 0});                 // w 0.1875
}

// First words of the client in the session below: its cookie, and names for its numbers: 5 is Analog0, 6 Button0, 7 a
// ping and 8 a pong.
std::vector<std::byte> client_by_hand() {
    return stream_of({text_by_hand("vrpn: ver. 07.38  0", 5), named_by_hand(36, 5, 0xff, 8, "Analog0", 5),
                      named_by_hand(36, 6, 0xff, 8, "Button0", 5),
                      named_by_hand(51, 7, 0xfe, 23, "vrpn_Base ping_message", 6),
                      named_by_hand(51, 8, 0xfe, 23, "vrpn_Base pong_message", 6)});
}

std::vector<std::byte> bare_message_by_hand(unsigned sender, unsigned type) {
    return hand_written({0, 0, 0, 24, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, sender, 0, 0, 0, type, 0, 0, 0, 0});
}

}  // namespace

TEST(EmulatedWire, ASpaceMouseSendsTheReportsOfEachLayoutInItsOrder) {
    const std::vector<CapStand> stands{{.push = {0.2, -0.4, 0.6}, .turn = {-0.1, 0.3, -0.5}, .buttons = 1},
                                       {.push = {-0.8, 0.7, -0.9}, .turn = {0.36, -0.62, 0.94}, .buttons = 2},
                                       {.push = {1.7, -1.7, 0.02}, .turn = {0.04, 0.06, -0.08}, .buttons = 2},
                                       {.buttons = 0x104},
                                       {}};
    // Axes to the right, to the user and down: 70, 210, 140; -35, -175, -105. Then -280, -315, -245; 126, 329, 217.
    // Then 350, 7, 350; 14, -28, -21.
    const auto rest = hand_written({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const std::vector<WireBytesList> joined{
        {hand_written({3, 1, 0}),
         hand_written({1, 0x46, 0x00, 0xd2, 0x00, 0x8c, 0x00, 0xdd, 0xff, 0x51, 0xff, 0x97, 0xff})},
        {hand_written({3, 2, 0}),
         hand_written({1, 0xe8, 0xfe, 0xc5, 0xfe, 0x0b, 0xff, 0x7e, 0x00, 0x49, 0x01, 0xd9, 0x00})},
        {hand_written({1, 0x5e, 0x01, 0x07, 0x00, 0x5e, 0x01, 0x0e, 0x00, 0xe4, 0xff, 0xeb, 0xff})},
        {hand_written({3, 4, 1}), rest},
        {hand_written({3, 0, 0})}};
    const std::vector<WireBytesList> apart{
        {hand_written({3, 1, 0}), hand_written({1, 0x46, 0x00, 0xd2, 0x00, 0x8c, 0}),
         hand_written({2, 0xdd, 0xff, 0x51, 0xff, 0x97, 0xff})},
        {hand_written({3, 2, 0}), hand_written({1, 0xe8, 0xfe, 0xc5, 0xfe, 0x0b, 0xff}),
         hand_written({2, 0x7e, 0x00, 0x49, 0x01, 0xd9, 0x00})}};
    const auto sent = [&](std::size_t frame, bool is_joined) {
        return cap_reports(frame > 0 ? stands[frame - 1] : CapStand{}, stands[frame], is_joined);
    };
    for (std::size_t frame = 0; frame < joined.size(); ++frame) EXPECT_EQ(sent(frame, true), joined[frame]) << frame;
    for (std::size_t frame = 0; frame < apart.size(); ++frame) EXPECT_EQ(sent(frame, false), apart[frame]) << frame;
    EXPECT_TRUE(cap_reports({}, {}, true).empty()) << "one that rests is silent";
    for (std::size_t frame = 0; frame < 2; ++frame) {
        const CapStand& stand = stands[frame];
        const auto whole = spacemouse_report(joined[frame][1], SpaceMouseKeys::plain);
        const auto push = spacemouse_report(apart[frame][1], SpaceMouseKeys::plain);
        const auto turn = spacemouse_report(apart[frame][2], SpaceMouseKeys::plain);
        ASSERT_TRUE(whole && whole->push && whole->turn && push && push->push && turn && turn->turn) << frame;
        EXPECT_LT(glm::distance(*whole->push, stand.push) + glm::distance(*whole->turn, stand.turn), 1e-12) << frame;
        EXPECT_EQ(push->push, whole->push) << frame;
        EXPECT_EQ(turn->turn, whole->turn) << frame;
        EXPECT_EQ(spacemouse_report(joined[frame][0], SpaceMouseKeys::plain)->buttons, stand.buttons) << frame;
    }
    EXPECT_EQ(spacemouse_report(joined[3][0], SpaceMouseKeys::plain)->buttons, 0x104u);
}

TEST(EmulatedWire, AVrpnServerGreetsWithItsNamesAndHowButtonAndStickStand) {
    const auto names = stream_of(
        {text_by_hand("vrpn: ver. 07.38  0", 5), named_by_hand(41, 0, 0xff, 13, "VRPN Control", 8),
         named_by_hand(36, 1, 0xff, 8, "Button0", 5), named_by_hand(37, 2, 0xff, 9, "Tracker0", 4),
         named_by_hand(36, 3, 0xff, 8, "Analog0", 5), named_by_hand(51, 0, 0xfe, 23, "vrpn_Base pong_message", 6),
         named_by_hand(48, 1, 0xfe, 20, "vrpn_Analog Channel", 1),
         named_by_hand(47, 2, 0xfe, 19, "vrpn_Button Change", 2),
         named_by_hand(50, 3, 0xfe, 22, "vrpn_Tracker Pos_Quat", 7),
         named_by_hand(47, 4, 0xfe, 19, "vrpn_Button States", 2)});
    // One button, which is down; two channels, 0.25 and -0.5.
    const auto button = hand_written({0, 0, 0, 32, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1,  //
                                      0, 0, 0, 4,  0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1});
    const auto stick = hand_written({0,    0,    0, 48, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3,  //
                                     0,    0,    0, 1,  0, 0, 0, 0,                          //
                                     0x40, 0,    0, 0,  0, 0, 0, 0,                          //
                                     0x3f, 0xd0, 0, 0,  0, 0, 0, 0,                          //
                                     0xbf, 0xe0, 0, 0,  0, 0, 0, 0});
    EmulatedMotion now;
    now.is_pressed = true;
    now.stick = {0.25, -0.5};
    EXPECT_EQ(emulated_vrpn_greeting(now).bytes(), stream_of({names, button, stick}));
}

TEST(EmulatedWire, AVrpnServerReportsBothPosesAndWhatHasChanged) {
    EmulatedMotion first;
    first.head_world = kHeadOfWire, first.wand_world = kWandOfWire;
    first.is_pressed = true;
    first.stick = {0.25, -0.5};
    const auto pressed = hand_written({0, 0, 0, 32, 1, 2, 3, 4, 0, 5, 6, 7, 0, 0, 0, 1,  //
                                       0, 0, 0, 2,  0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});
    const auto stick = hand_written({0,    0,    0, 48, 1, 2, 3, 4, 0, 5, 6, 7, 0, 0, 0, 3,  //
                                     0,    0,    0, 1,  0, 0, 0, 0,                          //
                                     0x40, 0,    0, 0,  0, 0, 0, 0,                          //
                                     0x3f, 0xd0, 0, 0,  0, 0, 0, 0,                          //
                                     0xbf, 0xe0, 0, 0,  0, 0, 0, 0});
    const auto first_bytes = stream_of({head_by_hand(0), wand_by_hand(1), pressed, stick});
    EXPECT_EQ(emulated_vrpn_report({}, first, kStamp_us).bytes(), first_bytes);
    // The next: head and wand have changed places, and nothing else is new. Then the button is up.
    EmulatedMotion second = first;
    std::swap(second.head_world, second.wand_world);
    const auto second_bytes = stream_of({wand_by_hand(0), head_by_hand(1)});
    EXPECT_EQ(emulated_vrpn_report(first, second, kStamp_us).bytes(), second_bytes);
    EmulatedMotion third = second;
    third.is_pressed = false;
    auto released = pressed;
    released.back() = std::byte{0};
    EXPECT_EQ(emulated_vrpn_report(second, third, kStamp_us).bytes(), stream_of({second_bytes, released}));
}

TEST(EmulatedWire, ThePortsAreTheMakers) {
    EXPECT_EQ(kVrpnPort, 3883);
    EXPECT_EQ(kDTrackPort, 5000);
}

TEST(EmulatedWire, AVrpnServersBytesAreReadAsTheyWereMeant) {
    VrpnReader reader;
    const auto stream =
        stream_of({text_by_hand("vrpn: ver. 07.38  0", 5), named_by_hand(37, 2, 0xff, 9, "Tracker0", 4),
                   named_by_hand(50, 3, 0xfe, 22, "vrpn_Tracker Pos_Quat", 7), head_by_hand(0), wand_by_hand(1)});
    std::ranges::copy(stream, reader.room().begin());
    reader.came(stream.size());
    VrpnNames names;
    for (int i = 0; i < 2; ++i) {
        const auto message = reader.next();
        ASSERT_TRUE(message && names.take(*message)) << i;
    }
    for (const int sensor : {0, 1}) {
        const auto message = reader.next();
        ASSERT_TRUE(message) << sensor;
        EXPECT_EQ(message->time_us, kStamp_us);
        EXPECT_EQ(names.sender(message->sender), "Tracker0");
        EXPECT_EQ(names.type(message->type), "vrpn_Tracker Pos_Quat");
        const auto pose = vrpn_pose(message->payload);
        ASSERT_TRUE(pose) << sensor;
        EXPECT_EQ(pose->sensor, sensor);
        EXPECT_EQ(pose->position_m, (sensor == 0 ? kHeadOfWire : kWandOfWire).position_m);
        EXPECT_EQ(pose->orientation, (sensor == 0 ? kHeadOfWire : kWandOfWire).orientation);
    }
    EXPECT_FALSE(reader.next() || reader.failure());
}

TEST(EmulatedWire, AVrpnServerAnswersThePingsOfItsDevicesAlone) {
    VrpnBytes client;
    client.cookie().name(kVrpnSender, 5, "Analog0").name(kVrpnSender, 6, "Button0");
    client.name(kVrpnType, 7, kVrpnPing).name(kVrpnType, 8, kVrpnPong).message(6, 7).message(5, 7);
    const auto asks = stream_of({client_by_hand(), bare_message_by_hand(6, 7), bare_message_by_hand(5, 7)});
    EXPECT_EQ(client.bytes(), asks);
    // Pings of Button0 and of Analog0, which are the server's 1 and 3; then a pong, and a ping of nobody. Byte by byte.
    const auto more = stream_of({asks, bare_message_by_hand(5, 8), bare_message_by_hand(9, 7)});
    VrpnServerEar ear;
    std::vector<HeardVrpn> heard;
    WireBytesList answers;
    for (const std::byte byte : more)
        for (const HeardVrpn& said : ear.take({&byte, 1})) {
            heard.push_back(said);
            if (const auto answer = emulated_vrpn_answer(said)) answers.push_back(answer->bytes());
        }
    EXPECT_FALSE(ear.is_lost());
    ASSERT_EQ(heard.size(), 4u);
    EXPECT_EQ(heard[0].sender + ", " + heard[0].type, "Button0, vrpn_Base ping_message");
    EXPECT_EQ(heard[1].sender + ", " + heard[1].type, "Analog0, vrpn_Base ping_message");
    EXPECT_EQ(answers, (WireBytesList{bare_message_by_hand(1, 0), bare_message_by_hand(3, 0)}));
    EXPECT_FALSE(emulated_vrpn_answer({"VRPN Control", "vrpn_Base ping_message", {}})) << "it is no device";
}

TEST(EmulatedWire, AVrpnServerLeavesOtherVersionsLengthsAndNamesThanVrpnHas) {
    VrpnServerEar ear;
    EXPECT_TRUE(ear.take(text_by_hand("vrpn: ver. 06.38  0", 5)).empty());
    EXPECT_TRUE(ear.is_lost());
    // A name of 100 characters and its zero is none of VRPN's; the next one is.
    VrpnServerEar third;
    const auto long_name = stream_of(
        {text_by_hand("vrpn: ver. 07.38  0", 5), named_by_hand(129, 5, 0xff, 101, std::string(100, 'n'), 8),
         named_by_hand(36, 6, 0xff, 8, "Button0", 5), bare_message_by_hand(5, 7), bare_message_by_hand(6, 7)});
    const auto heard = third.take(long_name);
    ASSERT_EQ(heard.size(), 2u);
    EXPECT_EQ(heard[0].sender, "");
    EXPECT_EQ(heard[1].sender, "Button0");
    for (const unsigned length : {0u, 23u}) {
        VrpnServerEar other;
        auto bytes = stream_of({client_by_hand(), bare_message_by_hand(6, 7)});
        bytes[client_by_hand().size() + 3] = static_cast<std::byte>(length);
        EXPECT_TRUE(other.take(bytes).empty()) << length;
        EXPECT_TRUE(other.is_lost()) << length;
    }
}

// The sample of DTrackSDK's documentation. Its numbers are rounded; this turn is one that it may have been.
TEST(EmulatedWire, ADTrackControllerWritesThePublicSample) {
    const auto about = [](double degrees, const Vec3& axis) { return glm::angleAxis(glm::radians(degrees), axis); };
    DTrackFrame frame;
    frame.number = 3823;
    frame.bodies = {{0,
                     true,
                     {{0.084203, 0.037681, 0.172102},
                      about(99.197038, {1, 0, 0}) * about(6.713025, {0, 1, 0}) * about(9.657512, {0, 0, 1})}}};
    frame.flysticks = {{{0, false, {{0.1, 0.2, 0.3}, Quat(1, 0, 0, 0)}}, 8, 0, {0.0, 0.0, 0.0}}};
    EXPECT_EQ(controller_datagram(frame),
              "fr 3823\r\n6df2 1 1 [0 -1.000 8 3][0.000 0.000 0.000][0.000000 0.000000 0.000000 0.000000 0.000000 "
              "0.000000 0.000000 0.000000 0.000000][0 0.00 0.00 0.00] \r\n"
              "6d 1 [0 1.000][84.203 37.681 172.102 99.1970 6.7130 9.6575][0.979069 0.086946 0.184021 -0.166608 "
              "-0.176923 0.970021 0.116897 -0.980377 -0.158734] \r\n");
}

TEST(EmulatedWire, ADTrackControllerSendsHeadAndFlystickOfEachMeasurement) {
    // Turns by quaternions of whole numbers over the root of 39, whose matrices have whole numbers over 39.
    const double root = std::sqrt(39.0);
    EmulatedMotion now;
    now.head_world = {{0.1234, 1.6543, -2.345}, Quat(1 / root, 2 / root, 3 / root, 5 / root)};
    now.wand_world = {{-0.456, 0.789, 1.357}, Quat(5 / root, 1 / root, -3 / root, 2 / root)};
    now.is_pressed = true;
    now.stick = {0.25, -0.75};
    const std::string head =
        "[-0.743590 0.564103 0.358974 0.051282 -0.487179 0.871795 0.666667 0.666667 0.333333] \r\n";
    const std::string wand = "[0.333333 0.358974 0.871795 -0.666667 0.743590 -0.051282 -0.666667 -0.564103 0.487179]";
    const std::string first = "fr 4711\r\n6df2 1 1 [0 1.000 8 2][-456.000 789.000 1357.000]" + wand +
                              "[1 0.25 -0.75] \r\n"
                              "6d 1 [0 1.000][123.400 1654.300 -2345.000 -63.4349 41.8103 -176.0548]" +
                              head;
    EXPECT_EQ(emulated_dtrack_datagram(4711, now), first);
    const DTrackFrame read = dtrack_frame(first);
    EXPECT_EQ(read.fault, "");
    EXPECT_EQ(read.number, 4711u);
    ASSERT_TRUE(read.bodies.size() == 1 && read.flysticks.size() == 1);
    EXPECT_LT(glm::distance(read.bodies[0].pose.position_m, now.head_world.position_m), 1e-9);
    EXPECT_GT(std::abs(glm::dot(read.bodies[0].pose.orientation, now.head_world.orientation)), 1.0 - 1e-11);
    EXPECT_LT(glm::distance(read.flysticks[0].body.pose.position_m, now.wand_world.position_m), 1e-9);
    EXPECT_GT(std::abs(glm::dot(read.flysticks[0].body.pose.orientation, now.wand_world.orientation)), 1.0 - 1e-11);
    EXPECT_EQ(read.flysticks[0].button_count, 8u);
    EXPECT_EQ(read.flysticks[0].buttons, 1u);
    EXPECT_EQ(read.flysticks[0].sticks, (std::vector<double>{0.25, -0.75}));
    // The next one: the button is up, and the stick elsewhere.
    now.is_pressed = false;
    now.stick = {-0.5, 0.6};
    EXPECT_EQ(emulated_dtrack_datagram(4712, now),
              "fr 4712\r\n6df2 1 1 [0 1.000 8 2][-456.000 789.000 1357.000]" + wand +
                  "[0 -0.50 0.60] \r\n"
                  "6d 1 [0 1.000][123.400 1654.300 -2345.000 -63.4349 41.8103 -176.0548]" +
                  head);
}

}  // namespace burin::devices
