// SPDX-License-Identifier: MIT
// burin convert --center, --place and --scale (geometry/mesh/mesh_placing.hpp): of a mesh, and of a document's solid.
#pragma once

#include "app/meshes/convert.hpp"
#include "base/error.hpp"
#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"
#include "geometry/mesh/mesh_placing.hpp"

namespace burin::app {

void add_placing_options(Command command, ConvertOptions& options);
// Returns what the options ask for. Fails where --center and --place both say where the mesh goes, and on numbers that
// are none.
[[nodiscard]] Result<geometry::Placing> placing_of(const ConvertOptions& options);

// Moves and scales the lattice of a solid, so that its surface stands where the placing says, and says where that is. A
// surface that is to be mirrored is placed so that it is right once mirror() has been at its numbers, which rounds
// nothing. Fails where numbers in the unit do not reach there.
[[nodiscard]] Result<void> place_solid(compute::Solid& solid, const geometry::Placing& placing, LengthUnit unit,
                                       WorkerPool& pool);
// Mirrors a mesh of any unit at the origin of its frame.
void mirror(geometry::TriangleMesh& mesh);

// Says where a mesh has been put: "placed: its box's middle at 0, 0, 0 m, 2 times as large".
[[nodiscard]] std::string placed_in_words(const Box& bounds_m, const geometry::Placing& placing);
// Checks that a file in the unit can hold numbers so far from the origin, and be read again.
[[nodiscard]] Result<void> check_reach(const Box& bounds_m, LengthUnit unit);

}  // namespace burin::app
