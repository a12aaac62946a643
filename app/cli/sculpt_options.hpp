// SPDX-License-Identifier: MIT
// Options of burin sculpt, which burin demo takes too. The options must outlive the parse. One thread.
#pragma once

#include "app/cli/command_line.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

inline constexpr const char* kUnitsHelp =
    "Unit of the numbers in a mesh file that is read; else as the file states, else mm where its longest side is above "
    "5, and m where not";

inline constexpr const char* kWeldHelp =
    "Join corners at open edges that lie up to this far apart, in metres; else as far as the file's numbers are "
    "precise";

// Adds WORKPIECE, which is also --workpiece, and all that add_carving_options() adds.
void add_sculpt_options(Command command, session::SessionSetup& options);
// Adds what says how a workpiece is carved and what is made of it.
void add_carving_options(Command command, session::SessionSetup& options);

}  // namespace burin::app
