// SPDX-License-Identifier: MIT
// The piece of surface near the tool that the carving side publishes to the haptic thread, and that the tick touches.
//
// Data flow: after each update the carving side fills a LocalSurface (the draft of a NewestSlot), calls build_search()
// on it (geometry/local_surface_search.hpp) and publishes it; the tick borrows the newest one. Plain data of fixed
// capacity: filling it never allocates, borrowing it never copies. A slot is about 3 MB.
// Positions are float, in metres, relative to origin_object, so that they keep 1e-7 of the neighbourhood's size however
// far it lies from the object's origin. A triangle winds counter-clockwise seen from outside the material; the side it
// turns to the outside is the only one that can be touched.
// Outside the ball (center_object, radius_m) nothing is known: a tick whose tool leaves it says so and gives no force.
// made_ns is also the carving side's sign of life: while the tool is in contact it must publish at least as often as
// TickParameters::max_surface_age_s asks, even if nothing has changed.
#pragma once

#include <array>
#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin {

// A uniform grid over the triangles of one LocalSurface. Written by build_search() alone, read through
// for_each_triangle_near(). A triangle is listed once, in the cell of its sphere's middle, so a query looks as much farther as
// the largest listed sphere reaches; a triangle larger than a cell is in `large`, which every query looks at.
struct SurfaceGrid {
    static constexpr std::uint32_t kMaxCellsAnAxis = 32;
    static constexpr std::uint32_t kMaxCells = kMaxCellsAnAxis * kMaxCellsAnAxis * kMaxCellsAnAxis;
    static constexpr std::uint32_t kMaxTriangles = 65536;

    bool built = false;
    std::array<std::uint32_t, 3> cells{1, 1, 1};  // along x, y, z
    Vec3f lo{0.0f};                               // corner of the first cell, relative to origin_object
    float cell_m = 1.0f;
    float reach_m = 0.0f;      // no listed triangle is farther from its cell than this
    float mean_edge_m = 0.0f;  // root of the mean square, of the listed triangles: the length scale of the mesh
    std::uint32_t listed = 0;  // triangles that can be found
    std::uint32_t large_count = 0;
    std::array<std::uint32_t, kMaxCells + 1> first_entry;  // of a cell; its entries end where the next cell's begin
    std::array<std::uint32_t, kMaxTriangles> entries;      // triangle indices
    std::array<std::uint32_t, kMaxTriangles> large;        // triangle indices
    std::array<glm::vec4, kMaxTriangles> spheres;          // around each triangle: centre, radius; below 0: not listed
    std::array<std::uint16_t, kMaxTriangles> cell_of;      // of each listed triangle that is not large
};

struct LocalSurface {
    static constexpr std::uint32_t kMaxVertices = 32768;
    static constexpr std::uint32_t kMaxTriangles = SurfaceGrid::kMaxTriangles;

    std::uint64_t sequence = 0;  // 0: never published; a tick record names the surface it used
    Nanoseconds made_ns = 0;     // when the carving side published it
    Vec3 origin_object{0.0};     // what the float positions are relative to
    Vec3 center_object{0.0};     // the ball within which the surface is complete
    double radius_m = 0.0;
    std::uint32_t vertex_count = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t dropped_triangles =
        0;  // did not fit; then radius_m has been reduced so that the ball is still complete
    std::array<Vec3f, kMaxVertices> positions_m;
    std::array<std::array<std::uint32_t, 3>, kMaxTriangles> triangles;
    SurfaceGrid search;
};

}  // namespace burin
