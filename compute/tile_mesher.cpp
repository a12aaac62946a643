// SPDX-License-Identifier: MIT
#include "compute/tile_mesher.hpp"

#include <algorithm>
#include <bit>

#include "compute/cell_table.hpp"
#include "compute/cell_vertices.hpp"
#include "compute/tile_samples.hpp"

namespace burin {
namespace {

constexpr Local step(Local p, int axis, int by) {
    p[static_cast<std::size_t>(axis)] += by;
    return p;
}

constexpr std::size_t cell_id(const Local& cell) {
    return static_cast<std::size_t>(((cell[1] + 1) * kSeenCells + cell[0] + 1) * kSeenCells + cell[2] + 1);
}

std::uint64_t lattice_key(const Lattice& lattice, const std::array<int, 3>& first_node, const Local& cell, int slot) {
    std::uint64_t key = 0;
    for (std::size_t a = 3; a-- > 0;) {
        // Cell -1 of the lattice exists (it is empty): count from there.
        key = key * static_cast<std::uint64_t>(lattice.cells[a] + 2) +
              static_cast<std::uint64_t>(cell[a] + first_node[a] + 1);
    }
    return key * 16 + static_cast<std::uint64_t>(slot);
}

// What outlives a call to keep its memory; as large as a tile and used by one thread.
struct Scratch {
    TileSamples samples;
    std::array<std::uint16_t, kSeenCells * kSeenCells * kSeenCells> place_of_cell{};  // in the new mesh's cells
    TileMesh fresh;
};

class Mesher {
public:
    Mesher(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& dirty, const TileMesh& old,
           Scratch& scratch)
        : solid_(solid),
          first_node_(first_node),
          old_(old),
          scratch_(scratch),
          samples_(scratch.samples),
          mesh_(scratch.fresh) {
        find_cells(dirty);
    }

    TileWork run() {
        make_vertices();
        make_quads();
        return work_;
    }

private:
    // needed_: the cells that quads refer to; anew_: those of them that cannot be copied. Where a loop passes a face twice,
    // extra vertices depend on the cells on both sides: these are always made anew.
    void find_cells(const CellMask& dirty) {
        needed_ = samples_.cells_at_own_edges();
        anew_ = dirty;
        if (old_.has_twice_passed_faces) {
            for (std::size_t i = 0; i < old_.cells.size(); ++i) {
                if ((old_.vertex_of_edge[i] & TileMesh::kPassedTwice) != 0) {
                    anew_.columns[old_.cells[i].cell / kSeenCells] |= 1u << (old_.cells[i].cell % kSeenCells);
                }
            }
        }
        for (std::size_t i = 0; i < anew_.columns.size(); ++i) anew_.columns[i] &= needed_.columns[i];
        samples_.collect_crossings(solid_, first_node_, anew_);
    }

    void make_vertices() {
        std::size_t old_cell = 0;
        for (int y = -1; y < kTileCells; ++y) {
            for (int x = -1; x < kTileCells; ++x) {
                for (std::uint32_t bits = needed_.at(x, y); bits != 0; bits &= bits - 1) {
                    const Local cell{x, y, std::countr_zero(bits) - 1};
                    const std::size_t id = cell_id(cell);
                    scratch_.place_of_cell[id] = static_cast<std::uint16_t>(mesh_.cells.size());
                    mesh_.cells.push_back(
                        {static_cast<std::uint16_t>(id), static_cast<std::uint16_t>(mesh_.vertices.size())});
                    if ((anew_.at(x, y) & bits & (~bits + 1u)) != 0) {
                        ++work_.cells;
                        mesh_.vertex_of_edge.push_back(
                            make_cell_vertices(solid_, first_node_, samples_, cell, mesh_.vertices));
                        mesh_.has_twice_passed_faces =
                            mesh_.has_twice_passed_faces || (mesh_.vertex_of_edge.back() & TileMesh::kPassedTwice) != 0;
                    } else {
                        while (old_.cells[old_cell].cell != id) ++old_cell;
                        copy_cell(old_cell);
                    }
                }
            }
        }
    }

    void copy_cell(std::size_t place) {
        const std::size_t first = old_.cells[place].first_vertex;
        const std::size_t end =
            place + 1 < old_.cells.size() ? old_.cells[place + 1].first_vertex : old_.cell_vertices();
        mesh_.vertices.insert(mesh_.vertices.end(), old_.vertices.begin() + static_cast<std::ptrdiff_t>(first),
                              old_.vertices.begin() + static_cast<std::ptrdiff_t>(end));
        mesh_.vertex_of_edge.push_back(old_.vertex_of_edge[place]);
    }

    void make_quads() {
        make_quads_along<0>();
        make_quads_along<1>();
        make_quads_along<2>();
        mesh_.row_quads.back() = static_cast<std::uint16_t>(mesh_.quads.size());
        mesh_.row_triangles.back() = static_cast<std::uint32_t>(mesh_.triangles());
    }

    template <int axis>
    void make_quads_along() {
        for (int y = 0; y < kTileCells; ++y) {
            constexpr std::size_t first_row = std::size_t{axis} * kTileCells;
            mesh_.row_quads[first_row + static_cast<std::size_t>(y)] = static_cast<std::uint16_t>(mesh_.quads.size());
            mesh_.row_triangles[first_row + static_cast<std::size_t>(y)] =
                static_cast<std::uint32_t>(mesh_.triangles());
            for (int x = 0; x < kTileCells; ++x) {
                for (std::uint32_t bits = samples_.own_crossed(axis, x, y); bits != 0; bits &= bits - 1) {
                    quad<axis>({x, y, std::countr_zero(bits) - 1});
                }
            }
        }
    }

    // The polygon around a crossed edge: the vertices of the four cells about it, and between two of them the extra vertex
    // of their common face where that is needed.
    template <int axis>
    void quad(const Local& node) {
        constexpr int u = (axis + 1) % 3, v = (axis + 2) % 3;
        // Counter-clockwise seen from the edge's upper end.
        const std::array<Local, 4> cells{step(step(node, u, -1), v, -1), step(node, v, -1), node, step(node, u, -1)};
        std::array<std::uint32_t, 8> polygon;
        polygon[0] = vertex_of(cells[0], cell_edge(axis, 1, 1));
        polygon[1] = vertex_of(cells[1], cell_edge(axis, 0, 1));
        polygon[2] = vertex_of(cells[2], cell_edge(axis, 0, 0));
        polygon[3] = vertex_of(cells[3], cell_edge(axis, 1, 0));
        const auto is_anew = [&](const Local& c) { return (anew_.at(c[0], c[1]) >> (c[2] + 1) & 1u) != 0; };
        const bool anew = is_anew(cells[0]) || is_anew(cells[1]) || is_anew(cells[2]) || is_anew(cells[3]);
        const bool flip = !samples_.inside(node);  // the surface faces the lower end
        const auto edge =
            static_cast<std::uint16_t>(((axis * kTileCells + node[1]) * kTileCells + node[0]) * kTileCells + node[2]);
        if (!anew) {
            while ((old_.quads[old_quad_] & TileMesh::kQuadEdge) != edge) ++old_quad_;
            const std::uint16_t quad = old_.quads[old_quad_];
            mesh_.disagreeing_edges += (quad & TileMesh::kDisagrees) != 0 ? 1 : 0;
            mesh_.quads.push_back(quad);
            split(polygon, (quad & TileMesh::kOtherDiagonal) != 0, flip);
            return;
        }
        const EdgeSample& sample = samples_.sample(axis, node);
        std::uint16_t quad = edge;
        if (sample.disagrees) {
            ++mesh_.disagreeing_edges;
            quad |= TileMesh::kDisagrees;
        }
        const std::size_t before = mesh_.indices.size();
        if (!mesh_.has_twice_passed_faces || !fan_through_faces(axis, node, cells, polygon, flip)) {
            const bool other = other_diagonal(polygon, flip, sample.normal);
            if (other) quad |= TileMesh::kOtherDiagonal;
            split(polygon, other, flip);
        }
        mesh_.quads.push_back(quad);
        work_.triangles += static_cast<std::uint32_t>((mesh_.indices.size() - before) / 3);
    }

    [[nodiscard]] std::uint32_t vertex_of(const Local& cell, int edge) const {
        const std::size_t place = scratch_.place_of_cell[cell_id(cell)];
        return mesh_.cells[place].first_vertex +
               static_cast<std::uint32_t>(mesh_.vertex_of_edge[place] >> (4 * edge) & 0xf);
    }

    // False, and nothing done, in the usual case that no loop passes a face of these cells twice.
    bool fan_through_faces(int axis, const Local& node, const std::array<Local, 4>& cells,
                           const std::array<std::uint32_t, 8>& corners, bool flip) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 8> polygon{};
        std::size_t count = 0, extra = 8;
        for (std::size_t i = 0; i < 4; ++i) {
            polygon[count++] = corners[i];
            // Faces towards the next cell: +u, +v, -u, -v.
            const int face_axis = i % 2 == 0 ? u : v;
            const int side = i < 2 ? 1 : 0;
            const Local next = step(cells[i], face_axis, side == 1 ? 1 : -1);
            if (passed_twice(cells[i], next, face_axis, side)) {
                extra = count;
                polygon[count++] = face_vertex(axis, node, side == 1 ? next : cells[i], face_axis);
            }
        }
        if (extra == 8) return false;
        // From the extra vertex: no diagonal of this fan can be an edge of another polygon.
        for (std::size_t i = 1; i + 1 < count; ++i) {
            triangle(polygon[extra], polygon[(extra + i) % count], polygon[(extra + i + 1) % count], flip);
        }
        return true;
    }

    [[nodiscard]] bool passed_twice(const Local& cell, const Local& next, int face_axis, int side) const {
        const unsigned a = cell_table()[samples_.cell_pattern(cell)].twice_faces;
        if (a == 0) return false;
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
        const auto pair_axis = static_cast<std::size_t>((face_axis + 1) % 3);
        const int pair = corner[pair_axis] - cell[pair_axis];
        mesh_.face_keys.push_back(lattice_key(solid_.lattice, first_node_, cell, 4 + 2 * face_axis + pair));
        // Symmetric in the two edges, so that both quads, in whatever tiles, compute the same bits.
        mesh_.vertices.push_back(make_face_vertex(solid_, first_node_, cell, {axis, node, samples_.sample(axis, node)},
                                                  {other, other_node, samples_.sample(other, other_node)}));
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flip) {
        mesh_.indices.insert(mesh_.indices.end(), {a, flip ? c : b, flip ? b : c});
    }

    void split(const std::array<std::uint32_t, 8>& q, bool other_diagonal, bool flip) {
        const std::size_t from = other_diagonal ? 1 : 0;
        triangle(q[from], q[from + 1], q[(from + 2) % 4], flip);
        triangle(q[from], q[(from + 2) % 4], q[(from + 3) % 4], flip);
    }

    // Whether the diagonal 1-3 turns the two triangles less away from the surface normal than 0-2 does.
    [[nodiscard]] bool other_diagonal(const std::array<std::uint32_t, 8>& q, bool flip,
                                      const Vec3f& surface_normal) const {
        std::array<Vec3f, 4> p;  // in cells, so that a workpiece of a micrometre does not underflow
        const shared::SurfaceVertex& origin = mesh_.vertices[q[0]];
        const auto cells_per_m = static_cast<float>(1.0 / solid_.lattice.spacing_m);
        for (std::size_t i = 0; i < 4; ++i) {
            const shared::SurfaceVertex& v = mesh_.vertices[q[i]];
            p[i] = Vec3f(v.x - origin.x, v.y - origin.y, v.z - origin.z) * cells_per_m;
        }
        const Vec3f normal = flip ? -surface_normal : surface_normal;
        // The squared cosine with its sign: it grows with the cosine, and needs no root.
        const auto facing = [&](std::size_t a, std::size_t b, std::size_t c) {
            const Vec3f n = glm::cross(p[b] - p[a], p[c] - p[a]);
            const float along = glm::dot(n, normal), length2 = glm::dot(n, n);
            return length2 > 0.0f ? along * std::abs(along) / length2 : -1.0f;
        };
        return std::min(facing(0, 1, 2), facing(0, 2, 3)) < std::min(facing(1, 2, 3), facing(1, 3, 0));
    }

    const Solid& solid_;
    const std::array<int, 3>& first_node_;
    const TileMesh& old_;
    Scratch& scratch_;
    TileSamples& samples_;
    TileMesh& mesh_;
    CellMask needed_, anew_;
    std::size_t old_quad_ = 0;
    TileWork work_;
};

void clear(TileMesh& mesh) {
    mesh.vertices.clear();
    mesh.indices.clear();
    mesh.disagreeing_edges = 0;
    mesh.cells.clear();
    mesh.vertex_of_edge.clear();
    mesh.quads.clear();
    mesh.face_keys.clear();
    mesh.has_twice_passed_faces = false;
}

}  // namespace

TileWork mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, const CellMask& dirty,
                   const TileMesh& old, TileMesh& fresh) {
    const std::array<int, 3> first_node = grid.first_node(tile);
    thread_local Scratch scratch;
    clear(scratch.fresh);
    TileWork work;
    if (scratch.samples.collect_signs(solid, first_node)) {
        work = Mesher(solid, first_node, dirty, old, scratch).run();
    }
    fresh = scratch.fresh;  // copied, so that a tile holds no more memory than it needs and the scratch keeps its own
    return work;
}

std::vector<std::uint64_t> vertex_keys(const Lattice& lattice, const std::array<int, 3>& first_node,
                                       const TileMesh& mesh) {
    std::vector<std::uint64_t> keys;
    keys.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        const int id = mesh.cells[i].cell;
        const Local cell{id / kSeenCells % kSeenCells - 1, id / (kSeenCells * kSeenCells) - 1, id % kSeenCells - 1};
        const std::size_t end = i + 1 < mesh.cells.size() ? mesh.cells[i + 1].first_vertex : mesh.cell_vertices();
        for (std::uint64_t k = 0; mesh.cells[i].first_vertex + k < end; ++k) {
            int loop = 0;
            while (loop < 3 && (mesh.vertex_of_edge[i] >> (4 * (13 + loop)) & 0xf) <= k) ++loop;
            keys.push_back(lattice_key(lattice, first_node, cell, loop));
        }
    }
    keys.insert(keys.end(), mesh.face_keys.begin(), mesh.face_keys.end());
    return keys;
}

}  // namespace burin
