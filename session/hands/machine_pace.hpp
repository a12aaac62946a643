// SPDX-License-Identifier: MIT
// How much slower this machine computes contact than the reference core: WorkSettings::pace of a session in real time
// (haptics/contact/contact_work.hpp).
//
// Balls with radii from half an edge to four edges are dragged over a bumpy plate, and the processor time of that is
// compared with what its counted work costs on the reference core. The build counts as part of the machine: one for
// debugging is several times slower.
// Simulated time and scripts do without, so that their results depend on no machine. A recording keeps the pace that
// its ticks had (session/record/thread_log.hpp).
#pragma once

#include "base/clock.hpp"
#include "haptics/contact/contact_work.hpp"

namespace burin::session {

// A pace beyond these is taken to be mismeasured, or is more than a smaller budget can help with.
inline constexpr double kLeastPace = 0.25, kMostPace = 8.0;

// Measures it, on the calling thread. Takes 20 ms on the reference core. Unitless.
[[nodiscard]] double measured_pace();

// Returns the pace of a machine that took so long for this work.
[[nodiscard]] double pace_of(Nanoseconds took_ns, double reference_ns);

}  // namespace burin::session
