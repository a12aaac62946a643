// SPDX-License-Identifier: MIT
#include "compute/tools/mesh_tool.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/try.hpp"
#include "compute/rays/normal_code.hpp"
#include "compute/rays/ray_crossings.hpp"
#include "compute/rays/set_algebra.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;

constexpr double kLargestMeshReach = 1 << 24;  // lattice units, as for balls: 4096 cells
constexpr double kMostPairs = 400'000'000;

// The surfaces swept by all moves, as one mesh with a normal code for each triangle.
struct Swept {
    std::vector<Whole3> vertices;
    std::vector<geometry::VertexTriple> triangles;
    std::vector<std::uint32_t> normals;

    void add(const geometry::VertexTriple& triangle, std::uint32_t normal) {
        triangles.push_back(triangle);
        normals.push_back(normal);
    }
};

Whole3 whole(const Vec3& p) { return {std::llround(p.x), std::llround(p.y), std::llround(p.z)}; }
Vec3 real(const Whole3& p) { return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}; }

class MoveAdder {
public:
    MoveAdder(const MeshTool& tool, const Lattice& lattice, Swept& swept)
        : tool_(tool), lattice_(lattice), swept_(swept) {}

    void add(const StraightMove& move) {
        const Whole3 along = whole(move.along);
        moves_ = along != Whole3{0, 0, 0};
        direction_ = real(along);
        pose(move, along);
        const std::vector<geometry::VertexTriple>& triangles = tool_.mesh->triangles;
        forward_.assign(triangles.size(), false);
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const geometry::VertexTriple& v = triangles[t];
            const Vec3 &a = posed_[v[0]], &b = posed_[v[1]], &c = posed_[v[2]];
            const Vec3 normal = glm::cross(b - a, c - a);
            forward_[t] = moves_ && glm::dot(normal, direction_) > 0.0;
            const std::uint32_t shift = first_ + (forward_[t] ? ahead_ : 0);
            swept_.add({v[0] + shift, v[1] + shift, v[2] + shift}, normal_code(normal));
        }
        if (moves_)
            geometry::for_each_edge(tool_.edges->uses,
                                    [&](std::span<const geometry::EdgeUse> edge) { add_strips(edge); });
    }

private:
    // Appends the vertices at the start and, if the tool moves, those at the end after them.
    void pose(const StraightMove& move, const Whole3& along) {
        const std::vector<Vec3>& positions = tool_.mesh->positions_m;
        first_ = static_cast<std::uint32_t>(swept_.vertices.size());
        ahead_ = static_cast<std::uint32_t>(positions.size());
        posed_.resize(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            posed_[i] = move.orientation * (positions[i] / lattice_.unit_m());
            // Computed as in scan conversion, so that an unturned mesh gets the same vertices.
            swept_.vertices.push_back(
                whole(lattice_.units_from_object(move.start_object_m + move.orientation * positions[i])));
        }
        for (std::size_t i = 0; i < positions.size() && moves_; ++i) {
            const Whole3 p = swept_.vertices[first_ + i];
            swept_.vertices.push_back({p[0] + along[0], p[1] + along[1], p[2] + along[2]});
        }
    }

    // Adds the strips between the start and the end of an edge. Their number is the difference between the forward
    // triangles that use the edge in one direction and those that use it in the other.
    void add_strips(std::span<const geometry::EdgeUse> edge) {
        int strips = 0;
        for (const geometry::EdgeUse& use : edge) strips += forward_[use.triangle] ? (use.upwards ? 1 : -1) : 0;
        if (strips == 0) return;
        std::uint32_t a = geometry::lower_vertex(edge.front().key), b = geometry::higher_vertex(edge.front().key);
        if (strips < 0) std::swap(a, b);
        const std::uint32_t normal = normal_code(glm::cross(posed_[b] - posed_[a], direction_));
        a += first_;
        b += first_;
        for (int i = 0; i < std::abs(strips); ++i) {
            swept_.add({a, b, b + ahead_}, normal);
            swept_.add({a, b + ahead_, a + ahead_}, normal);
        }
    }

    const MeshTool& tool_;
    const Lattice& lattice_;
    Swept& swept_;
    bool moves_ = false;
    Vec3 direction_{0.0};
    std::vector<Vec3> posed_;  // without the move's translation, so that differences keep their precision
    std::vector<bool> forward_;
    std::uint32_t first_ = 0, ahead_ = 0;
};

RayWindow window_around(const Lattice& lattice, std::span<const Whole3> vertices, int axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
    const auto range = [&](std::size_t a, int last, int& lo, int& hi) {
        const auto [least, most] = std::ranges::minmax(vertices, {}, [a](const Whole3& p) { return p[a]; });
        lo = static_cast<int>(std::clamp<std::int64_t>(least[a] / kUnitsPerCell, 0, last + 1));
        hi = most[a] < 0 ? -1 : static_cast<int>(std::min<std::int64_t>(most[a] / kUnitsPerCell, last));
    };
    RayWindow window{axis, 0, -1, 0, -1};
    if (vertices.empty()) return window;
    range(u, lattice.rays_u(axis) - 1, window.u_lo, window.u_hi);
    range(v, lattice.rays_v(axis) - 1, window.v_lo, window.v_hi);
    return window;
}

// Appends the ends of one ray's intervals, clipped to the lattice.
void append_ends(const Swept& swept, std::span<const Crossing> bounds, int axis, int deepest, std::uint8_t material,
                 std::vector<DexelEnd>& ends) {
    Vec3 e(0.0);
    e[axis] = 1.0;
    for (std::size_t i = 0; i + 1 < bounds.size(); i += 2) {
        const int lo = std::max(bounds[i].depth, 0), hi = std::min(bounds[i + 1].depth, deepest);
        if (lo >= hi) continue;
        const auto normal = [&](const Crossing& c, int depth, const Vec3& border) {
            return depth == c.depth ? swept.normals[c.triangle] : normal_code(border);
        };
        ends.push_back(shared::make_end(lo, material, normal(bounds[i], lo, -e)));
        ends.push_back(shared::make_end(hi, material, normal(bounds[i + 1], hi, e)));
    }
}

void append_axis(const Lattice& lattice, const Swept& swept, int axis, std::uint8_t material, WorkerPool& pool,
                 RayBatch& batch) {
    const RayWindow window = window_around(lattice, swept.vertices, axis);
    if (window.empty()) return;
    const auto crossings = sorted_crossings({swept.vertices, swept.triangles}, window, pool);
    const int deepest = lattice.cells[static_cast<std::size_t>(axis)] * kUnitsPerCell;
    std::vector<Crossing> bounds;
    std::vector<DexelEnd> ends;
    for (std::size_t from = 0; from < crossings.size();) {
        const std::span<const Crossing> ray = ray_at(crossings, from);
        from += ray.size();
        bounds.clear();
        ends.clear();
        append_interval_bounds(ray, false, bounds);
        append_ends(swept, bounds, axis, deepest, material, ends);
        if (ends.empty()) continue;
        const auto row = static_cast<std::size_t>(ray.front().ray) / window.width();
        const auto place = static_cast<std::size_t>(ray.front().ray) % window.width();
        batch.add(shared::ray_code(axis, window.u_lo + static_cast<int>(place), window.v_lo + static_cast<int>(row)),
                  ends);
    }
}

// Returns the union of two batches, which are both ordered by axis, row v and position u.
RayBatch united(const RayBatch& a, const RayBatch& b) {
    const auto order = [](const RayBatch::Ray& ray) {
        const RayPlace p = place_of(ray.code);
        return std::tuple(p.axis, p.v, p.u);
    };
    RayBatch both;
    std::vector<DexelEnd> ends;
    for (std::size_t i = 0, j = 0; i < a.rays.size() || j < b.rays.size();) {
        const bool takes_a = j == b.rays.size() || (i < a.rays.size() && order(a.rays[i]) <= order(b.rays[j]));
        const bool takes_b = i == a.rays.size() || (j < b.rays.size() && order(b.rays[j]) <= order(a.rays[i]));
        const std::uint32_t code = takes_a ? a.rays[i].code : b.rays[j].code;
        ends.clear();
        append_union(takes_a ? a.ends_of(a.rays[i]) : RayEnds{}, takes_b ? b.ends_of(b.rays[j]) : RayEnds{}, ends);
        both.add(code, ends);
        i += takes_a ? 1 : 0;
        j += takes_b ? 1 : 0;
    }
    return both;
}

// Returns the mesh without the vertices that no triangle uses: they must not enlarge footprints and need not be posed.
std::shared_ptr<const geometry::TriangleMesh> without_strays(std::shared_ptr<const geometry::TriangleMesh> mesh) {
    constexpr std::uint32_t kUnused = 0xffffffff;
    std::vector<std::uint32_t> place(mesh->positions_m.size(), kUnused);
    geometry::TriangleMesh kept;
    for (const geometry::VertexTriple& t : mesh->triangles) {
        geometry::VertexTriple moved{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (place[t[k]] == kUnused) {
                place[t[k]] = static_cast<std::uint32_t>(kept.positions_m.size());
                kept.positions_m.push_back(mesh->positions_m[t[k]]);
            }
            moved[k] = place[t[k]];
        }
        kept.triangles.push_back(moved);
    }
    if (kept.positions_m.size() == mesh->positions_m.size()) return mesh;
    return std::make_shared<const geometry::TriangleMesh>(std::move(kept));
}

double six_volumes(const geometry::TriangleMesh& mesh, const Vec3& middle) {
    double sum = 0.0;
    for (const geometry::VertexTriple& t : mesh.triangles) {
        const Vec3 a = mesh.positions_m[t[0]] - middle, b = mesh.positions_m[t[1]] - middle,
                   c = mesh.positions_m[t[2]] - middle;
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum;
}

}  // namespace

Result<MeshTool> prepare_mesh_tool(std::shared_ptr<const geometry::TriangleMesh> mesh) {
    if (mesh == nullptr || mesh->triangles.empty()) {
        return fail("tool mesh", "has no triangles", "give a mesh with a closed surface");
    }
    Box bounds;
    for (const geometry::VertexTriple& t : mesh->triangles) {
        for (const std::uint32_t i : t) {
            if (i >= mesh->positions_m.size()) {
                return fail("tool mesh", "has a triangle with a vertex that does not exist", "repair the file");
            }
            const Vec3& p = mesh->positions_m[i];
            if (!std::isfinite(p.x + p.y + p.z)) {
                return fail("tool mesh", "has a coordinate that is not finite", "repair the file");
            }
            bounds.include(p);
        }
    }
    mesh = without_strays(std::move(mesh));
    auto edges = std::make_shared<MeshToolEdges>();
    edges->uses = geometry::edge_uses(mesh->triangles);
    bool open = false, mixed = false;
    geometry::for_each_edge(edges->uses, [&](std::span<const geometry::EdgeUse> edge) {
        open = open || edge.size() % 2 != 0;
        mixed = mixed || geometry::imbalance(edge) != 0;
    });
    if (open) return fail("tool mesh", "has holes, so inside and outside are not defined", "close it in a mesh editor");
    if (mixed) return fail("tool mesh", "is not turned outwards everywhere", "orient its triangles consistently");
    edges->middle_m = bounds.center();
    if (!(six_volumes(*mesh, edges->middle_m) > 0.0)) {
        return fail("tool mesh", "encloses nothing, or is inside out", "turn its triangles outwards");
    }
    for (const geometry::VertexTriple& t : mesh->triangles) {
        for (const std::uint32_t i : t) {
            const Vec3 from_middle = mesh->positions_m[i] - edges->middle_m;
            edges->radius_m = std::max(edges->radius_m, std::sqrt(glm::dot(from_middle, from_middle)));
        }
    }
    return MeshTool{std::move(mesh), std::move(edges)};
}

Result<Extent> extent_of(const MeshTool& tool, double unit_m) {
    const Extent extent{tool.edges->middle_m / unit_m, tool.edges->radius_m / unit_m, false};
    // A vertex far from the tool's origin would lose precision and leave the range of the exact arithmetic.
    if (std::sqrt(glm::dot(extent.middle, extent.middle)) + extent.radius <= kLargestMeshReach) return extent;
    return fail("tool mesh", "is too large for the workpiece, or lies too far from its own origin",
                "bring it within 4096 lattice cells of its origin (burin convert IN OUT.obj --center, --scale F)");
}

Result<void> check_effort(const MeshTool& tool, std::span<const StraightMove> moves) {
    if (static_cast<double>(moves.size()) * static_cast<double>(tool.mesh->triangles.size()) <= kMostPairs) return {};
    return fail("tool mesh", "has too many triangles for a motion that must be split so often",
                "raise --sweep-tolerance, give the stroke more rows, or simplify the mesh");
}

Result<RayBatch> mesh_spans(const Lattice& lattice, const MeshTool& tool, std::span<const StraightMove> moves,
                            std::uint8_t material, WorkerPool& pool, std::size_t triangles_at_once) {
    BURIN_TRY_DO(check_effort(tool, moves));
    const std::size_t at_once = std::max<std::size_t>(1, triangles_at_once / tool.mesh->triangles.size());
    RayBatch all;
    for (std::size_t from = 0; from < moves.size(); from += at_once) {
        Swept swept;
        MoveAdder adder(tool, lattice, swept);
        for (const StraightMove& move : moves.subspan(from, std::min(at_once, moves.size() - from))) adder.add(move);
        RayBatch batch;
        for (int axis = 0; axis < 3; ++axis) append_axis(lattice, swept, axis, material, pool, batch);
        all = from == 0 ? std::move(batch) : united(all, batch);
    }
    return all;
}

}  // namespace burin::compute
