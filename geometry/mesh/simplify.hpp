// SPDX-License-Identifier: MIT
// Decimates a mesh within a bound: no point of either surface lies farther than the bound from the other (two-sided
// Hausdorff distance). The bound holds by construction (edge_collapse.hpp) and is measured afterwards by other means
// (surface_distance.hpp).
//
// A closed two-manifold stays one; colours and borders between materials keep their positions, within the bound.
// Vertices of the result are vertices of the input, at the same positions to the bit. Flat parts are reduced to what
// their outline needs. The result may pass through itself where two sheets are nearer than twice the bound: a caller to
// whom that matters (compute/repair/decimate.hpp) tests for it, and asks for the vertices there to be kept.
// Lengths in metres. Deterministic for any for_each. Cost: 20 us a triangle, 300 bytes of working memory each.
#pragma once

#include <functional>
#include <vector>

#include "base/error.hpp"
#include "geometry/mesh/surface_distance.hpp"

namespace burin::geometry {

struct SimplifyOptions {
    double bound_m = 0.0;              // above zero
    std::vector<std::uint32_t> keep;   // vertices that must stay
    ForEach for_each = one_by_one;     // runs the measurement, perhaps on several threads
    std::function<void(double)> show;  // called now and then with the share done, 0 to 1; may be empty
};

struct Simplified {
    TriangleMesh mesh;
    std::vector<std::uint32_t> first_vertex;  // index of each vertex in the input
    double error_m = 0.0;                     // measured two-sided distance: an upper bound, never above bound_m
};

// Decimates the mesh. Fails on a bound that is not a finite number above zero.
[[nodiscard]] Result<Simplified> simplify(const TriangleMesh& mesh, const SimplifyOptions& options);

}  // namespace burin::geometry
