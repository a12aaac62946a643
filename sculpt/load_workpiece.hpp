// SPDX-License-Identifier: MIT
// Makes the solid that is carved, as --workpiece and --resolution name it.
// Lengths in metres, object frame. Any thread.
#pragma once

#include <string>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"
#include "workpiece/loaded_workpiece.hpp"
#include "workpiece/workpiece_options.hpp"

namespace burin::sculpt {

// Returns the share of all the work at which the solid is there and its surface is meshed.
[[nodiscard]] double meshing_from(const workpiece::WorkpieceOptions& options);

// Notes in `size` and in the report what of the mesh no ray of its solid met (unmet_parts.hpp).
void note_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid, std::string& size, Json& report);

// Makes the solid of a file or a shape, with its room. Every triangle of a file is in the solid or in the report.
[[nodiscard]] Result<workpiece::LoadedWorkpiece> load_workpiece(const workpiece::WorkpieceOptions& options,
                                                                WorkerPool& pool,
                                                                const workpiece::LoadWatch& watch = {});

}  // namespace burin::sculpt
