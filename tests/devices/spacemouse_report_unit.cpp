// SPDX-License-Identifier: MIT
// Reports of a SpaceMouse: bytes as they were published by others, in both layouts, and what they mean in the device
// frame; which devices there are; rates and settings.
#include "devices/spacemouse/spacemouse_report.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <string>

#include "devices/emulators/spacemouse_wire.hpp"
#include "devices/spacemouse/spacemouse_rates.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

HidBytes hid(std::initializer_list<int> numbers) {
    HidBytes bytes;
    for (const int number : numbers) bytes.push_back(static_cast<std::byte>(number));
    return bytes;
}

std::optional<SpaceMouseReport> read_plain(const HidBytes& bytes) {
    return spacemouse_report(bytes, SpaceMouseKeys::plain);
}

std::string settings_error(const std::string& text) {
    const auto settings = spacemouse_settings("device", text);
    return settings ? "none" : settings.error().line();
}

}  // namespace

TEST(SpaceMouseReport, OlderDevicesSayPushAndTurnApart) {
    // 350 (0x015e) to the right; 175 (0x00af) towards the user; 70 (0x0046) down, as HID has its axes.
    const auto pushed = read_plain(hid({1, 0x5e, 0x01, 0xaf, 0x00, 0x46, 0x00}));
    ASSERT_TRUE(pushed && pushed->push);
    EXPECT_EQ(*pushed->push, Vec3(1.0, -0.2, 0.5)) << "device frame: down is -y, towards the user is +z";
    EXPECT_FALSE(pushed->turn || pushed->buttons);
    // -350 (0xfea2) about x: the cap tilts away from the user.
    const auto turned = read_plain(hid({2, 0xa2, 0xfe, 0, 0, 0, 0}));
    ASSERT_TRUE(turned && turned->turn);
    EXPECT_EQ(*turned->turn, Vec3(-1.0, 0.0, 0.0));
    EXPECT_FALSE(turned->push || turned->buttons);
}

// As spacenavd's table of devices has it: it swaps and turns y and z of all but these.
TEST(SpaceMouseReport, TheTwoEarlyDevicesWithYUpAreReadSo) {
    for (const std::uint16_t product : std::to_array<std::uint16_t>({0xc603, 0xc606})) {
        const auto early = spacemouse_product(0x046d, product);
        ASSERT_TRUE(early);
        // 350 to the right; 175 up; 70 away from the user.
        const HidBytes pushes = hid({1, 0x5e, 0x01, 0xaf, 0x00, 0x46, 0x00});
        const auto pushed = spacemouse_report(pushes, early->keys, early->axes);
        ASSERT_TRUE(pushed && pushed->push);
        EXPECT_EQ(*pushed->push, Vec3(1.0, 0.5, -0.2));
        const HidBytes turns = hid({2, 0x5e, 0x01, 0xaf, 0x00, 0x46, 0x00});
        const auto turned = spacemouse_report(turns, early->keys, early->axes);
        ASSERT_TRUE(turned && turned->turn);
        EXPECT_EQ(*turned->turn, Vec3(1.0, 0.5, -0.2)) << "about the same axes";
    }
    for (const std::uint16_t product : std::to_array<std::uint16_t>({0xc605, 0xc621, 0xc626, 0xc62b}))
        EXPECT_EQ(spacemouse_product(0x046d, product)->axes, SpaceMouseAxes::z_down) << product;
}

TEST(SpaceMouseReport, NewerDevicesSayBothTogether) {
    const auto both = read_plain(hid({1, 0x5e, 0x01, 0, 0, 0, 0, 0, 0, 0xaf, 0x00, 0xa2, 0xfe}));
    ASSERT_TRUE(both && both->push && both->turn);
    EXPECT_EQ(*both->push, Vec3(1.0, 0.0, 0.0));
    EXPECT_EQ(*both->turn, Vec3(0.0, 1.0, 0.5)) << "about down is about -y; about the way to the user is about z";
}

TEST(SpaceMouseReport, TurnsByTheRightHandRuleInTheDeviceFrame) {
    // The axes of a turn change as those of a push do: else a turn would be mirrored.
    for (int axis = 0; axis < 3; ++axis) {
        HidBytes push(7, std::byte{0}), turn(7, std::byte{0});
        push[0] = std::byte{1};
        turn[0] = std::byte{2};
        push[static_cast<std::size_t>(1 + 2 * axis)] = turn[static_cast<std::size_t>(1 + 2 * axis)] = std::byte{100};
        EXPECT_EQ(*read_plain(push)->push, *read_plain(turn)->turn) << axis;
    }
    // And the frame is no mirror image of HID's: x cross y is z in both.
    const Vec3 x = *read_plain(hid({1, 100, 0, 0, 0, 0, 0}))->push, y = *read_plain(hid({1, 0, 0, 100, 0, 0, 0}))->push,
               z = *read_plain(hid({1, 0, 0, 0, 0, 100, 0}))->push;
    EXPECT_GT(glm::dot(glm::cross(x, y), z), 0.0);
}

TEST(SpaceMouseReport, FindsTheButtonsInTheMaskOfEachKindOfDevice) {
    EXPECT_EQ(read_plain(hid({3, 0b10}))->buttons, 2u);
    EXPECT_EQ(read_plain(hid({3, 0b01, 0}))->buttons, 1u);
    // A Pro's keys 1 to 4 are the bits 12 to 15, Menu is bit 0 (spacenavd: buttons 0 to 3 and 4).
    const auto pro = [](const HidBytes& bytes) { return spacemouse_report(bytes, SpaceMouseKeys::pro)->buttons; };
    EXPECT_EQ(pro(hid({3, 0, 0x10, 0, 0})), 1u);
    EXPECT_EQ(pro(hid({3, 0, 0x80, 0, 0})), 8u);
    EXPECT_EQ(pro(hid({3, 1, 0, 0, 0})), 16u);
    EXPECT_EQ(pro(hid({3, 0, 0, 0x40, 0})), 1u << 11) << "Esc";
    // Behind a receiver is the one or the other.
    const auto either = [](const HidBytes& bytes) {
        return spacemouse_report(bytes, SpaceMouseKeys::receiver)->buttons;
    };
    EXPECT_EQ(either(hid({3, 2, 0, 0, 0})), 2u);
    EXPECT_EQ(either(hid({3, 0, 0x20, 0, 0})), 2u);
    // A mask as long as an Enterprise's, whose last bits are beyond those that are used.
    HidBytes enterprise(24, std::byte{0xff});
    enterprise[0] = std::byte{3};
    EXPECT_EQ(pro(enterprise), (1u << 15) - 1);
}

TEST(SpaceMouseReport, RefusesWrongLengthsAndLeavesOtherReportsOut) {
    for (std::size_t size = 0; size <= kMostHidReport + 1; ++size) {
        HidBytes bytes(size, std::byte{1});
        EXPECT_EQ(read_plain(bytes).has_value(), size == 7 || size == 13) << size;
        if (size == 0) continue;
        bytes[0] = std::byte{2};
        EXPECT_EQ(read_plain(bytes).has_value(), size == 7) << size;
        bytes[0] = std::byte{3};
        EXPECT_EQ(read_plain(bytes).has_value(), size >= 2 && size <= kMostHidReport) << size;
        bytes[0] = std::byte{0x17};  // the battery
        EXPECT_EQ(read_plain(bytes), SpaceMouseReport{}) << size;
    }
}

TEST(SpaceMouseReport, CountsMoreThanFullAsFull) {
    const auto far = read_plain(hid({1, 0xff, 0x7f, 0x00, 0x80, 0, 0}));
    EXPECT_EQ(*far->push, Vec3(1.0, 0.0, -1.0));
}

TEST(SpaceMouseReport, IsReadAsItWasWritten) {
    for (double share = -1.0; share <= 1.0; share += 0.1) {
        const Vec3 push(share, -share, 0.5 * share), turn(0.3 * share, share, -share);
        const auto joined = read_plain(cap_joined_report(push, turn));
        ASSERT_TRUE(joined && joined->push && joined->turn);
        EXPECT_LE(glm::distance(*joined->push, push), 1.0 / kSpaceMouseFull);
        EXPECT_LE(glm::distance(*joined->turn, turn), 1.0 / kSpaceMouseFull);
        EXPECT_EQ(read_plain(cap_push_report(push))->push, joined->push);
        EXPECT_EQ(read_plain(cap_turn_report(turn))->turn, joined->turn);
    }
    for (std::uint32_t buttons = 0; buttons < 16; ++buttons)
        EXPECT_EQ(read_plain(cap_button_report(buttons))->buttons, buttons);
}

TEST(SpaceMouseProduct, IsFoundByItsNumbers) {
    EXPECT_EQ(spacemouse_product(0x046d, 0xc626)->name, "SpaceNavigator");
    EXPECT_FALSE(spacemouse_product(0x046d, 0xc626)->joined);
    EXPECT_TRUE(spacemouse_product(0x256f, 0xc62e)->joined);
    EXPECT_EQ(spacemouse_product(0x256f, 0xc633)->keys, SpaceMouseKeys::pro);
    EXPECT_TRUE(spacemouse_product(0x256f, 0xcfff)) << "one that came later";
    EXPECT_FALSE(spacemouse_product(0x256f, 0xc641)) << "which spacenavd lists as none";
    EXPECT_FALSE(spacemouse_product(0x046d, 0xc077)) << "a plain mouse of Logitech's";
}

TEST(SpaceMouseRate, IsZeroInTheDeadZoneFullAtTheEndAndKeepsTheDirection) {
    EXPECT_EQ(spacemouse_rate(Vec3(0.06, 0.06, 0.05), 0.1, 2.0), Vec3(0.0));
    EXPECT_EQ(spacemouse_rate(Vec3(0.0), 0.0, 2.0), Vec3(0.0));
    EXPECT_NEAR(glm::length(spacemouse_rate(Vec3(0.0, -1.0, 0.0), 0.1, 2.0)), 2.0, 1e-12);
    EXPECT_NEAR(glm::length(spacemouse_rate(Vec3(1.0, -1.0, 1.0), 0.1, 2.0)), 2.0, 1e-12) << "a corner is not faster";
    EXPECT_NEAR(spacemouse_rate(Vec3(0.55, 0.0, 0.0), 0.1, 2.0).x, 0.5, 1e-12) << "half of the way: a quarter";
    const Vec3 way(0.3, -0.2, 0.4);
    EXPECT_LT(glm::length(glm::cross(spacemouse_rate(way, 0.1, 2.0), way)), 1e-12);
}

TEST(SpaceMouseRate, TurnsAboutTheAxisOfTheAngularVelocity) {
    Quat turn(1.0, 0.0, 0.0, 0.0);
    for (int i = 0; i < 1000; ++i) turn = turned(turn, Vec3(0.0, 0.5 * std::numbers::pi, 0.0), 0.001);
    EXPECT_LT(glm::distance(turn * Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, -1.0)), 1e-9) << "a quarter turn about +y";
    EXPECT_EQ(turned(turn, Vec3(0.0), 1.0), turn);
}

// The axis is the device frame's, however the hand is turned already.
TEST(SpaceMouseRate, TurnsAboutTheFramesAxisWhateverIsTurned) {
    for (std::size_t i = 0; i < kUnevenPoses; ++i) {
        const Quat begin = uneven_turn(i);
        const Vec3 axis = uneven_direction(i + 2);
        const Quat by = turned(begin, 3.0 * axis, 0.2) * glm::conjugate(begin);
        EXPECT_LT(glm::distance(by * axis, axis), 1e-12) << i;
        EXPECT_GT(std::abs(glm::dot(by, glm::angleAxis(0.6, axis))), 1.0 - 1e-12) << i;
    }
}

TEST(SpaceMouseSettings, AreReadAndBoundedAndNamedWhenWrong) {
    const auto all = spacemouse_settings("device", "hidraw3,speed=0.2,turn=2,dead=0.05,wand.toml");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->place, "hidraw3");
    EXPECT_EQ(all->file, "wand.toml");
    EXPECT_EQ(all->speed_m_per_s, 0.2);
    EXPECT_EQ(all->turning_rad_per_s, 2.0);
    EXPECT_EQ(all->dead_zone, 0.05);
    EXPECT_EQ(spacemouse_settings("device", "speed=0.2")->place, "");
    EXPECT_TRUE(settings_error("sped=0.2").contains("the nearest is speed="));
    EXPECT_TRUE(settings_error("speed=nan").contains("write one from 0.001 to 10"));
    EXPECT_TRUE(settings_error("speed=0").contains("write one from"));
    EXPECT_TRUE(settings_error("dead=1").contains("write one from 0 to 0.9"));
    EXPECT_TRUE(settings_error("turn=2x").contains("is no number"));
    EXPECT_TRUE(settings_error("hidraw1,hidraw2").contains("names two"));
    EXPECT_TRUE(settings_error("hidraw1,,dead=0").contains("nothing on one side of a comma"));
}

}  // namespace burin::devices
