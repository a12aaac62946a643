// SPDX-License-Identifier: MIT
// A Haply Inverse3 by its maker's service on this machine: inverse3 for the first that the service sees, inverse3:ID
// for another, inverse3:HOST:PORT and inverse3:ID@HOST:PORT for a service elsewhere. Names that begin with "emulated"
// are those of `burin devices emulate inverse3`, whose service is found by that name.
//
// Unlike its language, its figures are not in its maker's public text: 5 N, 1,000 N/m and the box are assumed low, as
// are mass, damping and friction, and so is where the middle of the workspace is (inverse3_words.hpp). The handle's
// turn is the service's own; which way it heads when it is switched on is for the handle to know.
// Threads: as haptic_device.hpp.
#pragma once

#include <string>
#include <vector>

#include "devices/hand/any_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {

inline constexpr const char* kInverse3 = "inverse3";
[[nodiscard]] inline NetworkAddress inverse3_service() { return {"127.0.0.1", 10001}; }

// Returns the figures that the description and emulated devices have.
[[nodiscard]] OmniModel inverse3_model();

// Refuses a text that names neither a device nor a service.
[[nodiscard]] Result<void> check_inverse3(const std::string& choice);
// The clock must be the machine's and outlive the device. `hand` is not followed: a person's is there.
[[nodiscard]] Result<OpenedDevice> open_inverse3(const std::string& choice, AnyHand hand, Clock& clock);
// One that is nowhere and rests, for a recording that is done again.
[[nodiscard]] OpenedDevice inverse3_that_rests(Clock& clock);
// Asks the service what it sees, and looks for emulated ones. Gives no force.
[[nodiscard]] std::vector<DevicePresence> look_for_inverse3s();
[[nodiscard]] std::vector<DevicePresence> look_for_inverse3s(const NetworkAddress& service);

}  // namespace burin::devices
