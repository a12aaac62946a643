// SPDX-License-Identifier: MIT
// Checks that a carved solid's rays hold what they must: intervals
// compared with the closed forms on a random sample of rays.
#pragma once

#include <cstdint>

#include "bench/measure/scenes.hpp"
#include "compute/rays/solid.hpp"

namespace burin::bench {

struct IntervalCheck {
    std::uint64_t rays = 0;
    std::uint64_t lost = 0;   // pieces of material that the exact answer has and the solid lacks
    std::uint64_t extra = 0;  // pieces that the solid has and the exact answer lacks
};

// Compares `solid` with the scene's workpiece after its sweeps: with the cube's closed form, or with the rays of
// `uncut`, the solid before the first cut, which a mesh needs. A piece counts when it is longer than two depth units:
// one for each rounded end. A tool's coordinates are rounded to whole units too, which moves its surface by up to
// sqrt(3) / 2 units, and where a ray grazes the tool that is many units of depth; so a piece counts as lost only if it
// is missing even against tools one unit larger, and as extra only if it remains even against tools one unit smaller.
// The corners of a turned cube are rounded alike, and its size is varied by one unit as well.
[[nodiscard]] IntervalCheck check_intervals(const compute::Solid& solid, const CarveScene& scene,
                                            std::uint64_t rays_an_axis, std::uint64_t seed = 1,
                                            const compute::Solid* uncut = nullptr);

}  // namespace burin::bench
