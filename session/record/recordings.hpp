// SPDX-License-Identifier: MIT
// Reads recorded sessions on behalf of devices that play them (devices/haptic/recorded_device.hpp). Any thread.
#pragma once

#include "devices/haptic/recorded_device.hpp"

namespace burin::session {

// Reads session files. Errors: a file that is none, that has no session's hands, or not the hand that is asked for; a
// damaged block; more than Recordings::kMostTicks ticks.
[[nodiscard]] const devices::Recordings& session_recordings();

}  // namespace burin::session
