// SPDX-License-Identifier: MIT
// burin film: joins the pictures of a folder, in the order of the numbers in their names, into one that moves.
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow film_row();

}  // namespace burin::app
