// SPDX-License-Identifier: MIT
// Exact crossings of lattice rays with triangles whose coordinates are whole numbers, and the intervals that follow
// from them. Used by scan conversion (scan_convert.hpp) and mesh tools (mesh_tool.hpp).
//
// Whether a ray passes through a triangle is decided in 64-bit integers. A ray through an edge or a vertex is counted
// once: the ray is treated as if moved by an infinitely small step along u and a still smaller one along v, the same
// for every triangle, so that no edge is ever hit exactly. A mesh whose every edge has an even number of triangles
// therefore gives every ray an even number of crossings. Coordinates must stay within +-2^28 units.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/rays/lattice.hpp"

namespace burin::compute {

using Whole3 = std::array<std::int64_t, 3>;  // a point in lattice units

struct WholeMesh {
    std::span<const Whole3> vertices;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

// The rays of one axis with u_lo <= u <= u_hi and v_lo <= v <= v_hi. They are numbered row by row, starting at 0 for
// the ray (u_lo, v_lo).
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
    std::uint32_t ray;   // number in the window
    std::int32_t depth;  // lattice units, rounded to nearest
    std::uint32_t triangle;
    std::int8_t enters;  // +1 if the ray enters the material, -1 if it leaves it
};

// Returns all crossings of the window's rays, sorted by ray, then by depth. Crossings at one depth that enter the
// material come before those that leave it, so that touching shells are united. The result does not depend on the
// number of threads.
[[nodiscard]] std::vector<Crossing> sorted_crossings(const WholeMesh& mesh, const RayWindow& window, WorkerPool& pool);

// Appends to `bounds` the crossings of one ray that bound its intervals, alternately entering and leaving the material.
// A depth is inside where the winding number is above zero or, with by_parity, where the number of crossings so far is
// odd. Intervals without thickness are dropped, and those that share an end are joined. Returns false when the
// crossings do not pair up.
bool append_interval_bounds(std::span<const Crossing> crossings, bool by_parity, std::vector<Crossing>& bounds);

// Returns the crossings from index `from` on that lie on the same ray.
[[nodiscard]] inline std::span<const Crossing> ray_at(std::span<const Crossing> crossings, std::size_t from) {
    std::size_t to = from;
    while (to < crossings.size() && crossings[to].ray == crossings[from].ray) ++to;
    return crossings.subspan(from, to - from);
}

}  // namespace burin::compute
