// SPDX-License-Identifier: MIT
// Combines two solids on one lattice into one, by exact set algebra on each ray (ray_algebra.hpp).
#pragma once

#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

enum class Combination { unite, subtract, intersect };

// Returns the union, the difference a - b or the intersection of two solids, which may be empty. The result's materials
// are those of a, followed by those of b that a lacks; each end keeps the material of the solid it comes from. Where
// faces of both coincide, the end of a is kept. Fails when the lattices differ, or when the solids have more than 255
// materials together. The result does not depend on the number of threads.
[[nodiscard]] Result<Solid> combine(const Solid& a, const Solid& b, Combination operation, WorkerPool& pool);

}  // namespace burin::compute
