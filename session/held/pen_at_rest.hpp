// SPDX-License-Identifier: MIT
// How a tool is held. Frame: device.
#pragma once

#include "base/space.hpp"

namespace burin::session {

// Returns the orientation of a tool that is held as a pen is: its shaft, along its own +Y, leans to the right, up and
// towards the viewer.
[[nodiscard]] Quat pen_at_rest();

}  // namespace burin::session
