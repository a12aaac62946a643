// SPDX-License-Identifier: MIT
// Takes vertices out of a triangle mesh, one after the other, as long as the surface stays within a bound of where it was.
//
// A vertex goes by moving onto a neighbour (a half-edge collapse): the fan of triangles around it is replaced by one from
// that neighbour. Old and new fan fill the same ring. Seen along the ring's normal both cover the same area once, which maps
// one onto the other; the map moves a point farthest at a corner of the overlay of the two fans, so a few crossings of
// their spokes give the exact largest motion (after Bajaj and Schikore 1996, and Cohen, Manocha and Olano 1997). Each
// triangle carries the sum of the motions so far. A step that would exceed the bound, fold the surface over, join what was
// apart, or change the colour of a place is not taken. So the bound holds at every step, in both directions, and a closed
// two-manifold stays one. Which vertex goes first: the one that loses the least by quadrics (Garland and Heckbert 1997).
//
// Vertices without a closed fan (on a border, at a non-manifold edge) stay. Positions that remain are the input's, bit for
// bit. Internal to geometry/. Cost: about 10 us a vertex taken out.
#pragma once

#include <functional>
#include <vector>

#include "geometry/edge_table.hpp"

namespace burin {

struct CollapseState {
    TriangleMesh mesh;
    std::vector<double> moved_m;        // for each triangle: a bound on how far it is from the first surface, both ways
    std::vector<double> colour_change;  // and how much a colour at some place of it has changed, in levels of 255
    std::vector<std::uint32_t> first_vertex;  // of each vertex: its index in the first mesh
    std::vector<bool> kept;                   // of each vertex: must stay
};

// How much the colour of a place may change, in levels of 255: below what is seen beside each other.
inline constexpr double kMostColourChange = 12.0;

// `show` is called now and then with the share of the work that is done. Returns how many vertices went.
std::size_t collapse_edges(CollapseState& state, double bound_m, const std::function<void(double)>& show);

}  // namespace burin
