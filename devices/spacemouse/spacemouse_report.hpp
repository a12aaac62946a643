// SPDX-License-Identifier: MIT
// The HID reports of a 3Dconnexion SpaceMouse and its kin: bytes to how its cap is pushed and turned. Pure.
//
//   01  x y z              translation, 7 bytes: devices until about 2012, which report the turn apart
//   01  x y z rx ry rz     both, 13 bytes: the wireless ones, Pro Wireless, Enterprise, the Universal Receiver
//   02  rx ry rz           turn, 7 bytes
//   03  mask...            buttons, a bit each from the lowest of the first byte on; as many bytes as the device needs
//   others                 battery (0x17), keys and displays: nothing that moves a hand
// Numbers are 16 bits, little-endian, signed; full deflection is 350 or a little more. Axes are HID's: x to the right,
// y towards the user, z down; turns by the right-hand rule about them. Two early ones have y up and z away from the
// user.
// Sources: Linux input events of FreeSpacenav spacenavd bac572a (dev_usb_linux.c, dev.c: products, axes, button orders)
// and raw reports of JakubAndrysek/PySpaceMouse 95cf9cb (devices.toml: layouts of each product, masks, 350).
// The device's end is in devices/emulators/spacemouse_wire.hpp and has no code in common with this.
// Frame: device (base/space.hpp): x to the right, y up, z towards the user.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/space.hpp"

namespace burin::devices {

inline constexpr double kSpaceMouseFull = 350.0;
inline constexpr std::size_t kMostHidReport = 64;  // bytes that are read of one; longer ones are none of these

// In which order a device's mask has its keys: which of them is the first button, which the second.
enum class SpaceMouseKeys : std::uint8_t {
    plain,     // two keys, left and right; or all keys in a row
    pro,       // keys 1 to 4, then Menu, Fit and the others
    receiver,  // of either, as it does not say which device is behind it
};

// Which way the axes of a device's reports point, x to the right aside.
enum class SpaceMouseAxes : std::uint8_t { z_down, y_up };

struct SpaceMouseProduct {
    std::uint16_t vendor = 0, product = 0;
    std::string_view name;
    SpaceMouseKeys keys = SpaceMouseKeys::plain;
    bool joined = false;  // its report 1 has the turn as well
    SpaceMouseAxes axes = SpaceMouseAxes::z_down;
};
[[nodiscard]] std::span<const SpaceMouseProduct> spacemouse_products();
// Returns the product of these numbers. One that is not in the table is known by 3Dconnexion's own vendor number, but
// for those that are no devices which are pushed and turned (spacenavd has a list).
[[nodiscard]] std::optional<SpaceMouseProduct> spacemouse_product(std::uint16_t vendor, std::uint16_t product);

// What one report says: what it is silent about is empty.
struct SpaceMouseReport {
    std::optional<Vec3> push, turn;        // -1 to 1 along and about each axis, device frame
    std::optional<std::uint32_t> buttons;  // bit 0: the first button
    friend bool operator==(const SpaceMouseReport&, const SpaceMouseReport&) = default;
};
// Returns what the bytes say, report number first; nothing in it: a report of another kind. Nothing at all: the length
// is not that of the report. Numbers beyond full deflection count as full.
[[nodiscard]] std::optional<SpaceMouseReport> spacemouse_report(std::span<const std::byte> bytes, SpaceMouseKeys keys,
                                                                SpaceMouseAxes axes = SpaceMouseAxes::z_down);

// Whether a HID descriptor begins with a multi-axis controller (usage page 1, usage 8): of the interfaces of a
// receiver or a keyboard-like device that is the one that is pushed and turned.
[[nodiscard]] bool is_multi_axis(std::span<const std::byte> descriptor);

}  // namespace burin::devices
