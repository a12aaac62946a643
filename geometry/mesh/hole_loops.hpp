// SPDX-License-Identifier: MIT
// The holes of a mesh as loops of vertices. Internal to geometry/.
//
// The edges with an odd number of uses meet every vertex an even number of times (each triangle enters a vertex as
// often as it leaves it), so they always decompose into closed loops, in a mesh of any topology and orientation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

// A simple loop of at least 3 vertices, none of which occurs twice. It runs so that triangles (loop[i], loop[i+1],
// other) are oriented like most of their neighbours across the loop.
struct HoleLoop {
    std::vector<std::uint32_t> vertices;
};

// Returns all holes, in a deterministic order.
[[nodiscard]] std::vector<HoleLoop> hole_loops(std::span<const EdgeUse> uses);

}  // namespace burin::geometry
