// SPDX-License-Identifier: MIT
// The table of burin's commands, in the order of its help. Each room of app/ brings its rows. Any thread.
#pragma once

#include <vector>

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] std::vector<CommandRow> burin_commands();

}  // namespace burin::app
