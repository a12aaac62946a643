// SPDX-License-Identifier: MIT
// A session in real time: haptics and carving have threads of their own, and a frame is drawn when something has changed, as late as the
// display allows. A user leads it, or a log in their place.
#pragma once

#include "app/sculpt.hpp"
#include "app/session/direct_output.hpp"
#include "app/session/input_source.hpp"
#include "app/session/session_screens.hpp"
#include "app/session/session_times.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin {

// A session to be worked in: the hand is simulated, so that nobody feels when a tick comes.
struct RealTimeRun {
    bool keep_frames = false;  // in the record, each with its times
    LoopPace pace = {.rests = true};
    DirectDriver driver = direct_driver();
};
[[nodiscard]] Result<SessionRecord> run_in_real_time(const SculptOptions& options, const SessionWall& wall,
                                                     InputSource input, RealTimeRun run = {});

}  // namespace burin
