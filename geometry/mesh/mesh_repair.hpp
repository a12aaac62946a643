// SPDX-License-Identifier: MIT
// Repairs of a triangle mesh, each done on request only and each with a report. None drops a triangle that has area.
// The usual order: weld_vertices, join_open_edges, close_holes, orient_outward. Metres, object frame. Deterministic;
// single-threaded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// Merges vertices at equal positions (bit for bit, -0 = 0), which a mesh with seams (OBJ texture islands, flat-shaded
// exports) needs before its edges can meet. The first of the merged vertices keeps its colour. Unused vertices stay.
struct WeldReport {
    std::size_t vertices_merged = 0;
};
WeldReport weld_vertices(TriangleMesh& mesh);

// Joins vertices of open edges (an odd number of triangles) that lie within the tolerance of each other, so that a
// surface closes whose corners were rounded in two ways. Where the surface is closed nothing changes, however near two
// of its vertices lie. No vertex moves by more than the tolerance: of those that are joined the first keeps its place
// and its colour. Triangles that are folded to a line or a point are dropped, and counted. To be called after
// weld_vertices.
struct JoinReport {
    std::size_t vertices_joined = 0;  // that moved onto another
    double farthest_m = 0.0;          // the farthest of these moves
    std::size_t triangles_dropped = 0;
};
JoinReport join_open_edges(TriangleMesh& mesh, double tolerance_m);
// Says what was joined: "36 corners up to 7.6e-06 mm apart were joined"; empty where nothing was.
[[nodiscard]] std::string in_words(const JoinReport& joined);

// Returns the tolerance, of a few powers of ten below the mesh's size, with which join_open_edges would close a mesh
// that is open; nothing where none does, since the holes are wider, or since walls would be pressed together: what is
// left must be thicker than the tolerance.
[[nodiscard]] std::optional<double> tolerance_that_closes_m(const TriangleMesh& mesh);

// The method that filled a hole.
enum class HoleFilling : std::uint8_t {
    least_area,  // the triangulation of least area over the loop's own vertices (Barequet and Sharir 1995, O(n^3))
    flat,        // long loops: split as polygons that are nearly flat (polygon.hpp)
    centre_fan,  // the others: a new vertex at the centre, joined with every edge
};

struct ClosedHole {
    std::size_t edges = 0;
    double perimeter_m = 0.0;
    double area_added_m2 = 0.0;
    std::size_t triangles_added = 0;
    HoleFilling filling = HoleFilling::least_area;
};

struct ClosingReport {
    std::vector<ClosedHole> holes;
    std::size_t vertices_added = 0;
    std::size_t triangles_added = 0;
};

// Fills each hole (see mesh_health.hpp) with triangles. Afterwards every edge has an even number of uses: the mesh is
// closed. The filling is oriented like its surroundings, takes the most frequent material along its rim, and adds no
// edge that the mesh has already, hence no non-manifold edge. It may pass through other parts of the surface.
// Cost: n log n, plus the cube of each loop's length for loops of at most kLeastAreaEdges edges (2 million steps for
// 200 edges).
inline constexpr std::size_t kLeastAreaEdges = 300;
ClosingReport close_holes(TriangleMesh& mesh);

// Flips triangles so that neighbours over edges of two uses agree, as few as possible in each patch of triangles joined
// by such edges. Then flips whole patches that are inside out: closed ones that lie within no other patch's bounds and
// have negative volume, and finally all patches together if the whole still has negative volume. A patch within another
// one's bounds may be a cavity and keeps its orientation.
struct OrientationReport {
    std::size_t triangles_turned = 0;  // compared with the input
    std::size_t patches = 0;
    std::size_t patches_turned = 0;  // whole patches, because they were inside out
    std::size_t conflicts = 0;       // edges that no orientation can satisfy (a Moebius band has some)
};
OrientationReport orient_outward(TriangleMesh& mesh);

}  // namespace burin::geometry
