// SPDX-License-Identifier: MIT
// Local and distributed rendering on the code that a session runs: the emulated glove on its pseudo-terminal
// (devices/emulators/emulated_glove.hpp) and the link to it (devices/gloves/glove_link.hpp), in real time. Its index
// finger closes on a ball that is a spring of piston length; the host answers each millisecond, or leaves the ball's
// law to the controller. What is measured is what the controller's own joints and piston did.
// The finger is the emulated one: a grip of 1.5 Nm/rad without mass, a piston of 25 Hz; so figures say what the line
// and the loops do, and not how stiff a ball a person's hand would bear.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "bench/glove/line_rendering.hpp"

namespace burin::bench {

// The state of the controller's finger at one moment of a trial.
struct TrialMoment {
    double time_s = 0.0, piston_m = 0.0, given_N = 0.0;
};

struct TrialFigures {
    MadeAt at = MadeAt::controller;
    // At which the finger does not go to and fro: in the last 0.5 s of closing it is pushed back by less than 0.2 mm.
    double stiffest_N_per_m = 0.0;
    double lag_s = 0.0;        // of the piston's force behind the ball's, at kSoft_N_per_m
    double force_error = 0.0;  // rms over the greatest, likewise
};
inline constexpr double kSoft_N_per_m = 100.0;

// Has the finger close on a ball for 1.5 s. Takes as long.
[[nodiscard]] Result<std::vector<TrialMoment>> close_on_ball(MadeAt at, double stiffness_N_per_m);
// Tells whether the finger has stopped going to and fro when the trial ends.
[[nodiscard]] bool rests_at_end(const std::vector<TrialMoment>& moments);
// Takes about half a minute.
[[nodiscard]] Result<TrialFigures> try_line(MadeAt at);

}  // namespace burin::bench
