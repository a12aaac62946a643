// SPDX-License-Identifier: MIT
#include "compute/tile_mesher.hpp"

#include <algorithm>
#include <bit>

#include "compute/cell_table.hpp"
#include "compute/tile_samples.hpp"
#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

// Crossings whose normals are closer than this (cosine, about 41 degrees) belong to one smooth piece of surface.
constexpr float kSmooth = 0.75f;
// Across a change of material already a smaller angle (about 10 degrees) is an edge: the vertex lies on it, so each side can
// keep its own colour. Where the surface runs on smoothly the border lies anywhere in the cell, and the colours blend.
constexpr float kSmoothAcrossMaterials = 0.985f;

constexpr Local step(Local p, int axis, int by) {
    p[static_cast<std::size_t>(axis)] += by;
    return p;
}

constexpr Local between(const Local& from, const Local& to) {
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

std::uint32_t encode(const Vec3f& n) {
    const auto whole = [](float x) { return static_cast<std::int64_t>(x * 1048576.0f); };
    return shared::encode_normal({whole(n.x), whole(n.y), whole(n.z)});
}

// Which vertex the quad of each crossed edge of a cell uses.
struct CellVertices {
    std::array<std::uint32_t, 12> of_edge{};
};

class Mesher {
public:
    Mesher(const Solid& solid, const std::array<int, 3>& first_node, const TileSamples& samples, TileMesh& mesh)
        : solid_(solid), first_node_(first_node), samples_(samples), mesh_(mesh) {
        cell_slot_.fill(-1);
    }

    void run() {
        for (int axis = 0; axis < 3; ++axis) {
            for (int y = 0; y < kTileCells; ++y) {
                for (int x = 0; x < kTileCells; ++x) {
                    // Own nodes only: z = 0 .. kTileCells - 1 are bits 1 .. kTileCells.
                    std::uint32_t bits = samples_.crossed(axis, x, y) & (((1u << kTileCells) - 1u) << 1);
                    for (; bits != 0; bits &= bits - 1) quad(axis, {x, y, std::countr_zero(bits) - 1});
                }
            }
        }
    }

private:
    // The polygon around a crossed edge: the vertices of the four cells about it, and between two of them the extra vertex
    // of their common face where that is needed.
    void quad(int axis, const Local& node) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const EdgeSample& edge = samples_.sample(axis, node);
        if (edge.disagrees) ++mesh_.disagreeing_edges;
        // Counter-clockwise seen from the edge's upper end.
        constexpr int kDu[4] = {-1, 0, 0, -1}, kDv[4] = {-1, -1, 0, 0};
        std::array<std::uint32_t, 8> polygon{};
        std::size_t count = 0, extra = 8;
        for (std::size_t i = 0; i < 4; ++i) {
            const Local cell = step(step(node, u, kDu[i]), v, kDv[i]);
            polygon[count++] = vertices_of(cell).of_edge[static_cast<std::size_t>(cell_edge(axis, -kDu[i], -kDv[i]))];
            // Faces towards the next cell: +u, +v, -u, -v.
            const int face_axis = i % 2 == 0 ? u : v;
            const int side = i < 2 ? 1 : 0;
            const Local next = step(cell, face_axis, side == 1 ? 1 : -1);
            if (passed_twice(cell, next, face_axis, side)) {
                extra = count;
                polygon[count++] = face_vertex(axis, node, side == 1 ? next : cell, face_axis);
            }
        }
        const bool flip = !samples_.inside(node);  // the surface faces the lower end
        if (extra < 8) {
            fan(polygon, count, extra, flip);
        } else {
            two_triangles(polygon, flip, edge.normal);
        }
    }

    [[nodiscard]] bool passed_twice(const Local& cell, const Local& next, int face_axis, int side) const {
        const unsigned a = cell_table()[samples_.cell_pattern(cell)].twice_faces;
        const unsigned b = cell_table()[samples_.cell_pattern(next)].twice_faces;
        return (a >> cell_face(face_axis, side) & b >> cell_face(face_axis, 1 - side) & 1u) != 0;
    }

    // The extra vertex for the join of this edge on the lower face (normal face_axis) of `cell`: the middle between this
    // edge's crossing and that of the other edge around the same inside corner.
    std::uint32_t face_vertex(int axis, const Local& node, const Local& cell, int face_axis) {
        const Local corner = samples_.inside(node) ? node : step(node, axis, 1);
        const int other = 3 - axis - face_axis;
        const auto o = static_cast<std::size_t>(other);
        const Local other_node = cell[o] < corner[o] ? step(corner, other, -1) : corner;
        const EdgeSample& a = samples_.sample(axis, node);
        const EdgeSample& b = samples_.sample(other, other_node);
        // Symmetric in a and b, so that both quads, in whatever tiles, compute the same bits.
        const Vec3f in_cell =
            (point_on(axis, between(cell, node), a) + point_on(other, between(cell, other_node), b)) * 0.5f;
        const auto pair_axis = static_cast<std::size_t>((face_axis + 1) % 3);
        const int pair = corner[pair_axis] - cell[pair_axis];
        mesh_.keys.push_back(key(cell, 4 + 2 * face_axis + pair));
        mesh_.vertices.push_back(vertex(cell, in_cell, a.normal + b.normal, mixed({a.material, b.material})));
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    [[nodiscard]] static Vec3f point_on(int axis, const Local& node, const EdgeSample& sample) {
        Vec3f p(static_cast<float>(node[0]), static_cast<float>(node[1]), static_cast<float>(node[2]));
        p[axis] += sample.along;
        return p;
    }

    const CellVertices& vertices_of(const Local& cell) {
        std::int16_t& slot =
            cell_slot_[static_cast<std::size_t>(((cell[2] + 1) * kCells + cell[1] + 1) * kCells + cell[0] + 1)];
        if (slot < 0) {
            slot = static_cast<std::int16_t>(cells_.size());
            cells_.push_back(make_vertices(cell));
        }
        return cells_[static_cast<std::size_t>(slot)];
    }

    CellVertices make_vertices(const Local& cell) {
        const CellCase& cell_case = cell_table()[samples_.cell_pattern(cell)];
        CellVertices result;
        for (int loop = 0; loop < cell_case.loops; ++loop) make_loop(cell, cell_case, loop, result);
        return result;
    }

    // One position for the loop, and a vertex there for each smooth piece of surface that meets in it.
    void make_loop(const Local& cell, const CellCase& cell_case, int loop, CellVertices& result) {
        struct Piece {
            Vec3f first_normal{0.0f}, normal_sum{0.0f};
            std::uint8_t first_material = 0;
            std::array<std::uint32_t, 4> colour_sum{};  // red, green, blue, how many
        };
        std::array<Crossing, 12> crossings;
        std::array<std::size_t, 12> edge_of_crossing{}, piece_of_crossing{};
        std::array<Piece, 12> pieces;
        std::size_t count = 0, piece_count = 0;
        for (std::size_t e = 0; e < 12; ++e) {
            if (cell_case.loop_of_edge[e] != loop) continue;
            const int axis = static_cast<int>(e) / 4, o1 = static_cast<int>(e) & 1, o2 = static_cast<int>(e) >> 1 & 1;
            const Local offset = step(step(Local{0, 0, 0}, (axis + 1) % 3, o1), (axis + 2) % 3, o2);
            const EdgeSample& s =
                samples_.sample(axis, {cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2]});
            crossings[count] = {point_on(axis, offset, s), s.normal};
            edge_of_crossing[count] = e;
            std::size_t p = 0;
            const auto belongs = [&](const Piece& piece) {
                const float least = piece.first_material == s.material ? kSmooth : kSmoothAcrossMaterials;
                return glm::dot(piece.first_normal, s.normal) >= least;
            };
            while (p < piece_count && !belongs(pieces[p])) ++p;
            if (p == piece_count) {
                pieces[p].first_normal = s.normal;
                pieces[p].first_material = s.material;
                ++piece_count;
            }
            pieces[p].normal_sum += s.normal;
            const auto& colour = solid_.materials[s.material].colour;
            for (std::size_t c = 0; c < 3; ++c) pieces[p].colour_sum[c] += colour[c];
            ++pieces[p].colour_sum[3];
            piece_of_crossing[count++] = p;
        }
        const Vec3f in_cell = feature_point({crossings.data(), count});
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::size_t p = 0; p < piece_count; ++p) {
            const auto& sum = pieces[p].colour_sum;
            const auto channel = [&](std::size_t c) { return (sum[c] + sum[3] / 2) / sum[3]; };
            mesh_.keys.push_back(key(cell, loop));
            mesh_.vertices.push_back(vertex(cell, in_cell, pieces[p].normal_sum,
                                            channel(0) | channel(1) << 8 | channel(2) << 16 | 0xff000000u));
        }
        for (std::size_t i = 0; i < count; ++i) {
            result.of_edge[edge_of_crossing[i]] = first + static_cast<std::uint32_t>(piece_of_crossing[i]);
        }
    }

    [[nodiscard]] std::uint32_t mixed(std::array<std::uint8_t, 2> materials) const {
        std::uint32_t colour = 0xff000000u;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t sum =
                1u + solid_.materials[materials[0]].colour[c] + solid_.materials[materials[1]].colour[c];
            colour |= (sum / 2) << (8 * c);
        }
        return colour;
    }

    // `in_cell` is in cells from the cell's lowest corner. The whole cells are counted from the lattice's origin and not
    // from the tile's, so that every tile that shares the vertex rounds it to the same bits.
    [[nodiscard]] shared::SurfaceVertex vertex(const Local& cell, const Vec3f& in_cell, const Vec3f& normal,
                                               std::uint32_t colour) const {
        const auto metres = [&](int a) {
            const auto k = static_cast<std::size_t>(a);
            return static_cast<float>((static_cast<double>(in_cell[a]) + (cell[k] + first_node_[k])) *
                                      solid_.lattice.spacing_m);
        };
        return {metres(0), metres(1), metres(2),
                encode(glm::length(normal) > 1e-6f ? glm::normalize(normal) : Vec3f(0, 0, 1)), colour};
    }

    [[nodiscard]] std::uint64_t key(const Local& cell, int slot) const {
        std::uint64_t k = 0;
        for (std::size_t a = 3; a-- > 0;) {
            // Cell -1 of the lattice exists (it is empty): count from there.
            k = k * static_cast<std::uint64_t>(solid_.lattice.cells[a] + 2) +
                static_cast<std::uint64_t>(cell[a] + first_node_[a] + 1);
        }
        return k * 16 + static_cast<std::uint64_t>(slot);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flip) {
        mesh_.indices.insert(mesh_.indices.end(), {a, flip ? c : b, flip ? b : c});
    }

    // From the extra vertex: no diagonal of this fan can be an edge of another polygon.
    void fan(const std::array<std::uint32_t, 8>& polygon, std::size_t count, std::size_t apex, bool flip) {
        for (std::size_t i = 1; i + 1 < count; ++i) {
            triangle(polygon[apex], polygon[(apex + i) % count], polygon[(apex + i + 1) % count], flip);
        }
    }

    // Along the diagonal that turns the two triangles less away from the surface normal.
    void two_triangles(const std::array<std::uint32_t, 8>& q, bool flip, const Vec3f& surface_normal) {
        std::array<Vec3f, 4> p;  // in cells, so that a workpiece of a micrometre does not underflow
        const shared::SurfaceVertex& origin = mesh_.vertices[q[0]];
        const auto cells_per_m = static_cast<float>(1.0 / solid_.lattice.spacing_m);
        for (std::size_t i = 0; i < 4; ++i) {
            const shared::SurfaceVertex& v = mesh_.vertices[q[i]];
            p[i] = Vec3f(v.x - origin.x, v.y - origin.y, v.z - origin.z) * cells_per_m;
        }
        const float sign = flip ? -1.0f : 1.0f;
        const auto facing = [&](std::size_t a, std::size_t b, std::size_t c) {
            const Vec3f n = glm::cross(p[b] - p[a], p[c] - p[a]);
            const float length = glm::length(n);
            return length > 0.0f ? sign * glm::dot(n, surface_normal) / length : -1.0f;
        };
        const float across02 = std::min(facing(0, 1, 2), facing(0, 2, 3));
        const float across13 = std::min(facing(1, 2, 3), facing(1, 3, 0));
        if (across02 >= across13) {
            triangle(q[0], q[1], q[2], flip);
            triangle(q[0], q[2], q[3], flip);
        } else {
            triangle(q[1], q[2], q[3], flip);
            triangle(q[1], q[3], q[0], flip);
        }
    }

    static constexpr int kCells = kTileCells + 1;  // -1 .. kTileCells - 1
    const Solid& solid_;
    const std::array<int, 3>& first_node_;
    const TileSamples& samples_;
    TileMesh& mesh_;
    std::vector<CellVertices> cells_;
    std::array<std::int16_t, kCells * kCells * kCells> cell_slot_{};
};

}  // namespace

void mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, TileMesh& mesh) {
    mesh.vertices.clear();
    mesh.keys.clear();
    mesh.indices.clear();
    mesh.disagreeing_edges = 0;
    std::array<int, 3> first_node = grid.position(tile);
    for (int& n : first_node) n *= kTileCells;
    thread_local TileSamples samples;  // a hundred kilobytes that would otherwise be cleared for every tile
    if (!samples.collect(solid, first_node)) return;
    Mesher(solid, first_node, samples, mesh).run();
}

}  // namespace burin
