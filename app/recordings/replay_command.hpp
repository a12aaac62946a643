// SPDX-License-Identifier: MIT
// burin replay: does a recording again (docs/formats.md, "Replaying").
//   burin replay FILE                   computes every tick again from what is stored, and compares every column bit
//                                       for bit; exit status 1 and the first difference where one differs
//   burin replay FILE --through WORLD   feels the stored motion in a world: a derived table in FILE. Computed again, it
//                                       is compared with the one that is there
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow replay_row();

}  // namespace burin::app
