// SPDX-License-Identifier: MIT
// The holes of a mesh as loops of vertices. Internal to geometry/.
//
// The edges with an odd number of uses meet every vertex an even number of times (each triangle enters a vertex as often as
// it leaves it), so they always fall apart into closed loops, in a mesh of any topology and orientation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/edge_table.hpp"

namespace burin {

// A simple loop: no vertex occurs twice, at least 3 of them. Runs so that triangles (loop[i], loop[i+1], other) are oriented
// like their neighbours across the loop, where most of these agree.
struct HoleLoop {
    std::vector<std::uint32_t> vertices;
};

// In a deterministic order.
[[nodiscard]] std::vector<HoleLoop> hole_loops(std::span<const EdgeUse> uses);

}  // namespace burin
