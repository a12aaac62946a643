// SPDX-License-Identifier: MIT
// Two whole solids on one lattice into one: ray by ray, exactly (ray_algebra.hpp).
#pragma once

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"

namespace burin {

enum class Combination { unite, subtract, intersect };

// a u b, a - b or a n b. The result's materials are a's and, behind them, those of b that a lacks; ends keep the material of the
// solid that made them. Where faces of both coincide, a's stays. The result may be empty. Fails when the lattices differ, or
// when there are more than 255 materials together. Does not depend on the number of threads.
[[nodiscard]] Result<Solid> combine(const Solid& a, const Solid& b, Combination operation, WorkerPool& pool);

}  // namespace burin
