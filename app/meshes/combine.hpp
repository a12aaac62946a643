// SPDX-License-Identifier: MIT
// burin combine A B: makes two closed meshes into one, as solids on a lattice that holds both. Writes nothing before
// all input has been read and the result is known not to be empty.
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow combine_row();

}  // namespace burin::app
