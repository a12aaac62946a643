// SPDX-License-Identifier: MIT
// burin glove emulate: a force-feedback glove that is not there, on a pseudo-terminal.
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow glove_row();

}  // namespace burin::app
