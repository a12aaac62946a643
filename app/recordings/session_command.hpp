// SPDX-License-Identifier: MIT
// burin session: session files, which --record writes (docs/formats.md, "Session files").
//   burin session info FILE [--json OUT]       hands, columns, ticks, gaps, clocks, versions
//   burin session check FILE                   reads all of it and names what is damaged; exit status 1 then
//   burin session compare A B [--columns ...]  the first difference by tick, column and both values; exit status 1 then
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow session_row();

}  // namespace burin::app
