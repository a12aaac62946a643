// SPDX-License-Identifier: MIT
#include "geometry/mesh/mesh_health.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {
namespace {

bool degenerate(const TriangleMesh& mesh, const VertexTriple& t) {
    if (names_a_vertex_twice(t)) return true;
    const Vec3 ab = mesh.positions_m[t[1]] - mesh.positions_m[t[0]];
    const Vec3 bc = mesh.positions_m[t[2]] - mesh.positions_m[t[1]];
    const Vec3 ca = mesh.positions_m[t[0]] - mesh.positions_m[t[2]];
    const double longest_squared = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    return !(glm::length(glm::cross(ab, bc)) > kDegenerateHeight * longest_squared);
}

void count_vertices(const TriangleMesh& mesh, MeshHealth& health) {
    std::vector<bool> used(mesh.positions_m.size());
    for (const VertexTriple& t : mesh.triangles) {
        for (const std::uint32_t v : t) used[v] = true;
    }
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (used[v]) {
            health.bounds_m.include(mesh.positions_m[v]);
        } else {
            ++health.unused_vertices;
        }
    }
}

void measure(const TriangleMesh& mesh, MeshHealth& health) {
    // Computes about the centre, so that a mesh far from the origin keeps its precision.
    const Vec3 centre = health.bounds_m.empty() ? Vec3(0.0) : health.bounds_m.center();
    for (const VertexTriple& t : mesh.triangles) {
        if (degenerate(mesh, t)) ++health.degenerate_triangles;
        const Vec3 a = mesh.positions_m[t[0]] - centre, b = mesh.positions_m[t[1]] - centre,
                   c = mesh.positions_m[t[2]] - centre;
        health.area_m2 += glm::length(glm::cross(b - a, c - a)) / 2.0;
        health.signed_volume_m3 += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
}

// Counts triangles that repeat an earlier one. Equal triangles share their first edge, so it is enough to compare the
// uses of one edge with each other. Triangles that name a vertex twice have no edges and are compared separately.
std::size_t duplicates(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
    std::size_t count = 0;
    std::vector<std::uint32_t> opposite;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() < 2) return;
        opposite.clear();
        for (const EdgeUse& use : edge) {
            const std::uint32_t v = mesh.triangles[use.triangle][(use.corner + 2u) % 3u];
            // Each triangle has three edges; it is counted at the one between its two lowest vertices.
            if (v > higher_vertex(use.key)) opposite.push_back(v);
        }
        std::ranges::sort(opposite);
        for (std::size_t i = 1; i < opposite.size(); ++i) count += opposite[i] == opposite[i - 1] ? 1 : 0;
    });
    std::vector<VertexTriple> edgeless;
    for (VertexTriple t : mesh.triangles) {
        if (!names_a_vertex_twice(t)) continue;
        std::ranges::sort(t);
        edgeless.push_back(t);
    }
    std::ranges::sort(edgeless);
    for (std::size_t i = 1; i < edgeless.size(); ++i) count += edgeless[i] == edgeless[i - 1] ? 1 : 0;
    return count;
}

void examine_edges(std::span<const EdgeUse> uses, MeshHealth& health) {
    bool even = true;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        ++health.edges;
        if (edge.size() == 1) ++health.boundary_edges;
        if (edge.size() > 2) ++health.nonmanifold_edges;
        if (std::abs(imbalance(edge)) > static_cast<std::ptrdiff_t>(edge.size() % 2)) ++health.misoriented_edges;
        even = even && edge.size() % 2 == 0;
    });
    health.holes = even ? 0 : hole_loops(uses).size();
    health.closed = even && health.edges > 0;
    health.consistently_oriented = health.misoriented_edges == 0;
}

void count_shells(const TriangleMesh& mesh, std::span<const EdgeUse> uses, MeshHealth& health) {
    DisjointSets shells(mesh.triangles.size());
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        for (const EdgeUse& use : edge) shells.unite(edge[0].triangle, use.triangle);
    });
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!names_a_vertex_twice(mesh.triangles[t]) && shells.set_of(t) == t) ++health.shells;
    }
}

// Joins the corners (3 triangle + k) that meet at the same vertex over an edge; a vertex whose corners remain in
// several sets joins fans that touch in a point only.
std::size_t nonmanifold_vertices(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
    DisjointSets fans(3 * mesh.triangles.size());
    const auto corner_at = [&](const EdgeUse& use, std::uint32_t vertex) {
        const std::uint32_t next = (use.corner + 1u) % 3u;
        return 3 * use.triangle + (mesh.triangles[use.triangle][use.corner] == vertex ? use.corner : next);
    };
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        for (const std::uint32_t v : {lower_vertex(edge[0].key), higher_vertex(edge[0].key)}) {
            for (const EdgeUse& use : edge) fans.unite(corner_at(edge[0], v), corner_at(use, v));
        }
    });
    std::vector<std::uint8_t> fans_at(mesh.positions_m.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (names_a_vertex_twice(mesh.triangles[t])) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (fans.set_of(3 * t + k) != 3 * t + k) continue;
            auto& count = fans_at[mesh.triangles[t][k]];
            if (count < 2) ++count;
        }
    }
    return static_cast<std::size_t>(std::ranges::count(fans_at, 2));
}

std::string number_of(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

}  // namespace

MeshHealth examine(const TriangleMesh& mesh) {
    MeshHealth health;
    health.vertices = mesh.positions_m.size();
    health.triangles = mesh.triangles.size();
    count_vertices(mesh, health);
    measure(mesh, health);
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
    health.duplicate_triangles = duplicates(mesh, uses);
    examine_edges(uses, health);
    count_shells(mesh, uses, health);
    health.nonmanifold_vertices = nonmanifold_vertices(mesh, uses);
    return health;
}

std::vector<std::string> complaints(const MeshHealth& health) {
    std::vector<std::string> list;
    if (health.triangles == 0) list.emplace_back("there are no triangles");
    if (health.boundary_edges > 0) {
        list.push_back(number_of(health.boundary_edges, "edge has", "edges have") + " only one triangle (" +
                       number_of(health.holes, "hole", "holes") + ")");
    }
    if (!health.closed && health.triangles > 0 && health.boundary_edges == 0) {
        list.push_back("the surface does not enclose a volume (" + number_of(health.holes, "loop", "loops") +
                       " of edges with an odd number of triangles)");
    }
    if (health.nonmanifold_edges > 0) {
        list.push_back(number_of(health.nonmanifold_edges, "edge has", "edges have") + " more than two triangles");
    }
    if (health.nonmanifold_vertices > 0) {
        list.push_back(number_of(health.nonmanifold_vertices, "vertex joins", "vertices join") +
                       " parts that share no edge");
    }
    if (health.misoriented_edges > 0) {
        list.push_back(number_of(health.misoriented_edges, "edge has", "edges have") +
                       " triangles of opposite orientation");
    }
    if (health.inside_out()) list.emplace_back("the surface is inside out");
    if (health.degenerate_triangles > 0) {
        list.push_back(number_of(health.degenerate_triangles, "triangle has", "triangles have") + " no area");
    }
    if (health.duplicate_triangles > 0) {
        list.push_back(number_of(health.duplicate_triangles, "triangle repeats another", "triangles repeat others"));
    }
    return list;
}

}  // namespace burin::geometry
