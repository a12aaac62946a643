// SPDX-License-Identifier: MIT
#include "compute/mesher/tile_mesher.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "compute/mesher/cell_table.hpp"
#include "compute/mesher/cell_vertices.hpp"
#include "compute/mesher/made_tile.hpp"
#include "compute/mesher/quad_corners.hpp"
#include "compute/mesher/tile_bounds.hpp"
#include "compute/mesher/tile_copier.hpp"
#include "compute/mesher/tile_draft.hpp"
#include "compute/mesher/tile_samples.hpp"
#include "shaders/shared/cell_quad.h"

namespace burin::compute {
namespace {

using shared::Float3;
using shared::Float4;

constexpr Local step(Local p, int axis, int by) {
    p[static_cast<std::size_t>(axis)] += by;
    return p;
}

constexpr std::size_t cell_id(const Local& cell) {
    return static_cast<std::size_t>(((cell[1] + 1) * kSeenCells + cell[0] + 1) * kSeenCells + cell[2] + 1);
}

// Increase of cell_id for one step along each axis.
constexpr std::array<std::size_t, 3> kIdStep{kSeenCells, kSeenCells* kSeenCells, 1};

std::uint64_t lattice_key(const Lattice& lattice, const std::array<int, 3>& first_node, const Local& cell, int slot) {
    std::uint64_t key = 0;
    for (std::size_t a = 3; a-- > 0;) {
        // Cell -1 of the lattice exists (it is empty), so counting starts there.
        key = key * static_cast<std::uint64_t>(lattice.cells[a] + 2) +
              static_cast<std::uint64_t>(cell[a] + first_node[a] + 1);
    }
    return key * 16 + static_cast<std::uint64_t>(slot);
}

// Buffers of one thread, kept between calls so that their memory is reused.
struct Scratch {
    TileSamples samples;
    TileDraft draft;
    std::vector<std::uint32_t> new_index;
    std::vector<double> heights;
};

Scratch& scratch_of_thread() {
    thread_local Scratch scratch;
    return scratch;
}

class Mesher {
public:
    // The samples must hold the tile's signs.
    Mesher(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& dirty, const TileMesh& old,
           Scratch& scratch, TileMesh& mesh)
        : solid_(solid),
          first_node_(first_node),
          samples_(scratch.samples),
          draft_(scratch.draft),
          heights_(scratch.heights),
          mesh_(mesh),
          cells_per_m_(static_cast<float>(1.0 / solid.lattice.spacing_m)),
          copier_(old, dirty, scratch.draft, scratch.new_index) {
        draft_.clear();
    }

    // Computes the cells that are dirty.
    TileWork run() {
        make_vertices();
        make_quads();
        finish();
        return work_;
    }

    // Takes the cells and crossings that a device has made. Returns nothing where they and the clean ones are not all
    // of the tile's cells, `cells` in number, or do not make whole quads.
    std::optional<TileWork> run(const MadePart& made, std::size_t cells) {
        take_vertices(made);
        if (draft_.cells.count != cells) return {};
        if (!samples_.take_crossings(made.edges, copier_.dirty_edges())) return {};
        make_quads();
        finish();
        return work_;
    }

private:
    void finish() {
        draft_.vertices.assign_to(mesh_.vertices);
        draft_.indices.assign_to(mesh_.indices);
        draft_.quads.assign_to(mesh_.quads);
        const TileBounds bounds = bounds_of(mesh_, heights_);
        mesh_.longest_edge_m = bounds.longest_edge_m;
        mesh_.slab = bounds.slab;
        draft_.cells.assign_to(mesh_.cells);
        draft_.vertex_of_edge.assign_to(mesh_.vertex_of_edge);
        mesh_.disagreeing_edges += copier_.disagreeing_edges();
        mesh_.signs = samples_.signs();
    }

    void make_vertices() {
        CellMask anew = samples_.cells_at_own_edges();
        for (std::size_t i = 0; i < anew.columns.size(); ++i) anew.columns[i] &= copier_.dirty().columns[i];
        samples_.collect_crossings(solid_, first_node_, anew);
        CellVertexMaker maker(solid_, first_node_, samples_);
        for (int y = -1; y < kTileCells; ++y) {
            for (int x = -1; x < kTileCells; ++x) {
                if (anew.at(x, y) == 0) continue;
                maker.begin_column(x, y);
                for (std::uint32_t bits = anew.at(x, y); bits != 0; bits &= bits - 1) {
                    const Local cell{x, y, std::countr_zero(bits) - 1};
                    copier_.copy_cells(cell_id(cell));
                    make_cell(maker, cell);
                }
            }
        }
        copier_.copy_cells(TileDraft::kCells);
    }

    void make_cell(const CellVertexMaker& maker, const Local& cell) {
        ++work_.cells;
        draft_.begin_cell(cell_id(cell), draft_.vertices.count);
        const CellVertices made = maker.make(cell[2], &draft_.vertices.items[draft_.vertices.count]);
        draft_.vertices.count += made.count;
        draft_.vertex_of_edge.push_back(made.of_edge);
        mesh_.has_twice_passed_faces |= (made.of_edge & TileMesh::kPassedTwice) != 0;
    }

    void take_vertices(const MadePart& made) {
        for (const shared::MadeCell& cell : made.cells) {
            copier_.copy_cells(number_of(cell));
            draft_.begin_cell(number_of(cell), draft_.vertices.count);
            draft_.vertices.append(made.vertices + cell.first_vertex, vertices_of(cell));
            draft_.vertex_of_edge.push_back(of_edge(cell));
        }
        copier_.copy_cells(TileDraft::kCells);
        work_.cells = static_cast<std::uint32_t>(made.cells.size());
    }

    void make_quads() {
        std::size_t row = 0;
        begin_row(0);
        const auto begin_rows = [&](std::size_t last) {
            while (row < last) {
                copier_.copy_quads((row + 1) * kTileCells * kTileCells);
                begin_row(++row);
            }
        };
        for (const EdgeSample& sample : samples_.samples()) {
            if (sample.own_edge == EdgeSample::kNotOwn) continue;
            begin_rows(sample.own_edge / (kTileCells * kTileCells));
            copier_.copy_quads(sample.own_edge);
            if (sample.axis == 0) make_quad<0>(sample);
            if (sample.axis == 1) make_quad<1>(sample);
            if (sample.axis == 2) make_quad<2>(sample);
        }
        begin_rows(geometry::SurfaceTile::kRows);
    }

    void begin_row(std::size_t row) {
        mesh_.row_quads[row] = static_cast<std::uint16_t>(draft_.quads.count);
        mesh_.row_triangles[row] = static_cast<std::uint32_t>(draft_.indices.count / 3);
    }

    // Adds the polygon around a crossed edge: the vertices of the four cells around the edge, and between two of them
    // the extra vertex of their common face where one is needed.
    template <int axis>
    void make_quad(const EdgeSample& sample) {
        constexpr int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Local node{sample.node[0], sample.node[1], sample.node[2]};
        constexpr std::size_t back_u = kIdStep[u], back_v = kIdStep[v];
        const std::size_t id = cell_id(node);
        // Counter-clockwise seen from the edge's upper end.
        std::array<std::uint32_t, 8> polygon;
        for (int i = 0; i < 4; ++i) {
            const std::size_t back =
                (shared::first_step_back(i) != 0 ? back_u : 0) + (shared::second_step_back(i) != 0 ? back_v : 0);
            polygon[static_cast<std::size_t>(i)] = vertex_of(id - back, shared::edge_of_quad(axis, i));
        }
        const bool flip = !sample.lower_inside;  // the surface faces the lower end
        std::uint16_t edge = sample.own_edge;
        if (sample.disagrees) {
            ++mesh_.disagreeing_edges;
            edge |= TileMesh::kDisagrees;
        }
        const std::size_t before = draft_.indices.count;
        if (!mesh_.has_twice_passed_faces || !fan_through_faces(axis, node, polygon, flip)) {
            const bool other = other_diagonal(polygon, flip ? -sample.normal : sample.normal);
            if (other) edge |= TileMesh::kOtherDiagonal;
            split(polygon, other, flip);
        }
        draft_.quads.push_back(edge);
        work_.triangles += static_cast<std::uint32_t>((draft_.indices.count - before) / 3);
    }

    [[nodiscard]] std::uint32_t vertex_of(std::size_t id, int edge) const {
        const std::size_t place = draft_.place_of_cell[id];
        return draft_.cells.items[place].first_vertex +
               static_cast<std::uint32_t>(draft_.vertex_of_edge.items[place] >> (4 * edge) & 0xf);
    }

    // Adds the polygon as a fan if a loop passes a face of these cells twice. Otherwise, the usual case, returns false
    // and adds nothing.
    bool fan_through_faces(int axis, const Local& node, const std::array<std::uint32_t, 8>& corners, bool flip) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 8> polygon{};
        std::size_t count = 0, extra = 8;
        for (int i = 0; i < 4; ++i) {
            polygon[count++] = corners[static_cast<std::size_t>(i)];
            const Local cell = step(step(node, u, -shared::first_step_back(i)), v, -shared::second_step_back(i));
            const int face_axis = shared::face_axis_of_quad(axis, i), side = shared::face_side_of_quad(i);
            const Local next = step(cell, face_axis, side == 1 ? 1 : -1);
            if (passed_twice(cell, next, face_axis, side)) {
                extra = count;
                polygon[count++] = face_vertex(axis, node, side == 1 ? next : cell, face_axis);
            }
        }
        if (extra == 8) return false;
        // The fan starts from the extra vertex, so none of its diagonals can be an edge of another polygon.
        for (std::size_t i = 1; i + 1 < count; ++i) {
            triangle(polygon[extra], polygon[(extra + i) % count], polygon[(extra + i + 1) % count], flip);
        }
        return true;
    }

    [[nodiscard]] bool passed_twice(const Local& cell, const Local& next, int face_axis, int side) const {
        const unsigned a = cell_table()[samples_.cell_pattern(cell)].twice_faces;
        if (a == 0) return false;
        const unsigned b = cell_table()[samples_.cell_pattern(next)].twice_faces;
        return shared::passed_twice(a, b, face_axis, side);
    }

    // Adds the extra vertex for the join of this edge on the lower face (normal face_axis) of `cell`; returns its
    // index.
    std::uint32_t face_vertex(int axis, const Local& node, const Local& cell, int face_axis) {
        const shared::FaceJoin join = shared::face_join(axis, {node[0], node[1], node[2]}, samples_.inside(node),
                                                        {cell[0], cell[1], cell[2]}, face_axis);
        const Local other_node{join.other_node.x, join.other_node.y, join.other_node.z};
        const int pair_axis = (face_axis + 1) % 3;
        const int pair = join.corner[pair_axis] - cell[static_cast<std::size_t>(pair_axis)];
        mesh_.face_keys.push_back(lattice_key(solid_.lattice, first_node_, cell, 4 + 2 * face_axis + pair));
        draft_.vertices.push_back(
            CellVertexMaker(solid_, first_node_, samples_)
                .make_face_vertex(cell, samples_.sample(axis, node), samples_.sample(join.other_axis, other_node)));
        return static_cast<std::uint32_t>(draft_.vertices.count - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flip) {
        std::uint32_t* const corner = draft_.indices.add(3);
        corner[0] = a;
        corner[1] = shared::second_corner(b, c, flip);
        corner[2] = shared::third_corner(b, c, flip);
    }

    void split(const std::array<std::uint32_t, 8>& q, bool other_diagonal, bool flip) {
        const std::uint32_t opening = shared::opening_corner(other_diagonal);
        const std::uint32_t third = q[shared::corner_after(opening, 2)];
        triangle(q[opening], q[shared::corner_after(opening, 1)], third, flip);
        triangle(q[opening], third, q[shared::corner_after(opening, 3)], flip);
    }

    // Tells whether the diagonal 1-3 turns its two triangles less away from the outward normal than 0-2 does.
    [[nodiscard]] bool other_diagonal(const std::array<std::uint32_t, 8>& q, const Vec3f& normal) const {
        const QuadCorners corners(draft_.vertices.items.get(), q[0], q[1], q[2], q[3]);
        const Float4 x = shared::from_first_corner(corners.x, cells_per_m_),
                     y = shared::from_first_corner(corners.y, cells_per_m_),
                     z = shared::from_first_corner(corners.z, cells_per_m_);
        return shared::takes_other_diagonal(shared::facings(x, y, z, normal.x, normal.y, normal.z));
    }

    const Solid& solid_;
    const std::array<int, 3>& first_node_;
    TileSamples& samples_;
    TileDraft& draft_;
    std::vector<double>& heights_;
    TileMesh& mesh_;
    float cells_per_m_;
    TileCopier copier_;
    TileWork work_;
};

}  // namespace

TileWork mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, const CellMask& dirty,
                   const TileMesh& old, TileMesh& fresh) {
    const std::array<int, 3> first_node = grid.first_node(tile);
    Scratch& scratch = scratch_of_thread();
    fresh = TileMesh();
    const NodeColumns* const signs_before = old.quads.empty() ? nullptr : &old.signs;
    if (!scratch.samples.collect_signs(solid, first_node, signs_before, dirty)) return {};
    return Mesher(solid, first_node, dirty, old, scratch, fresh).run();
}

std::optional<TileWork> compose_tile(const Solid& solid, const TileGrid& grid, const MadeCells& made,
                                     const shared::MadeTile& tile, const TileMesh& old, TileMesh& fresh) {
    if (tile.left != 0 || old.has_twice_passed_faces) return {};
    const std::optional<MadePart> part = part_of(made, tile);
    if (!part) return {};
    const std::array<int, 3> first_node = grid.first_node(tile.tile);
    Scratch& scratch = scratch_of_thread();
    fresh = TileMesh();
    if (!scratch.samples.take_signs(part->signs)) {
        return part->cells.empty() && part->edges.empty() ? std::optional(TileWork{}) : std::nullopt;
    }
    // The old cells that no crossed edge touches any more are dirty too.
    const CellMask needed = scratch.samples.cells_at_own_edges();
    CellMask dirty, kept;
    std::uint32_t not_needed = 0;
    for (std::size_t i = 0; i < dirty.columns.size(); ++i) {
        const std::uint32_t made_here = part->mask.columns[i], needed_here = needed.columns[i];
        not_needed |= made_here & ~needed_here;
        kept.columns[i] = needed_here & ~made_here;
        dirty.columns[i] = CellMask::kAll & ~kept.columns[i];
    }
    if (not_needed != 0 || !scratch.samples.same_signs(old.signs, kept)) return {};
    return Mesher(solid, first_node, dirty, old, scratch, fresh).run(*part, needed.count());
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

}  // namespace burin::compute
