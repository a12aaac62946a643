// SPDX-License-Identifier: MIT
// What a wand that is there can do, as the tick sees it: with its joints, and with steps of place and turn that follow
// from the encoders' (the greatest over the workspace). Any thread.
#pragma once

#include "devices/haptic/wand_description.hpp"

namespace burin::devices {

// `name` is the description's text, which must outlive the result.
[[nodiscard]] DeviceDescription device_of_hardware(const WandDescription& wand);

}  // namespace burin::devices
