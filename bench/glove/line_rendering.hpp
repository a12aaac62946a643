// SPDX-License-Identifier: MIT
// Where a glove's force is made: at its controller (local), from a spring and damper that the host has sent once, or at
// the host (distributed), from positions that come over the serial line and forces that go back over it (requirement
// G2). Simulated: a finger that presses a ball, the line byte by byte, the piston's own low-pass.
//
// The finger: 0.1 kg, 3 N s/m and 100 N/m towards where it wants to be; assumed, as in `burin bench stability`. The
// piston follows commands as a low-pass of first order. The controller samples at 500 Hz. Distributed: a set of 32
// bytes begins when the last one is out, holds the position at its beginning, and is known when its last byte has come
// (10 bits a byte); the host answers at its next tick of 1 ms with a command of 8 bytes, whose force acts when it has
// come.
// Units SI. Pure and deterministic.
#pragma once

#include <cstdint>
#include <vector>

namespace burin::bench {

enum class MadeAt { controller, host };

struct LineTask {
    MadeAt at = MadeAt::controller;
    double bits_per_s = 38'400;
    double stiffness_N_per_m = 300.0, damping_Ns_per_m = 0.0;
    double piston_Hz = 30.0;
    double most_force_N = 10.0;
};

struct LineFigures {
    MadeAt at = MadeAt::controller;
    double bits_per_s = 0.0;
    double sets_per_s = 0.0;
    double stiffest_N_per_m = 0.0;  // at which a tap still comes to rest; 0: none
    double lag_s = 0.0;             // of the force behind the ball's, pressed at 20 mm/s; with the piston's own
    double force_error = 0.0;       // rms over the greatest, squeezed by 10 mm once a second at 200 N/m
};

// Whether a finger that taps the ball at 0.1 m/s and goes on pressing comes to rest: moves by less than 0.1 mm in the
// last half of 3 s.
[[nodiscard]] bool comes_to_rest(const LineTask& task);
[[nodiscard]] LineFigures measure_line(MadeAt at, double bits_per_s, double piston_Hz = 30.0);
// The controller, then the host at each rate.
[[nodiscard]] std::vector<LineFigures> compare_lines(const std::vector<double>& bits_per_s);

}  // namespace burin::bench
