// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "base/text.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"

namespace burin::geometry {
namespace {

// Finer cells than this share of the largest coordinate would not fit 64 bits.
constexpr double kFinestCell = 0x1p-48;

std::vector<std::uint32_t> vertices_of_open_edges(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> vertices;
    for_each_edge(edge_uses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
        if (edge.size() % 2 == 0) return;
        vertices.push_back(lower_vertex(edge[0].key));
        vertices.push_back(higher_vertex(edge[0].key));
    });
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// Vertices in cells as wide as the tolerance: whatever lies within it is in one of the 27 cells around.
class CellsOfVertices {
public:
    CellsOfVertices(const std::vector<Vec3>& positions, double tolerance, double cell)
        : positions_(positions), tolerance_(tolerance), cell_(cell) {}

    [[nodiscard]] std::optional<std::uint32_t> nearest(std::uint32_t vertex) const {
        std::optional<std::uint32_t> best;
        double best_distance = tolerance_;
        const Cell home = cell_of(vertex);
        for (int i = 0; i < 27; ++i) {
            const auto found = vertices_.find({home[0] + i % 3 - 1, home[1] + i / 3 % 3 - 1, home[2] + i / 9 - 1});
            if (found == vertices_.end()) continue;
            for (const std::uint32_t other : found->second) {
                const double distance = glm::distance(positions_[vertex], positions_[other]);
                if (distance > best_distance || (best && distance == best_distance && other > *best)) continue;
                best = other;
                best_distance = distance;
            }
        }
        return best;
    }
    void add(std::uint32_t vertex) { vertices_[cell_of(vertex)].push_back(vertex); }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t h = 0;
            for (const std::int64_t c : cell)
                h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
            return h;
        }
    };
    [[nodiscard]] Cell cell_of(std::uint32_t vertex) const {
        Cell cell;
        for (int k = 0; k < 3; ++k)
            cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(positions_[vertex][k] / cell_));
        return cell;
    }

    const std::vector<Vec3>& positions_;
    const double tolerance_, cell_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> vertices_;
};

void drop_folded(TriangleMesh& mesh, const std::vector<std::uint32_t>& joined_to, JoinReport& report) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const VertexTriple before = mesh.triangles[t];
        const VertexTriple now{joined_to[before[0]], joined_to[before[1]], joined_to[before[2]]};
        if (names_a_vertex_twice(now) && !names_a_vertex_twice(before)) continue;
        mesh.triangles[kept] = now;
        if (!mesh.triangle_materials.empty()) mesh.triangle_materials[kept] = mesh.triangle_materials[t];
        ++kept;
    }
    report.triangles_dropped = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    if (!mesh.triangle_materials.empty()) mesh.triangle_materials.resize(kept);
}

// Tells whether a mesh is closed and, on average, thicker than that: walls that are no thicker were pressed together.
bool is_thicker_than(double least_m, TriangleMesh& mesh) {
    if (!vertices_of_open_edges(mesh).empty()) return false;
    orient_outward(mesh);
    const MeshHealth health = examine(mesh);
    return 2.0 * health.signed_volume_m3 > least_m * health.area_m2;
}

}  // namespace

JoinReport join_open_edges(TriangleMesh& mesh, double tolerance_m) {
    JoinReport report;
    const std::vector<std::uint32_t> open = vertices_of_open_edges(mesh);
    if (open.empty() || !(tolerance_m > 0.0)) return report;
    double largest_m = 0.0;
    for (const std::uint32_t v : open) {
        const Vec3 p = glm::abs(mesh.positions_m[v]);
        largest_m = std::max({largest_m, p.x, p.y, p.z});
    }
    CellsOfVertices kept(mesh.positions_m, tolerance_m, std::max(tolerance_m, kFinestCell * largest_m));
    std::vector<std::uint32_t> joined_to(mesh.positions_m.size());
    for (std::uint32_t v = 0; v < joined_to.size(); ++v) joined_to[v] = v;
    for (const std::uint32_t v : open) {
        const auto other = kept.nearest(v);
        if (!other) {
            kept.add(v);
            continue;
        }
        joined_to[v] = *other;
        ++report.vertices_joined;
        report.farthest_m = std::max(report.farthest_m, glm::distance(mesh.positions_m[v], mesh.positions_m[*other]));
    }
    if (report.vertices_joined > 0) drop_folded(mesh, joined_to, report);
    return report;
}

std::string in_words(const JoinReport& joined) {
    if (joined.vertices_joined == 0) return "";
    std::string text =
        formatted("%zu corners up to %.2g mm apart were joined", joined.vertices_joined, 1e3 * joined.farthest_m);
    if (joined.triangles_dropped > 0)
        text += formatted(", and %zu triangles without area dropped", joined.triangles_dropped);
    return text;
}

std::optional<double> tolerance_that_closes_m(const TriangleMesh& mesh) {
    Box bounds;
    for (const VertexTriple& t : mesh.triangles) {
        for (const std::uint32_t v : t) bounds.include(mesh.positions_m[v]);
    }
    if (bounds.empty()) return std::nullopt;
    const Vec3 size_m = bounds.extent();
    // Rounded to a power of ten, so that it is short to type.
    const double power = std::floor(std::log10(std::max({size_m.x, size_m.y, size_m.z})));
    for (double below = 6.0; below >= 3.0; below -= 1.0) {
        const double tolerance_m = std::pow(10.0, power - below);
        TriangleMesh joined = mesh;
        if (join_open_edges(joined, tolerance_m).vertices_joined > 0 && is_thicker_than(tolerance_m, joined))
            return tolerance_m;
    }
    return std::nullopt;
}

}  // namespace burin::geometry
