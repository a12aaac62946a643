// SPDX-License-Identifier: MIT
// An upper bound on the distance from any point of one triangle mesh to the nearest point of another, close to the true
// value. One-sided; the two directions together bound the Hausdorff distance.
//
// Method: the distance to a triangle is convex, so over a convex piece it is largest at the piece's corners. A piece is
// compared with the triangle nearest to its centre, cut at that triangle's borders, and halved, until the bound is
// close enough.
// Lengths in metres. Deterministic. Cost: about 2 us a piece; there are a few pieces for each triangle of both meshes.
#pragma once

#include <functional>
#include <vector>

#include "geometry/mesh/triangle_tree.hpp"

namespace burin::geometry {

// Calls task(0) .. task(count - 1), on as many threads as the implementation likes. This folder has no threads of its
// own.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;
void one_by_one(std::size_t count, const std::function<void(std::size_t)>& task);

struct SurfaceDistance {
    double largest_m = 0.0;         // an upper bound, at most tolerance_m above the true value
    std::vector<double> of_from_m;  // the same for each triangle of `from`
    // for each triangle of `to`: the largest bound of the pieces that were compared with it
    std::vector<double> attributed_m;
};

// Measures how far `from` is from `to`, the mesh of the tree, which must have triangles unless `from` has none.
// tolerance_m must be above zero.
[[nodiscard]] SurfaceDistance distance_from(std::span<const Vec3> from_positions,
                                            std::span<const VertexTriple> from_triangles, const TriangleMesh& to,
                                            const TriangleTree& to_tree, double tolerance_m,
                                            const ForEach& for_each = one_by_one);

}  // namespace burin::geometry
