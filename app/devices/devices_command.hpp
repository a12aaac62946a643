// SPDX-License-Identifier: MIT
// burin devices: which devices and trackers there are, and why others are not; emulators of them; and a guided check of
// a force-feedback device.
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

// Its exit status is that of its check too: kCannotTell (bench/devices/device_check.hpp).
[[nodiscard]] CommandRow devices_row();

}  // namespace burin::app
