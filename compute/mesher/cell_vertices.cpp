// SPDX-License-Identifier: MIT
#include "compute/mesher/cell_vertices.hpp"

#include "compute/mesher/cell_table.hpp"
#include "compute/mesher/tile_mesher.hpp"
#include "shaders/shared/cell_quad.h"
#include "shaders/shared/cell_row.h"
#include "shaders/shared/cell_vertex.h"
#include "shaders/shared/feature_planes.h"

namespace burin::shared {
namespace {

// Adapts one loop of crossings in host memory to shaders/shared/feature_point.h.
struct HostLoop {
    const compute::EdgeSample* const* samples;
    const Float3* places;
    [[nodiscard]] Float3 crossing_place(uint i) const { return places[i]; }
    [[nodiscard]] Float3 crossing_normal(uint i) const { return samples[i]->unit_normal(); }
#include "shaders/shared/feature_point.h"
};

struct PieceFinder {
#include "shaders/shared/cell_pieces.h"
};

}  // namespace
}  // namespace burin::shared

namespace burin::compute {
namespace {

using shared::ColourSum;
using shared::Float3;
using shared::Float4;

[[gnu::always_inline]] inline ColourSum with_material(const ColourSum& sum, const geometry::Material& material) {
    return shared::with_colour(sum, material.colour[0], material.colour[1], material.colour[2]);
}

// An edge of a cell, in a form that gives the position of a crossing as corner + along * direction. The result equals
// place_on_edge but needs no choice between axes, which would stall the processor.
struct CellEdge {
    Float4 corner, direction;
    std::size_t offset;  // offset of the edge's number from that of the x edge at the cell's lowest node
};

constexpr std::array<CellEdge, 12> kCellEdges = [] {
    std::array<CellEdge, 12> edges{};
    for (std::size_t e = 0; e < 12; ++e) {
        const auto edge = static_cast<std::uint32_t>(e);
        const auto axis = static_cast<std::size_t>(shared::axis_of_edge(edge));
        Local offset{};
        offset[(axis + 1) % 3] = shared::first_offset(edge);
        offset[(axis + 2) % 3] = shared::second_offset(edge);
        const Float4 lower = shared::place_on_edge(edge, 0.0f).lanes, upper = shared::place_on_edge(edge, 1.0f).lanes;
        edges[e] = {lower, upper - lower, TileSamples::edge_offset(shared::axis_of_edge(edge), offset)};
    }
    return edges;
}();

}  // namespace

// The crossings of one loop through a cell, and sums over them.
struct CellVertexMaker::Loop {
    std::array<const EdgeSample*, 12> samples;
    std::array<shared::Float3, 12> places;
    std::size_t count;
    Float3 place_sum, normal_sum;
    bool one_material;
};

[[gnu::always_inline]] inline shared::SurfaceVertex CellVertexMaker::vertex_at(const Local& cell, const Float3& in_cell,
                                                                               const Float3& normal_sum, float length,
                                                                               std::uint32_t colour) const {
    return shared::cell_vertex(cell[0] + first_node_[0], cell[1] + first_node_[1], cell[2] + first_node_[2], spacing_m_,
                               in_cell, normal_sum, length, colour);
}

// Tells whether all normals are in the cluster of the first. The sum over all pairs of |a - b|^2 is n^2 - |sum|^2; one
// normal at distance d from the first adds at least n d^2 / 2 to it (it makes a triangle with the first and each third
// normal). So a long enough sum proves it without a test of each normal; a shorter sum proves nothing.
[[gnu::always_inline]] inline bool CellVertexMaker::alike(const Loop& loop, float length2) {
    constexpr float kRounding = 1e-3f;
    const float least_distance2 = 2.0f - 2.0f * shared::kSameCluster;
    const auto count = static_cast<float>(loop.count);
    if (count * count - length2 < 0.5f * count * least_distance2 - kRounding * count * count) return true;
    const Float3 first = loop.samples[0]->unit_normal();
    bool all = true;
    for (std::size_t i = 1; i < loop.count; ++i) all &= shared::in_cluster(first, loop.samples[i]->unit_normal());
    return all;
}

// Computes the vertex of the usual loop, one smooth piece of one material, with the same bits as feature_point.h and
// the sums over pieces. Returns false and leaves the vertex unset for any other loop.
[[gnu::always_inline]] inline bool CellVertexMaker::make_smooth(const Local& cell, const Loop& loop,
                                                                shared::SurfaceVertex& vertex) const {
    const float length2 = dot3(loop.normal_sum, loop.normal_sum);
    if (!loop.one_material || !alike(loop, length2)) return false;
    const auto count = static_cast<float>(loop.count);
    const Float3 mean = exact_quotient(loop.place_sum, count);
    float offset_sum = 0.0f;
    for (std::size_t i = 0; i < loop.count; ++i) {
        offset_sum += dot3(loop.samples[i]->unit_normal(), loop.places[i] - mean);
    }
    const float length = std::sqrt(length2);
    const Float3 offset =
        shared::offset_to_plane(shared::mean_normal(loop.normal_sum, length), shared::mean_offset(offset_sum, count));
    vertex = vertex_at(cell, shared::place_from_mean(mean, offset), loop.normal_sum, length,
                       shared::mean_colour(with_material(shared::no_colour(), materials_[loop.samples[0]->material])));
    return true;
}

// Collects the crossings of edges `first` to `end` of a cell.
[[gnu::always_inline]] inline void CellVertexMaker::collect(Loop& loop, std::size_t lowest_edge,
                                                            const std::uint8_t* first, const std::uint8_t* end) const {
    shared::Float3 place_sum(0.0f), normal_sum(0.0f);
    const std::uint8_t material = all_[index_[lowest_edge + kCellEdges[*first].offset]].material;
    unsigned other_materials = 0;
    std::size_t i = 0;
    do {  // a loop has three edges at least
        const CellEdge& edge = kCellEdges[*first];
        const EdgeSample& s = all_[index_[lowest_edge + edge.offset]];
        const Float3 normal = s.unit_normal();
        const Float3 place(edge.corner + edge.direction * BURIN_SHUFFLED(normal.lanes, 3, 3, 3, 3));
        loop.samples[i] = &s;
        loop.places[i++] = place;
        place_sum += place;
        normal_sum += normal;
        other_materials |= s.material ^ material;
    } while (++first != end);
    loop.count = i;
    loop.place_sum = place_sum;
    loop.normal_sum = normal_sum;
    loop.one_material = other_materials == 0;
}

CellVertices CellVertexMaker::make(int z, shared::SurfaceVertex* vertices) const {
    const CellCase& cell_case = table_[TileSamples::cell_pattern(corners_, z)];
    const Local cell{column_[0], column_[1], z};
    const std::size_t lowest_edge = TileSamples::edge_offset(0, {cell[0] + 1, cell[1] + 1, z + 1});
    if (cell_case.loops == 1) {
        Loop loop;
        collect(loop, lowest_edge, cell_case.edges.data(), cell_case.edges.data() + cell_case.first_edge[1]);
        if (make_smooth(cell, loop, *vertices)) return {cell_case.all_use_first, 1};
    }
    return make_any(cell_case, cell, lowest_edge, vertices);
}

[[gnu::noinline]] CellVertices CellVertexMaker::make_any(const CellCase& cell_case, const Local& cell,
                                                         std::size_t lowest_edge,
                                                         shared::SurfaceVertex* vertices) const {
    CellVertices made{~std::uint64_t{0}, 0};  // kNoVertex everywhere
    const auto use = [&](std::size_t place, std::size_t vertex) {
        made.of_edge &= ~(TileMesh::kNoVertex << (4 * place));
        made.of_edge |= static_cast<std::uint64_t>(vertex) << (4 * place);
    };
    for (std::size_t l = 0; l < cell_case.loops; ++l) {
        Loop loop;
        const std::size_t from = cell_case.first_edge[l], to = cell_case.first_edge[l + 1];
        collect(loop, lowest_edge, &cell_case.edges[from], cell_case.edges.data() + to);
        if (l > 0) use(12 + l, made.count);
        if (make_smooth(cell, loop, vertices[made.count])) {
            for (std::size_t i = from; i < to; ++i) use(cell_case.edges[i], made.count);
            ++made.count;
            continue;
        }
        const auto end = static_cast<std::uint32_t>(loop.count);
        const Float3 mean = exact_quotient(loop.place_sum, static_cast<float>(loop.count));
        shared::HostLoop crossings{loop.samples.data(), loop.places.data()};
        const auto planes = crossings.offset_to_planes(0, end, mean);
        const Float3 offset = planes.found ? planes.offset : crossings.offset_by_eigenvalues(0, end, mean);
        const Float3 in_cell = shared::place_from_mean(mean, offset);

        std::array<std::uint32_t, 12> piece;
        shared::PieceFinder finder;
        finder.pieces = 0;
        for (std::size_t i = 0; i < loop.count; ++i) {
            piece[i] = finder.piece_of(loop.samples[i]->unit_normal(), loop.samples[i]->material);
            use(cell_case.edges[from + i], made.count + piece[i]);
        }
        for (std::uint32_t p = 0; p < finder.pieces; ++p) {
            Float3 normal_sum(0.0f);
            ColourSum colour = shared::no_colour();
            for (std::size_t i = 0; i < loop.count; ++i) {
                if (piece[i] != p) continue;
                normal_sum += loop.samples[i]->unit_normal();
                colour = with_material(colour, materials_[loop.samples[i]->material]);
            }
            vertices[made.count++] =
                vertex_at(cell, in_cell, normal_sum, length3(normal_sum), shared::mean_colour(colour));
        }
    }
    if (cell_case.twice_faces == 0) made.of_edge &= ~TileMesh::kPassedTwice;
    return made;
}

shared::SurfaceVertex CellVertexMaker::make_face_vertex(const Local& cell, const EdgeSample& a,
                                                        const EdgeSample& b) const {
    const auto place = [&](const EdgeSample& s) {
        return shared::place_in_cell({s.node[0], s.node[1], s.node[2]}, s.axis, s.along, {cell[0], cell[1], cell[2]});
    };
    const ColourSum colour =
        with_material(with_material(shared::no_colour(), materials_[a.material]), materials_[b.material]);
    const Float3 normal_sum = a.unit_normal() + b.unit_normal();
    return vertex_at(cell, shared::middle_of(place(a), place(b)), normal_sum, length3(normal_sum),
                     shared::mean_colour(colour));
}

}  // namespace burin::compute
