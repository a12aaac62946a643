// SPDX-License-Identifier: MIT
// What drivers and devices say to each other, written out by hand from the protocols: another value in every field, and
// both directions of each against the same bytes or calls. The glove's line and the calls of makers' libraries
// have files of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "devices/emulators/spacemouse_wire.hpp"
#include "devices/emulators/vrpn_wire.hpp"
#include "devices/falcon/falcon_line.hpp"
#include "devices/spacemouse/spacemouse_report.hpp"
#include "devices/trackers/dtrack_protocol.hpp"
#include "devices/trackers/vrpn_protocol.hpp"
#include "tests/devices/hand_written_bytes.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

std::string text_of_wire(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte byte : bytes) text += static_cast<char>(byte);
    return text;
}

// A cable that keeps what is written to it as it is, and answers with a packet that a test has written.
class RawFalconPort final : public FalconPort {
public:
    struct Log {
        std::vector<std::pair<int, int>> requests;
        std::vector<std::string> packets;
        std::string answers =
            "<AAAAAAAAAAAA\xb1"  // all three homed: 0x70 above 'A'
            "A>";
    };
    explicit RawFalconPort(Log& log) : log_(log) {}
    Cable request(FtdiRequest what, std::uint16_t value) noexcept override {
        log_.requests.emplace_back(static_cast<int>(what), int{value});
        return Cable::well;
    }
    Cable write(std::span<const std::byte> bytes, Nanoseconds) noexcept override {
        log_.packets.push_back(text_of_wire(bytes));
        return Cable::well;
    }
    Cable read(std::span<std::byte, kFtdiPiece> piece, std::size_t& count, Nanoseconds) noexcept override {
        piece[0] = std::byte{0x01}, piece[1] = std::byte{0x60};  // the chip's own
        for (std::size_t i = 0; i < log_.answers.size(); ++i) piece[2 + i] = static_cast<std::byte>(log_.answers[i]);
        count = 2 + log_.answers.size();
        return Cable::well;
    }

private:
    Log& log_;
};

// The number of a leg in a packet: four nibbles above 'A', the lowest first.
int number_in(const std::string& packet, std::size_t leg) {
    unsigned value = 0;
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
        value += static_cast<unsigned>(packet[1 + 4 * leg + nibble] - 'A') << (4 * nibble);
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(value));
}

FalconLine falcon_line_at(RawFalconPort::Log& log) {
    return {
        "falcon", [&]() -> Result<std::unique_ptr<FalconPort>> { return std::make_unique<RawFalconPort>(log); }, {}};
}

}  // namespace

TEST(WireBytes, AFalconIsOpenedSettledAndToldByPacketsOfItsOwnForm) {
    RawFalconPort::Log log;
    FalconLine line = falcon_line_at(log);
    ASSERT_TRUE(line.open());
    // Latency 1 ms (9), 1,500,000 a second (3: divisor 2), purges in and out (0: 1 and 2).
    EXPECT_EQ(log.requests, (std::vector<std::pair<int, int>>{{9, 1}, {3, 2}, {0, 1}, {0, 2}}));
    // No torque, and the lamp red (8) while it homes (1): 9 above 'A' is 'J'.
    EXPECT_EQ(log.packets, (std::vector<std::string>{"<AAAAAAAAAAAAJA>"}));
    log.packets.clear();
    ServedState state;
    // Buttons plus and centre (5), all homed (0x70): 0x75 above 'A'. Encoders 0x0123, 0xfedd (-291) and 0x0056, the
    // lowest nibble first.
    state.fault = DeviceFault::none;
    log.answers =
        "<DCBANNOPGFAA\xb6"
        "A>";
    ASSERT_TRUE(line.turn({}, state));
    EXPECT_EQ(log.packets, (std::vector<std::string>{"<AAAAAAAAAAAAJA>"})) << "red until it has said that it is homed";
    EXPECT_EQ(state.buttons, 5u);
    EXPECT_EQ(state.fault, DeviceFault::none);
    const auto where = falcon_forward(falcon_angles({0x0123, static_cast<std::int16_t>(0xfedd), 0x0056}));
    ASSERT_TRUE(where);
    EXPECT_LT(glm::distance(state.pose_device.position_m, where->grip_m - Vec3(0.0, 0.0, 0.1245)), 1e-9);
    ASSERT_TRUE(line.turn({}, state));
    EXPECT_EQ(log.packets.back(), "<AAAAAAAAAAAADA>") << "homed and without force: green (2) and homing (1)";
    const Vec3 force_N(0.7, -1.3, 2.1);
    ASSERT_TRUE(line.turn({force_N, Vec3(0.0)}, state));
    const std::string& told = log.packets.back();
    ASSERT_EQ(told.size(), 16u);
    EXPECT_EQ(told.substr(13), "FA>") << "blue (4) and homing (1)";
    FalconAngles torques_Nm{};
    for (std::size_t leg = 0; leg < kFalconLegs; ++leg) torques_Nm[leg] = -number_in(told, leg) / 10000.0;
    // A motor that is commanded forwards turns its arm backwards. The torques do the work of the force, whichever way
    // the grip moves.
    for (std::size_t leg = 0; leg < kFalconLegs; ++leg)
        EXPECT_NEAR(torques_Nm[leg], glm::dot(force_N, where->moves_m_per_rad[leg]), 1e-4) << leg;
    EXPECT_LT(glm::distance(falcon_force(*where, torques_Nm), force_N), 0.01);
}

TEST(WireBytes, AFalconThatIsNotHomedIsToldNoForceAndTheLampIsRedInEachTurn) {
    RawFalconPort::Log log;
    FalconLine line = falcon_line_at(log);
    ASSERT_TRUE(line.open());
    // Each of the three that is missing, by itself and with others: bits 4 to 6 of the byte.
    for (int homed = 0; homed < 7; ++homed) {
        log.answers = std::string("<AAAAAAAAAAAA") + static_cast<char>('A' + 16 * homed) + "A>";
        for (int turn = 0; turn < 3; ++turn) {
            ServedState state;
            ASSERT_TRUE(line.turn({Vec3(0.7, -1.3, 2.1), Vec3(0.0)}, state));
            EXPECT_NE(state.fault, DeviceFault::none) << homed;
            EXPECT_EQ(log.packets.back(), "<AAAAAAAAAAAAJA>") << homed << " in turn " << turn;
        }
    }
}

TEST(WireBytes, ASpaceMouseSaysPushAndTurnInLittleEndianNumbersOfItsOwnAxes) {
    // Report 1: x 100, y -200, z 300; then about x -50, about y 150, about z -250. Newer devices in one report.
    const auto joined = hand_written({1, 0x64, 0x00, 0x38, 0xff, 0x2c, 0x01, 0xce, 0xff, 0x96, 0x00, 0x06, 0xff});
    const auto push = hand_written({1, 0x64, 0x00, 0x38, 0xff, 0x2c, 0x01});
    const auto turn = hand_written({2, 0xce, 0xff, 0x96, 0x00, 0x06, 0xff});
    // Full deflection is 350. HID's z is down and its y towards the user: x, -z and y of it are the device's.
    const Vec3 pushed(100 / 350.0, -300 / 350.0, -200 / 350.0), turned(-50 / 350.0, 250 / 350.0, 150 / 350.0);
    const auto is = [](const std::optional<Vec3>& read, const Vec3& said) {
        return read && glm::distance(*read, said) < 1e-12;
    };
    const auto both = spacemouse_report(joined, SpaceMouseKeys::plain);
    ASSERT_TRUE(both);
    EXPECT_TRUE(is(both->push, pushed) && is(both->turn, turned));
    const auto pushes = spacemouse_report(push, SpaceMouseKeys::plain);
    EXPECT_TRUE(pushes && is(pushes->push, pushed) && !pushes->turn);
    const auto turns = spacemouse_report(turn, SpaceMouseKeys::plain);
    EXPECT_TRUE(turns && is(turns->turn, turned) && !turns->push);
    EXPECT_TRUE(std::ranges::equal(cap_joined_report(pushed, turned), joined));
    EXPECT_TRUE(std::ranges::equal(cap_push_report(pushed), push));
    EXPECT_TRUE(std::ranges::equal(cap_turn_report(turned), turn));
    // Report 3: a mask, the lowest bits first. Each button of a plain device is its own bit.
    for (unsigned button = 0; button < 16; ++button) {
        const unsigned mask = 1u << button;
        const auto bytes = hand_written({3, mask & 0xff, mask >> 8});
        EXPECT_TRUE(std::ranges::equal(cap_button_report(mask), bytes)) << button;
        EXPECT_EQ(spacemouse_report(bytes, SpaceMouseKeys::plain)->buttons, mask) << button;
    }
    // A Pro's keys, as spacenavd counts them (bnhack_smpro in dev.c).
    const std::array kProKeys{
        hand_written({3, 0, 0x10, 0, 0}), hand_written({3, 0, 0x20, 0, 0}),
        hand_written({3, 0, 0x40, 0, 0}), hand_written({3, 0, 0x80, 0, 0}),  // 1 to 4
        hand_written({3, 1, 0, 0, 0}),    hand_written({3, 2, 0, 0, 0}),     // Menu, Fit
        hand_written({3, 4, 0, 0, 0}),    hand_written({3, 0x10, 0, 0, 0}),
        hand_written({3, 0x20, 0, 0, 0}),                                 // T, R, F
        hand_written({3, 0, 1, 0, 0}),    hand_written({3, 0, 0, 0, 4}),  // turned; lock
        hand_written({3, 0, 0, 0x40, 0}), hand_written({3, 0, 0, 0x80, 0}),
        hand_written({3, 0, 0, 0, 1}),    hand_written({3, 0, 0, 0, 2})};  // Esc, Alt, Shift, Ctrl
    for (unsigned button = 0; button < kProKeys.size(); ++button)
        EXPECT_EQ(spacemouse_report(kProKeys[button], SpaceMouseKeys::pro)->buttons, 1u << button) << button;
}

TEST(WireBytes, VrpnsPayloadsAreBigEndianWithAQuaternionOfXYZW) {
    const auto pose = hand_written({0x00, 0x00, 0x01, 0x02, 0, 0, 1, 2,    // sensor 258, and again
                                    0x3f, 0xf8, 0,    0,    0, 0, 0, 0,    // x 1.5
                                    0xc0, 0x02, 0,    0,    0, 0, 0, 0,    // y -2.25
                                    0x3f, 0xc0, 0,    0,    0, 0, 0, 0,    // z 0.125
                                    0x3f, 0xe0, 0,    0,    0, 0, 0, 0,    // turn's x 0.5
                                    0xbf, 0xd0, 0,    0,    0, 0, 0, 0,    // y -0.25
                                    0x3f, 0xe8, 0,    0,    0, 0, 0, 0,    // z 0.75
                                    0x3f, 0xd8, 0,    0,    0, 0, 0, 0});  // w 0.375
    const VrpnPose said{258, {1.5, -2.25, 0.125}, Quat(0.375, 0.5, -0.25, 0.75)};
    EXPECT_EQ(vrpn_pos_quat(said.sensor, {said.position_m, said.orientation}), pose);
    const auto read = vrpn_pose(pose);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->sensor, 258);
    EXPECT_EQ(read->position_m, said.position_m);
    EXPECT_EQ(read->orientation, said.orientation);
    const auto channels = hand_written({0x40, 0x08, 0, 0, 0, 0, 0, 0,    // three
                                        0x3f, 0xe0, 0, 0, 0, 0, 0, 0,    // 0.5
                                        0xbf, 0xd0, 0, 0, 0, 0, 0, 0,    // -0.25
                                        0x3f, 0xe8, 0, 0, 0, 0, 0, 0});  // 0.75
    EXPECT_EQ(vrpn_analog_channels(std::array{0.5, -0.25, 0.75}), channels);
    EXPECT_EQ(vrpn_channels(channels), (std::vector<double>{0.5, -0.25, 0.75}));
    const auto buttons = hand_written({0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2});
    EXPECT_EQ(vrpn_button_states(std::array<std::int32_t, 3>{1, 0, 2}), buttons);
    EXPECT_EQ(vrpn_buttons(buttons), (std::vector<std::int32_t>{1, 0, 2}));
    const auto change = hand_written({0, 0, 2, 3, 0, 0, 0, 1});
    EXPECT_EQ(vrpn_button_change(515, 1), change);
    const auto changed = vrpn_button(change);
    EXPECT_TRUE(changed && changed->button == 515 && changed->state == 1);
}

TEST(WireBytes, DTracksTextHasMillimetresAndRotationsColumnByColumn) {
    // The turn takes x to y, y to z and z to x: the columns of its matrix are 0 1 0, 0 0 1 and 1 0 0.
    const std::string text =
        "fr 4711\r\n"
        "6df2 2 2 [1 1.000 5 2][-400.0000 1200.0000 1400.5000][0.000000000 1.000000000 0.000000000 0.000000000 "
        "0.000000000 1.000000000 1.000000000 0.000000000 0.000000000][19 0.25 -0.75]"
        " [4 -1.000 3 2][10.0000 20.0000 30.0000][1.000000000 0.000000000 0.000000000 0.000000000 1.000000000 "
        "0.000000000 0.000000000 0.000000000 1.000000000][6 -0.50 1.00]\r\n"
        "6d 2 [0 1.000][100.0000 1650.0000 2000.2500 0.0000 0.0000 0.0000][0.000000000 1.000000000 0.000000000 "
        "0.000000000 0.000000000 1.000000000 1.000000000 0.000000000 0.000000000]"
        " [7 -1.000][1.0000 2.0000 3.0000 0.0000 0.0000 0.0000][1.000000000 0.000000000 0.000000000 0.000000000 "
        "1.000000000 0.000000000 0.000000000 0.000000000 1.000000000]\r\n";
    const Quat turned(0.5, 0.5, 0.5, 0.5), not_turned(1.0, 0.0, 0.0, 0.0);
    DTrackFrame said;
    said.number = 4711;
    said.bodies = {{0, true, {{0.1, 1.65, 2.00025}, turned}}, {7, false, {{0.001, 0.002, 0.003}, not_turned}}};
    said.flysticks = {{{1, true, {{-0.4, 1.2, 1.4005}, turned}}, 5, 19, {0.25, -0.75}},
                      {{4, false, {{0.01, 0.02, 0.03}, not_turned}}, 3, 6, {-0.5, 1.0}}};
    const DTrackFrame read = dtrack_frame(text);
    EXPECT_EQ(read.fault, "");
    EXPECT_EQ(read.number, 4711u);
    const auto expect_same_body = [](const DTrackBody& is, const DTrackBody& was) {
        EXPECT_EQ(is.number, was.number);
        EXPECT_EQ(is.is_tracked, was.is_tracked) << was.number;
        EXPECT_LT(glm::distance(is.pose.position_m, was.pose.position_m), 1e-9) << was.number;
        for (const Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
            EXPECT_LT(glm::distance(is.pose.orientation * axis, was.pose.orientation * axis), 1e-9) << was.number;
    };
    ASSERT_EQ(read.bodies.size(), 2u);
    ASSERT_EQ(read.flysticks.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        expect_same_body(read.bodies[i], said.bodies[i]);
        expect_same_body(read.flysticks[i].body, said.flysticks[i].body);
        EXPECT_EQ(read.flysticks[i].button_count, said.flysticks[i].button_count);
        EXPECT_EQ(read.flysticks[i].buttons, said.flysticks[i].buttons);
        EXPECT_EQ(read.flysticks[i].sticks, said.flysticks[i].sticks);
    }
    EXPECT_LT(glm::distance(read.bodies[0].pose.orientation * Vec3(1, 0, 0), Vec3(0, 1, 0)), 1e-9);
}

}  // namespace burin::devices
