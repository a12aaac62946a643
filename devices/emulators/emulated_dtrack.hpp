// SPDX-License-Identifier: MIT
// Sends what ART's DTrack would of a viewer who sways before a wall and swings a flystick (emulated_motion.hpp): body 0
// the head, flystick 0 the wand with a button and a stick, 60 measurements a second. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {

// Returns the datagram of a measurement. Pure.
[[nodiscard]] std::string emulated_dtrack_datagram(std::uint32_t number, const EmulatedMotion& now);

// Sends to that address until `ends` says so, which is asked 60 times a second. Whether somebody listens it does not
// know, as DTrack itself does not. begins_s: of the emulated motion.
[[nodiscard]] Result<void> run_emulated_dtrack(const NetworkAddress& to, const SilenceDrill& silence,
                                               const std::function<bool()>& ends, double begins_s = 0.0);

}  // namespace burin::devices
