// SPDX-License-Identifier: MIT
// A mesh with fewer triangles that is nowhere farther than a bound from the first: no point of the one surface lies farther
// than the bound from the other, in both directions (Hausdorff distance). The bound holds by construction
// (edge_collapse.hpp) and is measured afterwards by other means (surface_distance.hpp).
//
// A closed two-manifold stays one; colours and borders between materials keep their places, within the bound. Vertices of the
// result are vertices of the input, at the same places to the bit. Flat parts come down to what their outline needs.
// The result may pass through itself where two sheets are nearer than twice the bound: whoever minds (compute/thin_out.hpp)
// looks, and asks for the vertices there to be kept.
// Lengths in metres. Deterministic for any for_each. Cost: 20 us a triangle, 300 bytes of working memory each.
#pragma once

#include <functional>
#include <vector>

#include "base/error.hpp"
#include "geometry/surface_distance.hpp"

namespace burin {

struct SimplifyOptions {
    double bound_m = 0.0;              // above zero
    std::vector<std::uint32_t> keep;   // vertices that must stay
    ForEach for_each = one_by_one;     // for the measuring
    std::function<void(double)> show;  // called now and then with the share done, 0 to 1; may be empty
};

struct Simplified {
    TriangleMesh mesh;
    std::vector<std::uint32_t> first_vertex;  // of each vertex: its index in the input
    double error_m = 0.0;                     // the measured two-sided distance: an upper bound, never above bound_m
};

// Fails on a bound that is not a number above zero.
[[nodiscard]] Result<Simplified> simplify(const TriangleMesh& mesh, const SimplifyOptions& options);

}  // namespace burin
