// SPDX-License-Identifier: MIT
// Options of a session as the program opens one: with who makes its workpiece.
#pragma once

#include "sculpt/carved_workpiece.hpp"
#include "session/options/session_setup.hpp"

namespace burin::session {

[[nodiscard]] inline SessionSetup carving_setup() {
    SessionSetup setup;
    setup.carve.make_workpiece = sculpt::make_carved_workpiece;
    return setup;
}

}  // namespace burin::session
