// SPDX-License-Identifier: MIT
// Counts what a mesh file has by its own numbers, in its own unit, and compares that with what a report says.
#pragma once

#include <filesystem>

#include "base/json.hpp"

namespace burin::app {

// Returns triangles, vertices, open_edges, nonmanifold_edges, nonmanifold_vertices, misoriented_edges and crossing
// pairs, with positions that are equal as one vertex. Null where the file cannot be read.
[[nodiscard]] Json counts_of_file(const std::filesystem::path& path);

// Returns the same counts as the part "mesh" of a report of burin sculpt or combine says them.
[[nodiscard]] Json counts_of_report(const Json& report);

}  // namespace burin::app
