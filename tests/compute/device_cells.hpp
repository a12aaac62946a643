// SPDX-License-Identifier: MIT
// What a device sends home after a cut, made on the host from nothing but the solid after it: the stand-in by which the
// host's half of the work is tested without a device.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/mesher/made_cells.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute::test {

// Every tile is meshed whole, and what the changes reach is taken from it. Tiles where a loop passes a face of a made
// cell twice are left; their lists are empty.
[[nodiscard]] MadeCells device_cells(const Solid& solid, const Changes& changes, WorkerPool& pool);

}  // namespace burin::compute::test
