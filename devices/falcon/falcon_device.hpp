// SPDX-License-Identifier: MIT
// A Novint Falcon on USB, without its maker's software: falcon, falcon:FIRMWARE, falcon:PLACE for that at one place of
// USB as `burin devices` lists it, or falcon:PLACE@FIRMWARE. Names that begin with "emulated" are those of
// `burin devices emulate falcon`.
//
// The description: a box of four inches (h3dapi's figures), 8 N and 3,000 N/m as CHAI3D lists it. Mass, damping and
// friction are not published: low ones are assumed, by which little is promised. Its resolution follows from the
// encoders. It has three forces and no turn.
// Faults: gone or silent, not homed, angles that its legs cannot have. Threads: as haptic_device.hpp.
#pragma once

#include <string>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/device_presence.hpp"

namespace burin::devices {

inline constexpr const char* kFalcon = "falcon";

// What a Falcon is, for its description and for emulated ones.
[[nodiscard]] OmniModel falcon_model();

// The clock must be the machine's and outlive the device. `hand` is not followed: a person's is there.
[[nodiscard]] Result<OpenedDevice> open_falcon(const std::string& place_at_firmware, AnyHand hand, Clock& clock);
// One that is nowhere and rests, for a recording that is done again.
[[nodiscard]] OpenedDevice falcon_that_rests(Clock& clock);
// Looks for Falcons on USB and for emulated ones, and opens none.
[[nodiscard]] std::vector<DevicePresence> look_for_falcons();

}  // namespace burin::devices
