// SPDX-License-Identifier: MIT
// Simple polygons by construction, for the tests of splitting them; and what a split must keep of them.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "geometry/mesh/polygon.hpp"

namespace burin::geometry::test {

// A corner on a lattice. Coordinates stay below 2^29, so that areas are exact in 64 bits. Those of an outline are
// multiples of kLattice, so that the middle of an edge is exact as well.
struct LatticePoint {
    std::int64_t x = 0, y = 0;
    friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};
using LatticePolygon = std::vector<LatticePoint>;
inline constexpr std::int64_t kLattice = 1024;

[[nodiscard]] std::int64_t twice_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
// By the shoelace formula; positive when the polygon runs counter-clockwise.
[[nodiscard]] std::int64_t twice_area(const LatticePolygon& polygon);

// Counter-clockwise outlines.
[[nodiscard]] LatticePolygon star(std::mt19937_64& random, std::size_t corners);
[[nodiscard]] LatticePolygon comb(std::mt19937_64& random, std::size_t teeth);
[[nodiscard]] LatticePolygon spiral(std::size_t corners_on_a_side, double turns);
[[nodiscard]] LatticePolygon letter_c(std::size_t corners_on_a_side);
[[nodiscard]] LatticePolygon gear(std::size_t teeth);
// A level line below, random steps above: many corners above each other, and many on one line.
[[nodiscard]] LatticePolygon skyline(std::mt19937_64& random, std::size_t steps);
// Random corners, joined in an order in which no edges meet: two edges that do are exchanged until none are left.
[[nodiscard]] LatticePolygon uncrossed(std::mt19937_64& random, std::size_t corners);
// Any of them, of 3 to some 200 corners.
[[nodiscard]] LatticePolygon any_outline(std::mt19937_64& random);
// The same outline with more corners in the middle of edges.
[[nodiscard]] LatticePolygon with_corners_on_edges(std::mt19937_64& random, LatticePolygon polygon);
// A ring: a circle joined with a smaller one in its middle by a slit of no width.
[[nodiscard]] LatticePolygon slit_ring(std::size_t corners_on_a_side);

// Returns the corners in the plane z = 0.
[[nodiscard]] std::vector<Vec3> in_space(const LatticePolygon& polygon);

// Returns what is wrong with a split as triangles over the corners: their number, an edge of the polygon that is no
// edge of them, an edge with no partner. Empty when all is well.
[[nodiscard]] std::string fault_of_edges(const SplitPolygon& split, std::size_t corners);
// Also compares areas, exactly: no triangle is turned or empty, and they add up to the polygon's area.
[[nodiscard]] std::string fault_of(const SplitPolygon& split, const LatticePolygon& polygon);

}  // namespace burin::geometry::test
