// SPDX-License-Identifier: MIT
// A session that a script leads, in simulated time: ticks, carving and frames follow one another on one thread, so that the same script
// gives the same frames, in a window or without any.
#pragma once

#include "app/sculpt.hpp"
#include "app/session/input_source.hpp"
#include "app/session/session_screens.hpp"

namespace burin {

[[nodiscard]] Result<void> run_in_simulated_time(const SculptOptions& options, const SessionWall& wall,
                                                 InputSource input);

}  // namespace burin
