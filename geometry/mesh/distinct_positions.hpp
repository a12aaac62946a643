// SPDX-License-Identifier: MIT
// Keeps positions apart that become equal in single precision. A format without shared vertices, as STL, would make
// one vertex of two: edges with four triangles, and parts that grow together.
// Any unit and frame. Deterministic; any thread. Cost: n log n, however many fall together.
#pragma once

#include <cstddef>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

// Moves positions that are equal to others by single steps of a float along x until all differ; of equal ones the
// first stays. Requires finite coordinates. Returns how many steps were taken.
std::size_t make_distinct(std::vector<Vec3f>& positions);

}  // namespace burin::geometry
