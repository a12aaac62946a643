// SPDX-License-Identifier: MIT
// The cuts with known answers that tests and benchmarks share: what is taken out of the unit cube [0,1]^3 by one ball, by a
// capsule, and by the thousand balls of STROKE-1000. Lengths in metres, object frame.
#pragma once

#include <string>
#include <vector>

#include "base/space.hpp"
#include "compute/engine.hpp"

namespace burin::bench {

struct CarveScene {
    std::string name;
    std::vector<BallSweep> sweeps;
    double removed_m3 = 0.0;  // exactly, out of the unit cube

    // Every sweep stays where it starts.
    [[nodiscard]] bool only_stamps() const;
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
// The same places, joined by 999 capsules. The removed volume is from 1024^2 to 4096^2 rays (removed_volume_m3 in
// bench/exact_rays.hpp), which give 0.03326591, 0.03326630, 0.03326626: 0.03326625(2).
[[nodiscard]] CarveScene stroke_1000_swept_scene();
// The first `sweeps` of a scene; the removed volume is from rays_a_side^2 analytic rays.
[[nodiscard]] CarveScene beginning_of(const CarveScene& scene, std::size_t sweeps, int rays_a_side);

}  // namespace burin::bench
