// SPDX-License-Identifier: MIT
// The tiles of a carved surface around the tool, shared by reference, and the search for the few triangles near it.
//
// No search structure is built: a tile holds its quads sorted by the lattice edge that each surrounds, and a quad's
// corners are at most kReach cells from that edge's lower node. So the edges alone rule out most quads that are too
// far, and only the corners of the rest are read.
// Frame: relative to the lattice's origin, metres. The holder of a block may read it without a lock, since no tile ever
// changes. Copying or filling a block counts references and may free tiles, so only the carving side does it.
// A query does not allocate, lock or throw. Its cost, in the tiles within reach: the 48 rows of each, 2 ns for each
// quad of the rows within reach, and a test of the corners of those quads whose edge is near enough, four quads at
// once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/contact/quad_gate.hpp"
#include "geometry/contact/surface_points.hpp"
#include "geometry/contact/surface_tile.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

struct TileBlock {
    // One position of the block's grid of tiles.
    struct Place {
        std::shared_ptr<const SurfaceTile> tile;  // null: no surface there, or out of reach
        std::uint32_t first_triangle = 0;         // number of triangles in the preceding places
    };
    double cell_m = 0.0;                // spacing of the lattice
    std::array<int, 3> first{0, 0, 0};  // lattice index of the first place's tile
    std::array<int, 3> count{0, 0, 0};  // number of places along x, y, z
    std::vector<Place> places;          // ordered with x fastest, then y, then z
    std::uint32_t triangles = 0;        // total of all places; triangle numbers count in this order

    // The greatest distance of a quad's corner from the edge's lower node along each axis, in cells: a cell and a half,
    // plus a margin for the rounding to float.
    static constexpr double kReach = 1.5 + 1.0 / 64.0;

    // Returns a box that contains all triangles.
    [[nodiscard]] Box bounds() const noexcept {
        Box box{Vec3(0.0), Vec3(0.0)};
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            box.lo[axis] = (first[k] * SurfaceTile::kCells - kReach) * cell_m;
            box.hi[axis] = ((first[k] + count[k]) * SurfaceTile::kCells - 1 + kReach) * cell_m;
        }
        return box;
    }
    // Both functions require a number below `triangles`.
    [[nodiscard]] Triangle triangle(std::uint32_t number) const noexcept;
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t number) const noexcept;

private:
    using Corners = std::array<const shared::SurfaceVertex*, 3>;
    [[nodiscard]] Corners corners(std::uint32_t number) const noexcept;
};

inline TileBlock::Corners TileBlock::corners(std::uint32_t number) const noexcept {
    // Finds the last place that does not begin after the number; of several that begin there, the last has triangles.
    const auto after = std::ranges::upper_bound(places, number, {}, &Place::first_triangle);
    const Place& place = *(after - 1);
    const std::uint32_t* corner = &place.tile->indices[std::size_t{3} * (number - place.first_triangle)];
    const auto at = [&](std::size_t k) { return &place.tile->vertices[corner[k]]; };
    return {at(0), at(1), at(2)};
}

inline Triangle TileBlock::triangle(std::uint32_t number) const noexcept {
    const Corners corner = corners(number);
    return {Vec3(place_of(*corner[0])), Vec3(place_of(*corner[1])), Vec3(place_of(*corner[2]))};
}

inline CornerNormals TileBlock::corner_normals(std::uint32_t number) const noexcept {
    const auto normal = [](const shared::SurfaceVertex* v) {
        const shared::Direction d = shared::decode_normal(v->normal);
        return Vec3f(d.x, d.y, d.z);
    };
    const Corners corner = corners(number);
    return {true, {normal(corner[0]), normal(corner[1]), normal(corner[2])}};
}

// A range of lattice nodes, inclusive.
struct NodeRange {
    std::array<int, 3> from{0, 0, 0}, to{-1, -1, -1};
};

// Returns the nodes of the block whose edges may have triangles within reach; an empty range (to below from) when there
// are none.
[[nodiscard]] inline NodeRange nodes_near(const TileBlock& block, const Near& near) noexcept {
    NodeRange range;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const double first = block.first[k] * SurfaceTile::kCells;
        const double last = first + block.count[k] * SurfaceTile::kCells - 1.0;
        const double from = std::ceil((near.lo[axis] - near.reach_m) / block.cell_m - TileBlock::kReach);
        const double to = std::floor((near.hi[axis] + near.reach_m) / block.cell_m + TileBlock::kReach);
        if (!(from <= last && to >= first && from <= to)) return {};  // true for NaN too
        range.from[k] = static_cast<int>(std::max(from, first));
        range.to[k] = static_cast<int>(std::min(to, last));
    }
    return range;
}

// Lower bounds of a quad's distance from the box, from the lattice edge alone that it surrounds: squared, in cells, for
// each coordinate of the edge's lower node in a tile. The sum over x, y and z never exceeds the squared distance of any
// corner.
struct EdgeDistances {
    using OfAxis = std::array<std::array<float, SurfaceTile::kCells>, 3>;
    OfAxis across, along;  // for edges along the two other axes, and for edges along this axis
    double cell_m;

    // `first_node` is the tile's first node in the lattice.
    EdgeDistances(const Near& near, double cell_length_m, const std::array<int, 3>& first_node) noexcept
        : cell_m(cell_length_m) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            const auto lo = static_cast<float>(near.lo[axis] / cell_m - first_node[k] - TileBlock::kReach);
            const auto hi = static_cast<float>(near.hi[axis] / cell_m - first_node[k] + TileBlock::kReach);
            float* const of_across = across[k].data();
            float* const of_along = along[k].data();
            for (int node = 0; node < SurfaceTile::kCells; ++node) {  // written so that the compiler vectorises it
                const auto at = static_cast<float>(node);
                const float below = std::max(lo - at, 0.0f), above = at - hi;
                of_across[node] = squared(std::max(below, above));
                of_along[node] = squared(std::max(below, above + 1.0f));
            }
        }
    }
    [[nodiscard]] float reach2(const Near& near) const noexcept {
        return squared(static_cast<float>(near.reach_m / cell_m * (1.0 + 1e-5)));
    }
    static float squared(float x) noexcept { return x * x; }
};

// Collects the quads of a tile whose edges are near enough and tests four at a time; calls visit(triangle of the tile,
// triangle).
template <typename Visit>
class QuadsNear {
public:
    QuadsNear(const SurfaceTile& tile, QuadGate& gate, Near& near, Visit& visit) noexcept
        : vertices_(tile.vertices.data()), indices_(tile.indices.data()), gate_(gate), near_(near), visit_(visit) {}

    // Adds the quad whose triangles are i and i + 1. Returns false when visit returned false or no looks are left.
    [[nodiscard]] bool add(std::uint32_t i) {
        if (near_.passes_by()) return true;
        if (!near_.look()) {
            end();
            return false;
        }
        quads_[count_++] = i;
        return count_ < kLanes || look();
    }
    // Tests one triangle that is part of a fan.
    [[nodiscard]] bool add_alone(std::uint32_t i) {
        if (near_.passes_by()) return true;
        if (!near_.look()) return false;
        const std::uint32_t* const corner = indices_ + std::size_t{3} * i;
        const Vec3Lanes a = in_all_lanes(place_of(vertices_[corner[0]])),
                        b = in_all_lanes(place_of(vertices_[corner[1]])),
                        c = in_all_lanes(place_of(vertices_[corner[2]]));
        if (!gate_.reaches_as_far_as(near_)) gate_.reach(near_);
        const auto passed = gate_.look({a, b, c, c}, LaneMask{-1, -1, -1, -1});
        return passed.first[0] == 0 || pass_on(i, passed.sound_first[0] != 0);
    }
    // Tests the quads that are left over.
    bool end() { return count_ == 0 || look(); }

private:
    bool look() {
        LaneMask asked{};
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            asked[k] = k < count_ ? -1 : 0;
            if (k >= count_) quads_[k] = quads_[0];
        }
        count_ = 0;
        if (!gate_.reaches_as_far_as(near_)) gate_.reach(near_);
        const auto passed = gate_.look(corners(), asked);
        if (!any(passed.first | passed.second)) return true;
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            if (passed.first[k] != 0 && !pass_on(quads_[k], passed.sound_first[k] != 0)) return false;
            if (passed.second[k] != 0 && !pass_on(quads_[k] + 1, passed.sound_second[k] != 0)) return false;
        }
        return true;
    }
    // Reads the corners of four quads. Both triangles of a quad begin with the same corner, and either the second
    // continues with the first's last corner, or the first continues with the second's last corner.
    [[nodiscard]] FourQuads corners() const noexcept {
        const float *a[kLanes], *p[kLanes], *q[kLanes], *d[kLanes];
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            const std::uint32_t* const corner = indices_ + std::size_t{3} * quads_[k];
            const bool flip = corner[4] != corner[2];
            a[k] = &vertices_[corner[0]].x;
            p[k] = &vertices_[corner[flip ? 1 : 2]].x;
            q[k] = &vertices_[corner[flip ? 2 : 1]].x;
            d[k] = &vertices_[corner[flip ? 4 : 5]].x;
        }
        return {gathered(a), gathered(p), gathered(q), gathered(d)};
    }
    bool pass_on(std::uint32_t i, bool sound) {
        const std::uint32_t* const corner = indices_ + std::size_t{3} * i;
        const Triangle t{Vec3(place_of(vertices_[corner[0]])), Vec3(place_of(vertices_[corner[1]])),
                         Vec3(place_of(vertices_[corner[2]]))};
        return (!sound && is_degenerate(t)) || visit_(i, t);
    }

    const shared::SurfaceVertex* vertices_;
    const std::uint32_t* indices_;
    QuadGate& gate_;
    Near& near_;
    Visit& visit_;
    std::array<std::uint32_t, kLanes> quads_{};  // each by its first triangle
    std::uint32_t count_ = 0;
};

// Calls visit(triangle of the tile, triangle) for the triangles of one tile that are near.
template <typename Visit>
bool for_each_near_in_tile(const SurfaceTile& tile, const EdgeDistances& edges, QuadGate& gate, Near& near,
                           Visit&& visit) {
    QuadsNear quads_near(tile, gate, near, visit);
    const bool only_quads = tile.only_quads();
    const std::uint16_t* const quads = tile.quads.data();
    constexpr unsigned kCells = SurfaceTile::kCells, kInRow = kCells * kCells - 1;
    constexpr std::size_t kRowsInALook = 8;  // of those that are mostly passed by
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& of_x = axis == 0 ? edges.along[0] : edges.across[0];
        const auto& of_y = axis == 1 ? edges.along[1] : edges.across[1];
        const auto& of_z = axis == 2 ? edges.along[2] : edges.across[2];
        const float reach2 = edges.reach2(near);
        unsigned first_x = 0, last_x = kCells - 1;  // x outside this range is too far for every quad
        while (first_x < last_x && !(of_x[first_x] <= reach2)) ++first_x;
        while (last_x > first_x && !(of_x[last_x] <= reach2)) --last_x;
        for (std::size_t y = 0; y < SurfaceTile::kCells; ++y) {
            const float left2 = reach2 - of_y[y];
            if (!(left2 >= 0.0f)) continue;
            const std::size_t row = axis * SurfaceTile::kCells + y;
            // Rare: some quads are fans, so that a quad's index does not give its triangles.
            if (!only_quads) {
                for (std::uint32_t i = tile.row_triangles[row]; i < tile.row_triangles[row + 1]; ++i)
                    if (!quads_near.add_alone(i)) return false;
                continue;
            }
            std::uint32_t q = tile.row_quads[row];
            const std::uint32_t end = tile.row_quads[row + 1];
            while (q < end && (quads[q] & kInRow) < first_x * kCells) ++q;
            if (near.thin > 1 && q < end && row % kRowsInALook == 0 && !near.look()) return false;
            for (; q < end; ++q) {
                // Of a row whose quads are passed by only those that are not are read.
                if (near.thin > 1 && (q += near.pass_over(end - q)) >= end) break;
                const unsigned x = (quads[q] & kInRow) / kCells, z = quads[q] % kCells;
                if (x > last_x) break;
                if (of_x[x] + of_z[z] > left2)
                    near.met += 1;
                else if (!quads_near.add(2 * q))
                    return false;
            }
        }
    }
    return quads_near.end();
}

// A box that contains a tile's surface.
[[nodiscard]] inline Box box_of_tile(double cell_m, const std::array<int, 3>& first_node) noexcept {
    const Vec3 first(first_node[0], first_node[1], first_node[2]);
    return {cell_m * (first - TileBlock::kReach), cell_m * (first + (SurfaceTile::kCells - 1 + TileBlock::kReach))};
}

// Whether a tile's surface may be within reach; `first_node` is the tile's first node in the lattice.
[[nodiscard]] inline bool tile_is_near(const Near& near, double cell_m, const std::array<int, 3>& first_node) noexcept {
    double outside2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = (first_node[static_cast<std::size_t>(axis)] - TileBlock::kReach) * cell_m;
        const double hi = lo + (SurfaceTile::kCells - 1 + 2.0 * TileBlock::kReach) * cell_m;
        const double outside = std::max({near.lo[axis] - hi, lo - near.hi[axis], 0.0});
        outside2 += outside * outside;
    }
    return outside2 <= near.reach_m * near.reach_m * (1.0 + 1e-5);
}

// Visits triangles and points as for_each_near(LocalSurface) does (geometry/contact/local_surface_search.hpp);
// triangles by their number.
template <typename Visitor>
bool for_each_near(const TileBlock& block, Near& near, const Visitor& visit) {
    constexpr int kCells = SurfaceTile::kCells;
    // the longest edge is at most the diagonal of a cube of 2 kReach cells
    QuadGate gate(near, 5.5 * block.cell_m, block.cell_m);
    const PointGate points(near, Vec3(0.0));
    const NodeRange nodes = nodes_near(block, near);
    std::array<int, 3> from{}, to{};  // indices of places
    for (std::size_t k = 0; k < 3; ++k) {
        if (nodes.to[k] < nodes.from[k]) return true;
        from[k] = (nodes.from[k] - block.first[k] * kCells) / kCells;
        to[k] = (nodes.to[k] - block.first[k] * kCells) / kCells;
    }
    for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
            for (int x = from[0]; x <= to[0]; ++x) {
                const TileBlock::Place& place =
                    block.places[static_cast<std::size_t>((z * block.count[1] + y) * block.count[0] + x)];
                if (!place.tile) continue;
                const std::array<int, 3> first_node{(block.first[0] + x) * kCells, (block.first[1] + y) * kCells,
                                                    (block.first[2] + z) * kCells};
                if (skips(visit, box_of_tile(block.cell_m, first_node), place.tile->slab, Vec3(0.0))) continue;
                if constexpr (Visitor::kWantsPoints)
                    if (place.tile->longest_edge_m <= visit.fineness.longest_edge_m) {
                        if (tile_is_near(near, block.cell_m, first_node) &&
                            !for_each_point_near(*place.tile, points, visit.fineness.stride, near, visit.point))
                            return false;
                        continue;
                    }
                const EdgeDistances edges(near, block.cell_m, first_node);
                const auto visit_numbered = [&](std::uint32_t i, const Triangle& t) {
                    return visit.triangle(place.first_triangle + i, t);
                };
                if (!for_each_near_in_tile(*place.tile, edges, gate, near, visit_numbered)) return false;
            }
    return true;
}

}  // namespace burin::geometry
