// SPDX-License-Identifier: MIT
// A Force Dimension device (omega, delta, sigma, lambda, or a Falcon) by the maker's library: dhd, dhd:INDEX (0 to 9,
// as the library lists them), dhd:SERIAL, and any of these with @LIBRARY. Names that begin with "emulated" are those of
// `burin devices emulate dhd`, whose library stands beside the program.
//
// The description is of the model that the library says the device is (arm_models.hpp), or that dhd:INDEX,model=KEY
// names, which a recording keeps, so that it is done again without the device. A device that gives less than what was
// named is not asked for more. Torques and grippers get no force. Threads: as haptic_device.hpp.
#pragma once

#include <string>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/presence/usb_presence.hpp"

namespace burin::devices {

inline constexpr const char* kDhd = "dhd";
inline constexpr const char* kEmulatedDhdLibrary = "libburin_emulated_dhd.so";

// Returns the figures of an omega.3, which the description and emulated devices have.
[[nodiscard]] OmniModel omega_model();

// Refuses a text that names no device, no model or no library where it should.
[[nodiscard]] Result<void> check_dhd(const std::string& choice_at_library);
// The clock must be the machine's and outlive the device. `hand` is not followed: a person's is there.
[[nodiscard]] Result<OpenedDevice> open_dhd(const std::string& choice_at_library, AnyHand hand, Clock& clock);
// One that is nowhere and rests, of the model that the text names, for a recording that is done again.
[[nodiscard]] OpenedDevice dhd_that_rests(const std::string& choice_at_library, Clock& clock);
// Looks for the maker's library and the devices that it counts, for those that this user may not open, and for emulated
// ones. Opens none.
[[nodiscard]] std::vector<DevicePresence> look_for_dhds();
[[nodiscard]] std::vector<DevicePresence> look_for_dhds(const KernelPlaces& places);

}  // namespace burin::devices
