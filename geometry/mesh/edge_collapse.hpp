// SPDX-License-Identifier: MIT
// Removes vertices of a triangle mesh one after another, as long as the surface stays within a bound of the first one.
//
// A vertex is removed by moving it onto a neighbour (a half-edge collapse): a fan of triangles from that neighbour
// replaces the fan around it. Old and new fan fill the same ring. Seen along the ring's normal both cover the same area
// once, which maps one onto the other; the map moves a point farthest at a corner of the overlay of the two fans, so a
// few crossings of their spokes give the exact largest motion (after Bajaj and Schikore 1996, and Cohen, Manocha and
// Olano 1997). Each triangle carries the sum of the motions so far. A step that would exceed the bound, fold the
// surface over, join separate parts, or change the colour of a point too much is refused. So the bound holds at every
// step, in both directions, and a closed two-manifold stays one. The order of removal is by least quadric error
// (Garland and Heckbert 1997).
//
// Vertices without a closed fan (on a border, at a non-manifold edge) stay. Remaining positions are those of the input,
// bit for bit. Internal to geometry/. Cost: about 10 us for each vertex removed.
#pragma once

#include <functional>
#include <vector>

#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

struct CollapseState {
    TriangleMesh mesh;
    // For each triangle: a bound on its distance from the first surface, in both directions.
    std::vector<double> moved_m;
    // For each triangle: the largest change of colour at any of its points, in levels of 255.
    std::vector<double> colour_change;
    std::vector<std::uint32_t> first_vertex;  // index of each vertex in the first mesh
    std::vector<bool> kept;                   // vertices that must stay
};

// The largest change of colour allowed at a point, in levels of 255: below what is visible side by side.
inline constexpr double kMostColourChange = 12.0;

// Calls `show` now and then with the share of the work done. Returns the number of vertices removed.
std::size_t collapse_edges(CollapseState& state, double bound_m, const std::function<void(double)>& show);

}  // namespace burin::geometry
