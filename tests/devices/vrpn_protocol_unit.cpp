// SPDX-License-Identifier: MIT
// VRPN's bytes: those of a public capture's form, and whatever a network may send instead.
#include "devices/trackers/vrpn_protocol.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "devices/emulators/vrpn_wire.hpp"

namespace burin::devices {
namespace {

void feed(VrpnReader& reader, std::span<const std::byte> bytes) {
    const auto room = reader.room();
    ASSERT_GE(room.size(), bytes.size());
    std::ranges::copy(bytes, room.begin());
    reader.came(bytes.size());
}

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
    std::vector<std::byte> bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

VrpnReader greeted() {
    VrpnReader reader;
    feed(reader, VrpnBytes().cookie().bytes());
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.has_cookie());
    return reader;
}

// A header with this length, and nothing behind it.
std::vector<std::byte> header_of(std::int32_t length) {
    std::vector<std::byte> bytes = VrpnBytes().message(0, 0).bytes();
    for (int i = 0; i < 4; ++i)
        bytes[static_cast<std::size_t>(i)] = static_cast<std::byte>(static_cast<std::uint32_t>(length) >> (24 - 8 * i));
    return bytes;
}

}  // namespace

// Written by hand from the protocol's description: length 24 + 8, padded to nothing more; button 3 pressed.
TEST(VrpnProtocol, WritesAndReadsTheBytesThatTheProtocolSays) {
    const auto by_hand =
        bytes_of({0, 0, 0, 32, 0, 0, 0, 2, 0, 0, 0, 5, 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 1});
    EXPECT_EQ(VrpnServerBytes().message(1, 4, vrpn_button_change(3, 1), 2'000'005).bytes(), by_hand);
    // A name of two letters and its zero: 4 + 3 bytes, padded by one that the length does not count.
    const auto name_by_hand = bytes_of({0,    0,    0,    31,   0, 0, 0, 0, 0, 0, 0, 0, 0,   0,   0, 7,
                                        0xff, 0xff, 0xff, 0xfe, 0, 0, 0, 0, 0, 0, 0, 3, 'a', 'b', 0, 0});
    EXPECT_EQ(VrpnBytes().name(kVrpnType, 7, "ab").bytes(), name_by_hand);
    EXPECT_EQ(VrpnServerBytes().type(7, "ab").bytes(), name_by_hand);
    VrpnReader reader = greeted();
    feed(reader, by_hand);
    feed(reader, name_by_hand);
    const auto message = reader.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->sender, 1);
    EXPECT_EQ(message->type, 4);
    EXPECT_EQ(message->time_us, 2'000'005);
    EXPECT_EQ(vrpn_button(message->payload)->button, 3);
    VrpnNames names;
    EXPECT_TRUE(names.take(*reader.next()));
    EXPECT_EQ(names.type(7), "ab");
    EXPECT_EQ(names.type(6), "");
    EXPECT_EQ(names.type(-1), "");
}

TEST(VrpnProtocol, ReadsMessagesThatComeByteByByte) {
    VrpnServerBytes sent;
    const Pose pose{{1.0, -2.5, 3.0}, {0.5, 0.5, -0.5, 0.5}};
    sent.cookie().sender(5, "Tracker0").message(5, 1, vrpn_pos_quat(2, pose));
    VrpnReader reader;
    std::vector<VrpnPose> poses;
    int messages = 0;
    for (const std::byte byte : sent.bytes()) {
        feed(reader, {&byte, 1});
        while (const auto message = reader.next()) {
            ++messages;
            if (message->type == 1) poses.push_back(*vrpn_pose(message->payload));
        }
    }
    EXPECT_EQ(messages, 2);
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_EQ(poses[0].sensor, 2);
    EXPECT_EQ(poses[0].position_m, pose.position_m);
    EXPECT_EQ(poses[0].orientation, pose.orientation);
}

TEST(VrpnProtocol, NamesAnotherVersionAndWhatIsNoVrpn) {
    const auto failure_of = [](std::string text) {
        text.resize(kVrpnCookieBytes);
        VrpnReader reader;
        feed(reader, std::as_bytes(std::span(text)));
        EXPECT_FALSE(reader.next());
        return reader.failure().value_or("none");
    };
    EXPECT_EQ(failure_of("vrpn: ver. 07.15  0"), "none") << "another minor version is understood";
    EXPECT_TRUE(failure_of("vrpn: ver. 06.06  0").contains("speaks version 06.06"))
        << failure_of("vrpn: ver. 06.06  0");
    EXPECT_TRUE(failure_of("HTTP/1.1 400 Bad Request\r\n").contains("is no VRPN server: it says 'HTTP/1.1"));
}

TEST(VrpnProtocol, GivesUpAStreamWithALengthThatNoMessageHas) {
    constexpr std::int32_t kMost = kVrpnHeaderBytes + kMostVrpnPayload;
    for (const std::int32_t length : {-1, 0, 23, kMost + 1, std::numeric_limits<std::int32_t>::max()}) {
        VrpnReader reader = greeted();
        feed(reader, header_of(length));
        EXPECT_FALSE(reader.next()) << length;
        EXPECT_TRUE(reader.failure()) << length;
    }
    VrpnReader reader = greeted();
    feed(reader, header_of(kMost));
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.failure()) << "it may still come";
    EXPECT_GE(reader.room().size(), kMostVrpnPayload) << "and there is room for it";
}

TEST(VrpnProtocol, TakesNoCountAtItsWord) {
    const std::vector<std::int32_t> states(kMostVrpnButtons + 1, 1);
    EXPECT_FALSE(vrpn_buttons(vrpn_button_states(states)));
    EXPECT_TRUE(vrpn_buttons(vrpn_button_states(std::span(states).first(kMostVrpnButtons))));
    auto cut = vrpn_button_states(std::span(states).first(10));
    cut.resize(cut.size() - 1);
    EXPECT_FALSE(vrpn_buttons(cut));
    EXPECT_FALSE(vrpn_buttons({}));
    const std::vector<double> channels(kMostVrpnChannels + 1, 0.5);
    EXPECT_FALSE(vrpn_channels(vrpn_analog_channels(channels)));
    auto nan = vrpn_analog_channels(std::span(channels).first(2));
    nan[0] = nan[1] = static_cast<std::byte>(0xff);
    EXPECT_FALSE(vrpn_channels(nan)) << "a count that is no number";
    auto pose = vrpn_pos_quat(0, {});
    pose.pop_back();
    EXPECT_FALSE(vrpn_pose(pose));
    EXPECT_FALSE(vrpn_button(bytes_of({0, 0, 0, 1, 0, 0, 0})));
}

// A server that describes a million devices.
TEST(VrpnProtocol, KeepsABoundedNumberOfNames) {
    VrpnReader reader = greeted();
    VrpnNames names;
    const std::string longest(kMostVrpnName, 'n');
    for (std::int32_t number = 0; number < 1'000'000; ++number) {
        feed(reader, VrpnBytes().name(kVrpnSender, number, longest).bytes());
        const auto message = reader.next();
        ASSERT_TRUE(message);
        EXPECT_TRUE(names.take(*message));
    }
    EXPECT_EQ(names.senders().size(), kMostVrpnNames);
    EXPECT_EQ(names.left_out(), 1'000'000 - kMostVrpnNames);
    EXPECT_TRUE(names.take({-7, kVrpnSender, {}}));
    EXPECT_TRUE(names.take({3, kVrpnSender, bytes_of({0, 0, 0, 9, 'x'})})) << "says nine letters and has one";
    EXPECT_EQ(names.sender(3), longest);
}

}  // namespace burin::devices
