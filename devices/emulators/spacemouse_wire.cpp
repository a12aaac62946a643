// SPDX-License-Identifier: MIT
#include "devices/emulators/spacemouse_wire.hpp"

#include <cmath>

namespace burin::devices {
namespace {

enum CapReport : unsigned { kCapPush = 1, kCapTurn = 2, kCapButtons = 3 };

// Adds a number of 16 bits, the lower byte first; a negative one as its complement of two.
void add_counts(HidBytes& report, double share) {
    constexpr long kFullCounts = 350;
    long counts = std::lround(share * kFullCounts);
    if (counts > kFullCounts) counts = kFullCounts;
    if (counts < -kFullCounts) counts = -kFullCounts;
    const long word = counts < 0 ? 0x10000 + counts : counts;
    report.push_back(static_cast<std::byte>(word % 0x100));
    report.push_back(static_cast<std::byte>(word / 0x100));
}

// HID's x is to the right, its y towards the user and its z down.
void add_axes(HidBytes& report, const Vec3& device) {
    const double right = device.x, towards_user = device.z, down = -device.y;
    add_counts(report, right);
    add_counts(report, towards_user);
    add_counts(report, down);
}

}  // namespace

HidBytes cap_push_report(const Vec3& push) {
    HidBytes report{std::byte{kCapPush}};
    add_axes(report, push);
    return report;
}

HidBytes cap_turn_report(const Vec3& turn) {
    HidBytes report{std::byte{kCapTurn}};
    add_axes(report, turn);
    return report;
}

// Newer devices say the turn in the report of the push.
HidBytes cap_joined_report(const Vec3& push, const Vec3& turn) {
    HidBytes report = cap_push_report(push);
    add_axes(report, turn);
    return report;
}

HidBytes cap_button_report(std::uint32_t buttons) {
    return {std::byte{kCapButtons}, static_cast<std::byte>(buttons % 0x100),
            static_cast<std::byte>(buttons / 0x100 % 0x100)};
}

}  // namespace burin::devices
