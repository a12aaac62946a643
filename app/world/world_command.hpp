// SPDX-License-Identifier: MIT
// burin world: worlds of objects that are touched (docs/formats.md).
//   burin world FILE                           opens a world in a live session, with --workpiece beside a workpiece
//   burin world FILE --stroke STROKE           explores a world by a simulated hand (app/world/world_explore.hpp)
//   burin world FILE --stroke STROKE --device simulated-wand    the same with a wand (app/world/world_wand.hpp)
//   burin world check FILE... [--json OUT]     what is in each file, or all that is wrong with it; exit status 1 then
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow world_row();

}  // namespace burin::app
