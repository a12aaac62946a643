// SPDX-License-Identifier: MIT
// The reports that a SpaceMouse sends, as its device writes them. Written from what others publish of the device and
// without any of the driver's code (devices/spacemouse/spacemouse_report.hpp), so that a fault in one of the two shows
// where they meet.
// Sources: FreeSpacenav spacenavd bac572a (dev.c: HID's axes) and JakubAndrysek/PySpaceMouse 95cf9cb (devices.toml:
// layouts, masks, 350). Only devices of two keys, whose mask has two bytes. Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/space.hpp"

namespace burin::devices {

using HidBytes = std::vector<std::byte>;

// Push and turn are shares of full deflection along and about the axes of the device frame; the report stays within
// full deflection.
[[nodiscard]] HidBytes cap_push_report(const Vec3& push);
[[nodiscard]] HidBytes cap_turn_report(const Vec3& turn);
[[nodiscard]] HidBytes cap_joined_report(const Vec3& push, const Vec3& turn);
// buttons: bit 0 is the first of sixteen.
[[nodiscard]] HidBytes cap_button_report(std::uint32_t buttons);

}  // namespace burin::devices
