// SPDX-License-Identifier: MIT
// burin seek WORLD: the objects of a world are touched as they are named, against the clock, in a live session
// (activities/seek/seek.hpp).
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow seek_row();

}  // namespace burin::app
