// SPDX-License-Identifier: MIT
// burin sculpt: a workpiece, a tool and a stroke in; a carved mesh, pictures and a report out; or a live session. One
// thread. Every Error names a file or an option and the remedy.
#pragma once

#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

[[nodiscard]] CommandRow sculpt_row();

// Carves along a stroke. Writes nothing before all input has been read and all output places have been checked.
[[nodiscard]] Result<void> sculpt(const session::SessionSetup& options);
// Returns whether --record is of a stroke that a simulated hand feels, which sculpt() records, and not of a live
// session.
[[nodiscard]] bool records_a_felt_stroke(const session::SessionSetup& options);

}  // namespace burin::app
