// SPDX-License-Identifier: MIT
#include "geometry/mesh/mesh_repair.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/polygon.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::geometry {
namespace {

// The state that fillings need of the mesh around them; grows with every filling.
class HoleFiller {
public:
    HoleFiller(TriangleMesh& mesh, std::span<const EdgeUse> uses) : mesh_(mesh) {
        taken_.reserve(uses.size() / 2);
        for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
            taken_.insert(edge[0].key);
            if (edge.size() % 2 != 0) rim_material_.emplace(edge[0].key, material_of(edge[0].triangle));
        });
    }

    ClosedHole fill(const HoleLoop& loop) {
        ClosedHole hole;
        hole.edges = loop.vertices.size();
        for (std::size_t i = 0; i < loop.vertices.size(); ++i)
            hole.perimeter_m += glm::distance(point(loop, i), point(loop, i + 1));
        const std::uint8_t material = rim_material(loop);
        std::vector<VertexTriple> triangles = triangulate(loop, hole.filling);
        for (const VertexTriple& t : triangles) add(t, material, hole);
        return hole;
    }

    [[nodiscard]] std::size_t vertices_added() const { return vertices_added_; }

private:
    const Vec3& point(const HoleLoop& loop, std::size_t i) const {
        return mesh_.positions_m[loop.vertices[i % loop.vertices.size()]];
    }

    std::uint8_t material_of(std::uint32_t triangle) const {
        return mesh_.triangle_materials.empty() ? std::uint8_t{0} : mesh_.triangle_materials[triangle];
    }

    // Returns the most frequent material; the lowest number among equals.
    std::uint8_t rim_material(const HoleLoop& loop) const {
        std::array<std::size_t, 256> votes{};
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            ++votes[rim_material_.at(edge_key(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]))];
        }
        return static_cast<std::uint8_t>(std::ranges::max_element(votes) - votes.begin());
    }

    std::vector<VertexTriple> triangulate(const HoleLoop& loop, HoleFilling& filling) {
        std::vector<Vec3> corners;
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) corners.push_back(point(loop, i));
        std::optional<std::vector<VertexTriple>> split;
        if (corners.size() <= kLeastAreaEdges) {
            filling = HoleFilling::least_area;
            split = least_area_triangulation(corners, [&](std::size_t i, std::size_t j) {
                return !taken_.contains(edge_key(loop.vertices[i], loop.vertices[j]));
            });
        } else if (SplitPolygon flat = split_polygon(corners); flat.how != PolygonSplit::crossing) {
            filling = HoleFilling::flat;
            split = std::move(flat.triangles);
            if (reuses_an_edge(loop, *split)) split.reset();
        }
        if (!split) {
            filling = HoleFilling::centre_fan;
            return centre_fan(loop, corners);
        }
        for (VertexTriple& t : *split) {
            for (std::uint32_t& v : t) v = loop.vertices[v];
        }
        return std::move(*split);
    }

    // Tells whether a diagonal is already an edge of the mesh, which would then have four uses.
    bool reuses_an_edge(const HoleLoop& loop, const std::vector<VertexTriple>& split) const {
        const std::size_t n = loop.vertices.size();
        return std::ranges::any_of(split, [&](const VertexTriple& t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = t[k], j = t[(k + 1) % 3];
                const bool on_rim = (i + 1) % n == j || (j + 1) % n == i;
                if (!on_rim && taken_.contains(edge_key(loop.vertices[i], loop.vertices[j]))) return true;
            }
            return false;
        });
    }

    std::vector<VertexTriple> centre_fan(const HoleLoop& loop, const std::vector<Vec3>& corners) {
        const auto n = static_cast<double>(corners.size());
        const auto centre = static_cast<std::uint32_t>(mesh_.positions_m.size());
        mesh_.positions_m.push_back(std::accumulate(corners.begin(), corners.end(), Vec3(0.0)) / n);
        ++vertices_added_;
        if (!mesh_.colours.empty()) mesh_.colours.push_back(mesh_.colours[loop.vertices[0]]);
        std::vector<VertexTriple> triangles;
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            triangles.push_back({loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()], centre});
        }
        return triangles;
    }

    void add(const VertexTriple& t, std::uint8_t material, ClosedHole& hole) {
        const Vec3 &a = mesh_.positions_m[t[0]], &b = mesh_.positions_m[t[1]], &c = mesh_.positions_m[t[2]];
        hole.area_added_m2 += glm::length(glm::cross(b - a, c - a)) / 2.0;
        ++hole.triangles_added;
        for (std::size_t k = 0; k < 3; ++k) taken_.insert(edge_key(t[k], t[(k + 1) % 3]));
        mesh_.triangles.push_back(t);
        if (!mesh_.triangle_materials.empty()) mesh_.triangle_materials.push_back(material);
    }

    TriangleMesh& mesh_;
    std::unordered_set<std::uint64_t> taken_;  // keys of the edges in use
    std::unordered_map<std::uint64_t, std::uint8_t> rim_material_;
    std::size_t vertices_added_ = 0;
};

}  // namespace

WeldReport weld_vertices(TriangleMesh& mesh) {
    std::vector<Vec3> kept;
    std::vector<std::array<std::uint8_t, 3>> colours;
    std::vector<std::uint32_t> number(mesh.positions_m.size());
    VertexWeld weld(kept);
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
        const std::size_t before = kept.size();
        number[v] = weld.index_of(mesh.positions_m[v]);
        if (kept.size() > before && !mesh.colours.empty()) colours.push_back(mesh.colours[v]);
    }
    for (VertexTriple& t : mesh.triangles) {
        for (std::uint32_t& v : t) v = number[v];
    }
    const WeldReport report{mesh.positions_m.size() - kept.size()};
    mesh.positions_m = std::move(kept);
    mesh.colours = std::move(colours);
    return report;
}

ClosingReport close_holes(TriangleMesh& mesh) {
    ClosingReport report;
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
    HoleFiller filler(mesh, uses);
    for (const HoleLoop& loop : hole_loops(uses)) {
        report.holes.push_back(filler.fill(loop));
        report.triangles_added += report.holes.back().triangles_added;
    }
    report.vertices_added = filler.vertices_added();
    return report;
}

}  // namespace burin::geometry
