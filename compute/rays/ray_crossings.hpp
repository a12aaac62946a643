// SPDX-License-Identifier: MIT
// Where rays of the lattice pass through triangles with whole coordinates, exactly, and the intervals that follow. Scan
// conversion (scan_convert.hpp) and mesh tools (mesh_tool.hpp) both stand on it.
//
// Whether a ray passes through a triangle is decided in 64-bit integers. A ray through an edge or a vertex is counted once: the
// ray is treated as if moved by an infinitely small step along u and a still smaller one along v, the same for every triangle,
// so that no edge is ever hit exactly. A mesh whose every edge has an even number of triangles therefore gives every ray an
// even number of crossings. Coordinates must stay within +-2^28 units.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/lattice.hpp"

namespace burin {

using Whole3 = std::array<std::int64_t, 3>;  // a point in lattice units

struct WholeMesh {
    std::span<const Whole3> vertices;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

// The rays of one axis with u_lo <= u <= u_hi and v_lo <= v <= v_hi; row by row, number 0 is the lowest.
struct RayWindow {
    int axis = 0, u_lo = 0, u_hi = -1, v_lo = 0, v_hi = -1;
    [[nodiscard]] bool empty() const { return u_lo > u_hi || v_lo > v_hi; }
    [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(u_hi - u_lo + 1); }
    [[nodiscard]] std::size_t rays() const { return empty() ? 0 : width() * static_cast<std::size_t>(v_hi - v_lo + 1); }
};
[[nodiscard]] inline RayWindow all_rays(const Lattice& lattice, int axis) {
    return {axis, 0, lattice.rays_u(axis) - 1, 0, lattice.rays_v(axis) - 1};
}

struct Crossing {
    std::uint32_t ray;   // its number in the window
    std::int32_t depth;  // rounded to nearest
    std::uint32_t triangle;
    std::int8_t enters;  // +1 into the material, -1 out of it
};

// All crossings of the window's rays, sorted by ray, then depth; at one depth the surface is entered first, so that touching
// shells unite. Does not depend on the number of threads.
[[nodiscard]] std::vector<Crossing> sorted_crossings(const WholeMesh& mesh, const RayWindow& window, WorkerPool& pool);

// Appends to `bounds` the crossings of one ray that bound its intervals, by turns one that enters and one that leaves. Inside is
// where the winding number is above zero, or with by_parity where the number of crossings so far is odd. Intervals without
// thickness go; those that share an end are one. False when the crossings do not pair up.
bool append_interval_bounds(std::span<const Crossing> crossings, bool by_parity, std::vector<Crossing>& bounds);

// The crossings that start at `from` and lie on one ray.
[[nodiscard]] inline std::span<const Crossing> ray_at(std::span<const Crossing> crossings, std::size_t from) {
    std::size_t to = from;
    while (to < crossings.size() && crossings[to].ray == crossings[from].ray) ++to;
    return crossings.subspan(from, to - from);
}

}  // namespace burin
