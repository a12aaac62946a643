// SPDX-License-Identifier: MIT
// What mesh_audit counts. Edges are undirected pairs of vertices; every count is over the whole file.
// Cost: O(t log t) for t triangles, about 200 bytes a triangle. One thread. Sources of the formulas: Euler-Poincare
// V - E + F = 2 (C - G) for closed orientable surfaces; volume by the divergence theorem.
#pragma once

#include <cstdint>
#include <optional>

#include "tests/tools/audited_file.hpp"

namespace mesh_audit {

struct Audit {
    std::uint64_t vertices = 0;              // that a triangle uses
    std::uint64_t unused_vertices = 0;       // in the file, but in no triangle
    std::uint64_t nonfinite_vertices = 0;    // with a NaN or an infinity
    std::uint64_t triangles = 0;             // all of the file
    std::uint64_t edges = 0;                 // of the triangles with three different corners
    std::uint64_t open_edges = 0;            // one triangle
    std::uint64_t nonmanifold_edges = 0;     // three or more
    std::uint64_t misoriented_edges = 0;     // two, that run along it in the same direction
    std::uint64_t nonmanifold_vertices = 0;  // whose triangles are not one fan, open or closed
    std::uint64_t repeated_corners = 0;      // triangles with a corner twice; they bound nothing and take no other part
    std::uint64_t zero_area_triangles = 0;   // with three different corners on one line, exactly
    std::uint64_t components = 0;            // triangles connected through edges
    std::int64_t euler_characteristic = 0;   // vertices - edges + triangles with three different corners
    std::optional<std::int64_t> genus;       // summed over components; only of a closed, oriented two-manifold
    double volume = 0;                       // signed: positive when triangles are counter-clockwise from outside
    double area = 0;
    Point lo, hi;  // bounding box of the used vertices

    [[nodiscard]] bool closed_and_oriented() const {
        return open_edges == 0 && nonmanifold_edges == 0 && misoriented_edges == 0 && nonfinite_vertices == 0;
    }
};

[[nodiscard]] Audit audit(const Mesh& mesh);

}  // namespace mesh_audit
