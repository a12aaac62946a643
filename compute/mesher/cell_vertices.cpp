// SPDX-License-Identifier: MIT
#include "compute/cell_vertices.hpp"

#include <cmath>

#include "compute/cell_table.hpp"
#include "compute/direction_code.hpp"
#include "compute/feature_point.hpp"
#include "compute/float4.hpp"
#include "compute/tile_mesher.hpp"
#include "shaders/shared/feature_constants.h"

namespace burin {
namespace {

using shared::kSmooth;
using shared::kSmoothAcrossMaterials;

// Red, green and blue summed up, with how many colours there were.
class ColourSum {
public:
    explicit ColourSum(const Material& first) : sum_{first.colour[0], first.colour[1], first.colour[2]} {}
    void add(const Material& material) {
        for (std::size_t c = 0; c < 3; ++c) sum_[c] += material.colour[c];
        ++count_;
    }
    [[nodiscard]] std::uint32_t mean() const {
        const auto channel = [&](std::size_t c) { return (sum_[c] + count_ / 2) / count_; };
        return channel(0) | channel(1) << 8 | channel(2) << 16 | 0xff000000u;
    }

private:
    std::array<std::uint32_t, 3> sum_;
    std::uint32_t count_ = 1;
};

// A crossed edge of a cell.
struct Sampled {
    const EdgeSample* sample;
    std::uint8_t edge, piece;
};

// The place of a crossing in its cell is corner + along * direction: by a table and not by indexing a vector's components,
// which the processor would have to wait for.
struct CellEdge {
    Float4 corner, direction;
    std::size_t offset;  // of its number, from that of the x edge at the cell's lowest node
};

constexpr std::array<CellEdge, 12> kCellEdges = [] {
    std::array<CellEdge, 12> edges{};
    for (std::size_t e = 0; e < 12; ++e) {
        const std::size_t axis = e / 4;
        Local offset{};
        offset[(axis + 1) % 3] = static_cast<int>(e & 1);
        offset[(axis + 2) % 3] = static_cast<int>(e >> 1 & 1);
        const auto x = static_cast<float>(offset[0]), y = static_cast<float>(offset[1]),
                   z = static_cast<float>(offset[2]);
        edges[e] = {Float4{x, y, z, 0.0f},
                    Float4{axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f, 0.0f},
                    TileSamples::edge_offset(static_cast<int>(axis), offset)};
    }
    return edges;
}();

[[nodiscard]] bool in_one_piece(const EdgeSample& first, const EdgeSample& s) {
    const float least = first.material == s.material ? kSmooth : kSmoothAcrossMaterials;
    return glm::dot(first.normal, s.normal) >= least;
}

// Numbers the pieces: a crossing belongs to the first piece whose first crossing is like it. Returns how many there are.
std::size_t find_pieces(std::span<Sampled> loop) {
    std::array<const EdgeSample*, 12> first_of;
    std::size_t pieces = 0;
    for (Sampled& s : loop) {
        std::size_t p = 0;
        while (p < pieces && !in_one_piece(*first_of[p], *s.sample)) ++p;
        if (p == pieces) first_of[pieces++] = s.sample;
        s.piece = static_cast<std::uint8_t>(p);
    }
    return pieces;
}

}  // namespace

// The crossings of one loop through a cell, and the sums over them.
struct CellVertexMaker::Loop {
    std::array<const EdgeSample*, 12> samples;
    std::array<Float4, 12> places;
    std::size_t count;
    Float4 place_sum, normal_sum;
    bool one_material;
};

// `in_cell` is in cells from the cell's lowest corner; `length` is that of the normals' sum. The whole cells are counted from
// the lattice's origin and not from the tile's, so that every tile that shares the vertex rounds it to the same bits.
[[gnu::always_inline]] inline shared::SurfaceVertex CellVertexMaker::vertex_at(const Local& cell, const Vec3f& in_cell,
                                                                               const Vec3f& normal_sum, float length,
                                                                               std::uint32_t colour) const {
    const auto metres = [&](int a) {
        const auto k = static_cast<std::size_t>(a);
        return static_cast<float>((static_cast<double>(in_cell[a]) + (cell[k] + first_node_[k])) * spacing_m_);
    };
    const Vec3f normal = length > 1e-6f ? normal_sum * (1.0f / length) : Vec3f(0, 0, 1);
    const auto whole = [](float x) { return static_cast<std::int32_t>(x * 1048576.0f); };
    return {metres(0), metres(1), metres(2), direction_code(whole(normal.x), whole(normal.y), whole(normal.z)), colour};
}

// Whether all normals are in the cluster of the first. The sum over all pairs of |a - b|^2 is n^2 - |sum|^2; one normal that
// lies d from the first adds n d^2 / 2 to it at least (with every third one the two make a triangle). So a sum that is long
// enough says yes without looking at each; a shorter one does not say no.
[[gnu::always_inline]] inline bool CellVertexMaker::alike(const Loop& loop, float length2) {
    constexpr float kRounding = 1e-3f;
    const float least_distance2 = 2.0f - 2.0f * shared::kSameCluster;
    const auto count = static_cast<float>(loop.count);
    if (count * count - length2 < 0.5f * count * least_distance2 - kRounding * count * count) return true;
    const Float4 first = loop.samples[0]->normal_and_along();
    bool all = true;
    for (std::size_t i = 1; i < loop.count; ++i) {
        all &= dot3(first, loop.samples[i]->normal_and_along()) >= shared::kSameCluster;
    }
    return all;
}

// The usual loop, one smooth piece of one material: what feature_point() and the sums over pieces come to for it, bit for bit.
// False, and nothing done, for any other.
[[gnu::always_inline]] inline bool CellVertexMaker::make_smooth(const Local& cell, const Loop& loop,
                                                                shared::SurfaceVertex& vertex) const {
    const float length2 = dot3(loop.normal_sum, loop.normal_sum);
    if (!loop.one_material || !alike(loop, length2)) return false;
    const auto count = static_cast<float>(loop.count);
    const Float4 mean = loop.place_sum / count;
    float offset_sum = 0.0f;
    for (std::size_t i = 0; i < loop.count; ++i) {
        offset_sum += dot3(loop.samples[i]->normal_and_along(), loop.places[i] - mean);
    }
    const float length = std::sqrt(length2);
    const Float4 in_cell = mean + loop.normal_sum / length * (shared::kTowardsTangents * (offset_sum / count));
    vertex = vertex_at(cell, glm::clamp(xyz(in_cell), Vec3f(-shared::kOutside), Vec3f(1.0f + shared::kOutside)),
                       xyz(loop.normal_sum), length, ColourSum(materials_[loop.samples[0]->material]).mean());
    return true;
}

// The crossings of edges `first` to `end` of a cell.
[[gnu::always_inline]] inline void CellVertexMaker::collect(Loop& loop, std::size_t lowest_edge,
                                                            const std::uint8_t* first, const std::uint8_t* end) const {
    Float4 place_sum{}, normal_sum{};
    const std::uint8_t material = all_[index_[lowest_edge + kCellEdges[*first].offset]].material;
    unsigned other_materials = 0;
    std::size_t i = 0;
    do {  // a loop has three edges at least
        const CellEdge& edge = kCellEdges[*first];
        const EdgeSample& s = all_[index_[lowest_edge + edge.offset]];
        const Float4 normal = s.normal_and_along(), place = edge.corner + edge.direction * broadcast<3>(normal);
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
        std::array<Crossing, 12> crossings;
        std::array<Sampled, 12> sampled;
        for (std::size_t i = 0; i < loop.count; ++i) {
            crossings[i] = {xyz(loop.places[i]), loop.samples[i]->normal};
            sampled[i] = {loop.samples[i], cell_case.edges[from + i], 0};
        }
        const Vec3f in_cell = feature_point({crossings.data(), loop.count});
        const std::size_t first_of_loop = made.count;
        const std::size_t pieces = find_pieces({sampled.data(), loop.count});
        for (std::size_t i = 0; i < loop.count; ++i) use(sampled[i].edge, first_of_loop + sampled[i].piece);
        for (std::size_t p = 0; p < pieces; ++p) {
            std::size_t i = 0;
            while (sampled[i].piece != p) ++i;
            Vec3f normal_sum = sampled[i].sample->normal;
            ColourSum colour(materials_[sampled[i].sample->material]);
            while (++i < loop.count) {
                if (sampled[i].piece != p) continue;
                normal_sum += sampled[i].sample->normal;
                colour.add(materials_[sampled[i].sample->material]);
            }
            vertices[made.count++] = vertex_at(cell, in_cell, normal_sum, glm::length(normal_sum), colour.mean());
        }
    }
    if (cell_case.twice_faces == 0) made.of_edge &= ~TileMesh::kPassedTwice;
    return made;
}

shared::SurfaceVertex CellVertexMaker::make_face_vertex(const Local& cell, const EdgeSample& a,
                                                        const EdgeSample& b) const {
    const auto place = [&](const EdgeSample& s) {
        Vec3f p(static_cast<float>(s.node[0] - cell[0]), static_cast<float>(s.node[1] - cell[1]),
                static_cast<float>(s.node[2] - cell[2]));
        p[s.axis] += s.along;
        return p;
    };
    ColourSum colour(materials_[a.material]);
    colour.add(materials_[b.material]);
    const Vec3f normal_sum = a.normal + b.normal;
    return vertex_at(cell, (place(a) + place(b)) * 0.5f, normal_sum, glm::length(normal_sum), colour.mean());
}

}  // namespace burin
