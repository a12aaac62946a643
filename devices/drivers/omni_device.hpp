// SPDX-License-Identifier: MIT
// A PHANTOM Omni or Touch by the maker's library (hd_servo.hpp): omni, omni:NAME as the maker's setup calls it, or
// NAME@LIBRARY for a library that the system's loader does not find. Names that begin with "emulated" are those of
// `burin devices emulate omni`, whose library stands beside the program.
//
// Frames: HDAPI's axes are the device frame's; its origin is not, and is moved to the middle of the workspace that the
// library calls usable. The description is of the model that the library says the device is (arm_models.hpp), or that
// omni:NAME,model=KEY names, which a recording keeps, so that it is done again without the device: an Omni as the
// PowerWall paper and the data sheet give it, or another arm. A device that gives less force is not asked for more.
// Faults: a device that is gone or silent for kServedLost_ns, that is not calibrated, whose pose is no pose, that
// is warm or was too fast. Threads: as haptic_device.hpp.
#pragma once

#include <string>
#include <vector>

#include "base/clock.hpp"
#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/presence/usb_presence.hpp"

namespace burin::devices {

inline constexpr const char* kOmni = "omni";
inline constexpr const char* kEmulatedHdLibrary = "libburin_emulated_hd.so";

// Refuses a text that names no model or no library where it should.
[[nodiscard]] Result<void> check_omni(const std::string& name_at_library);
// The clock must be the machine's and outlive the device. `hand` is not followed: a person's is there.
[[nodiscard]] Result<OpenedDevice> open_omni(const std::string& name_at_library, AnyHand hand, Clock& clock);
// One that is nowhere and rests, of the model that the text names, for a recording that is done again.
[[nodiscard]] OpenedDevice omni_that_rests(const std::string& name_at_library, Clock& clock);
// Looks for the maker's library, for devices of the maker's that this user may not open, and for emulated ones. Opens
// none: that would take it from who uses it.
[[nodiscard]] std::vector<DevicePresence> look_for_omnis();
[[nodiscard]] std::vector<DevicePresence> look_for_omnis(const KernelPlaces& places);

}  // namespace burin::devices
