// SPDX-License-Identifier: MIT
// Lists the numbers of a session and its viewer that a frame's checksum covers (session_check.hpp). Pure; any thread.
#pragma once

#include "desk/viewer/viewer.hpp"
#include "session/record/session_check.hpp"

namespace burin::session {

[[nodiscard]] StateWords words_of(const SessionState& state, const Viewer& viewer);

}  // namespace burin::session
