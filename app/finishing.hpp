// SPDX-License-Identifier: MIT
// What happens to a carved mesh before it leaves: self-intersections are mended, slivers counted, and with --simplify the
// triangles thinned out. Prints a line where something cannot be mended or shown; the figures go into the report.
#pragma once

#include <optional>

#include "base/json.hpp"
#include "compute/surface.hpp"
#include "compute/thin_out.hpp"

namespace burin {

struct FinishedMesh {
    TriangleMesh mesh;
    Json self_intersections;  // found, mended, left, ...
    Json slivers;
    Json simplification;  // null when none was asked for
};

// For options, before any long step: a bound must be a distance above zero.
[[nodiscard]] Result<void> check_simplification(std::optional<double> bound_m);

// The bound must have been checked.
[[nodiscard]] Result<FinishedMesh> finish_mesh(const Surface& surface, const Solid& solid,
                                               std::optional<double> simplify_bound_m, WorkerPool& pool);

// thin_out with a progress line, and its figures.
struct SimplifiedMesh {
    TriangleMesh mesh;
    Json figures;
};
[[nodiscard]] Result<SimplifiedMesh> simplify_with_progress(const TriangleMesh& mesh, double bound_m, WorkerPool& pool);

}  // namespace burin
