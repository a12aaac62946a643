// SPDX-License-Identifier: MIT
#include "compute/rays/ray_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "shaders/shared/dexel.h"

namespace burin::compute {
namespace {

using shared::kUnitsPerCell;

// Side of the edge a -> b on which the ray lies; the area is positive to the left. A ray exactly on the edge is treated
// as if moved by (e, e^2) for an infinitely small e.
struct Side {
    std::int64_t area;  // twice the signed area of the triangle (a, b, ray)
    bool left;
};

Side side_of(std::int64_t au, std::int64_t av, std::int64_t bu, std::int64_t bv, std::int64_t u, std::int64_t v) {
    const std::int64_t area = (bu - au) * (v - av) - (bv - av) * (u - au);
    if (area != 0) return {area, area > 0};
    if (bv != av) return {0, bv < av};
    return {0, bu > au};
}

// Return the first and the last ray of lo..hi at a coordinate within min..max units.
std::int64_t first_ray(std::int64_t min, int lo) {
    return min <= std::int64_t{lo} * kUnitsPerCell ? lo : (min + kUnitsPerCell - 1) / kUnitsPerCell;
}
std::int64_t last_ray(std::int64_t max, int hi) {
    return max < 0 ? -1 : std::min<std::int64_t>(max / kUnitsPerCell, hi);
}

void cross_triangle(const WholeMesh& mesh, const RayWindow& window, std::uint32_t index, std::vector<Crossing>& out) {
    const auto s = static_cast<std::size_t>(window.axis), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto& t = mesh.triangles[index];
    const Whole3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const std::int64_t whole = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    if (whole == 0) return;  // parallel to the ray: the moved ray misses it
    const auto [u_min, u_max] = std::minmax({a[u], b[u], c[u]});
    const auto [v_min, v_max] = std::minmax({a[v], b[v], c[v]});
    const auto [s_min, s_max] = std::minmax({a[s], b[s], c[s]});
    const std::int64_t u_first = first_ray(u_min, window.u_lo), u_last = last_ray(u_max, window.u_hi);
    const std::int64_t v_last = last_ray(v_max, window.v_hi);
    for (std::int64_t rv = first_ray(v_min, window.v_lo); rv <= v_last; ++rv) {
        for (std::int64_t ru = u_first; ru <= u_last; ++ru) {
            const std::int64_t pu = ru * kUnitsPerCell, pv = rv * kUnitsPerCell;
            const Side ab = side_of(a[u], a[v], b[u], b[v], pu, pv), bc = side_of(b[u], b[v], c[u], c[v], pu, pv),
                       ca = side_of(c[u], c[v], a[u], a[v], pu, pv);
            if (ab.left != bc.left || bc.left != ca.left) continue;
            const double depth = (static_cast<double>(bc.area) * static_cast<double>(a[s]) +
                                  static_cast<double>(ca.area) * static_cast<double>(b[s]) +
                                  static_cast<double>(ab.area) * static_cast<double>(c[s])) /
                                 static_cast<double>(whole);
            const auto number = static_cast<std::uint64_t>(rv - window.v_lo) * window.width() +
                                static_cast<std::uint64_t>(ru - window.u_lo);
            out.push_back(
                {static_cast<std::uint32_t>(number),
                 static_cast<std::int32_t>(std::clamp<std::int64_t>(std::llround(depth), s_min, s_max)), index,
                 // A triangle that is counter-clockwise seen from +s has its normal upwards: a ray going up leaves the
                 // material.
                 static_cast<std::int8_t>(ab.left ? -1 : 1)});
        }
    }
}

}  // namespace

std::vector<Crossing> sorted_crossings(const WholeMesh& mesh, const RayWindow& window, WorkerPool& pool) {
    const std::size_t triangles = mesh.triangles.size();
    const std::size_t chunks = std::min<std::size_t>(triangles, pool.threads() * 8u);
    std::vector<std::vector<Crossing>> found(chunks);
    pool.run(chunks, [&](std::size_t i) {
        for (std::size_t t = triangles * i / chunks; t < triangles * (i + 1) / chunks; ++t) {
            cross_triangle(mesh, window, static_cast<std::uint32_t>(t), found[i]);
        }
    });
    // Counting sort by ray, then a sort of each ray by depth.
    std::vector<std::uint32_t> first(window.rays() + 1, 0);
    for (const auto& chunk : found)
        for (const Crossing& c : chunk) ++first[c.ray + 1];
    for (std::size_t r = 1; r < first.size(); ++r) first[r] += first[r - 1];
    std::vector<Crossing> sorted(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& chunk : found)
        for (const Crossing& c : chunk) sorted[next[c.ray]++] = c;
    constexpr std::size_t kRaysATask = 4096;
    pool.run((window.rays() + kRaysATask - 1) / kRaysATask, [&](std::size_t i) {
        const std::size_t last = std::min(window.rays(), (i + 1) * kRaysATask);
        for (std::size_t r = i * kRaysATask; r < last; ++r) {
            std::sort(
                sorted.begin() + first[r], sorted.begin() + first[r + 1], [](const Crossing& a, const Crossing& b) {
                    return std::tuple(a.depth, -a.enters, a.triangle) < std::tuple(b.depth, -b.enters, b.triangle);
                });
        }
    });
    return sorted;
}

bool append_interval_bounds(std::span<const Crossing> crossings, bool by_parity, std::vector<Crossing>& bounds) {
    const std::size_t before = bounds.size();
    int winding = 0;
    for (const Crossing& c : crossings) {
        const int next = by_parity ? 1 - winding : winding + c.enters;
        const bool opens = winding <= 0 && next > 0, closes = winding > 0 && next <= 0;
        if (opens || closes) {
            // Drops an interval without thickness, or joins two that share an end.
            if (bounds.size() > before && bounds.back().depth == c.depth) {
                bounds.pop_back();
            } else {
                bounds.push_back(c);
            }
        }
        winding = next;
    }
    if ((bounds.size() - before) % 2 != 0) bounds.pop_back();
    return winding == 0;
}

}  // namespace burin::compute
