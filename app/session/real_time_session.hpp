// SPDX-License-Identifier: MIT
// A session in real time: haptics and carving have threads of their own, and a frame is drawn when something has changed, as late as the
// display allows. A user leads it, or a log in their place.
#pragma once

#include "app/sculpt.hpp"
#include "app/session/direct_output.hpp"
#include "app/session/input_source.hpp"
#include "app/session/session_screens.hpp"
#include "app/session/session_times.hpp"

namespace burin {

// keep_frames: each frame's times are in the record, and ticks are as punctual as a device's user needs them.
[[nodiscard]] Result<SessionRecord> run_in_real_time(const SculptOptions& options, const SessionWall& wall,
                                                     InputSource input, bool keep_frames,
                                                     DirectDriver driver = direct_driver());

}  // namespace burin
