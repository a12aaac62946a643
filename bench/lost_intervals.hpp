// SPDX-License-Identifier: MIT
// Whether a carved solid's rays hold what they must: intervals compared with the closed forms on a random sample of rays.
#pragma once

#include <cstdint>

#include "bench/scenes.hpp"
#include "compute/solid.hpp"

namespace burin::bench {

struct IntervalCheck {
    std::uint64_t rays = 0;
    std::uint64_t lost = 0;   // pieces of material that the exact answer has and the solid lacks
    std::uint64_t extra = 0;  // and the other way round
};

// `solid` is the unit cube after the scene's sweeps. A piece counts when it is longer than two depth units: one for each
// rounded end. A coordinate of a tool is rounded to whole units too, which moves its surface by up to sqrt(3) / 2 units, and
// where a ray grazes the tool that is many units of depth; so a piece is only called lost when it is missing although the
// tools were one unit larger, and extra when it is there although they were one unit smaller.
[[nodiscard]] IntervalCheck check_intervals(const Solid& solid, const CarveScene& scene, std::uint64_t rays_an_axis,
                                            std::uint64_t seed = 1);

}  // namespace burin::bench
