// SPDX-License-Identifier: MIT
// burin demo: carves an ornament into a ball by a simulated hand, without a device or a display, from files that come
// with the program, in any working folder; burin demo world, study, hand likewise.
// burin demo wand --out DIR: the cube test of the wand thesis, with pictures, plots and a table; exit status 1 where a
// force or a torque has another sign than the thesis says (activities/wand/pressed_cube.hpp).
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow demo_row();

}  // namespace burin::app
