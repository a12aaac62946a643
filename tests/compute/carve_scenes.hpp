// SPDX-License-Identifier: MIT
// The cuts with known answers that tests and benchmarks share: a unit cube cut by one ball, by a capsule, and by the
// thousand balls of STROKE-1000; and the measures of what is left against the closed form. Lengths in metres.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compute/engine.hpp"
#include "compute/surface.hpp"

namespace burin::test {

struct CarveScene {
    std::string name;
    std::vector<BallSweep> sweeps;
    double removed_m3 = 0.0;  // exactly, out of the unit cube
};

// A ball whose centre lies 0.05 below the top face: the removed part is the ball without its cap.
[[nodiscard]] CarveScene ball_scene();
// A capsule with its axis in the top face, at an angle to the lattice: half of it is removed.
[[nodiscard]] CarveScene capsule_scene();
// A capsule inside the cube, askew on all axes: a closed cavity.
[[nodiscard]] CarveScene cavity_scene();
// p(t) = (0.5 + 0.42 sin 6 pi t, 0.5 + 0.42 sin (4 pi t + 0.6), 0.985 + 0.03 sin 10 pi t), t = i / 999, radius 0.06, as 1000
// stamps. The removed volume is from analytic rays, up to 8192^2 of them: 0.03323742(1).
[[nodiscard]] CarveScene stroke_1000_scene();

struct CarveErrors {
    double volume = 0.0;         // (mesh - exact) over the removed volume
    double surface_rms_m = 0.0;  // |f| over vertices and triangle centres in the cut region, f = max(cube, -sweeps)
    double surface_max_m = 0.0;
    double edge_max_m = 0.0;      // of the cube's edges where nothing was cut: distance of their vertices from them
    double corner_max_m = 0.0;    // of the cube's corners where nothing was cut
    double normal_max_rad = 0.0;  // of vertices on the tool's smooth surface
};

// `surface` must be up to date.
[[nodiscard]] CarveErrors measure(const Surface& surface, const CarveScene& scene);

}  // namespace burin::test
