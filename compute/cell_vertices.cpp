// SPDX-License-Identifier: MIT
#include "compute/cell_vertices.hpp"

#include "compute/cell_table.hpp"
#include "compute/tile_mesher.hpp"
#include "shaders/shared/feature_constants.h"
#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

using shared::kSmooth;
using shared::kSmoothAcrossMaterials;

std::uint32_t encode(const Vec3f& n) {
    const auto whole = [](float x) { return static_cast<std::int64_t>(x * 1048576.0f); };
    return shared::encode_normal({whole(n.x), whole(n.y), whole(n.z)});
}

// `in_cell` is in cells from the cell's lowest corner. The whole cells are counted from the lattice's origin and not from the
// tile's, so that every tile that shares the vertex rounds it to the same bits.
shared::SurfaceVertex vertex_at(const Lattice& lattice, const std::array<int, 3>& first_node, const Local& cell,
                                const Vec3f& in_cell, const Vec3f& normal, std::uint32_t colour) {
    const auto metres = [&](int a) {
        const auto k = static_cast<std::size_t>(a);
        return static_cast<float>((static_cast<double>(in_cell[a]) + (cell[k] + first_node[k])) * lattice.spacing_m);
    };
    return {metres(0), metres(1), metres(2),
            encode(glm::length(normal) > 1e-6f ? glm::normalize(normal) : Vec3f(0, 0, 1)), colour};
}

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
    int axis;
    std::size_t node_offset;  // of the edge's lower node, from the cell's lowest
    Vec3f corner, direction;
};

constexpr std::array<CellEdge, 12> kCellEdges = [] {
    std::array<CellEdge, 12> edges{};
    for (std::size_t e = 0; e < 12; ++e) {
        const std::size_t axis = e / 4;
        Local offset{};
        offset[(axis + 1) % 3] = static_cast<int>(e & 1);
        offset[(axis + 2) % 3] = static_cast<int>(e >> 1 & 1);
        edges[e] = {static_cast<int>(axis), TileSamples::node_offset(offset),
                    Vec3f(static_cast<float>(offset[0]), static_cast<float>(offset[1]), static_cast<float>(offset[2])),
                    Vec3f(axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f)};
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

std::uint64_t make_cell_vertices(const Solid& solid, const std::array<int, 3>& first_node, const TileSamples& samples,
                                 const Local& cell, std::vector<shared::SurfaceVertex>& vertices) {
    const CellCase& cell_case = cell_table()[samples.cell_pattern(cell)];
    const std::size_t first = vertices.size(), lowest_node = TileSamples::node_index(cell);
    std::uint64_t used = ~std::uint64_t{0};  // kNoVertex everywhere
    const auto use = [&](std::size_t place, std::size_t vertex) {
        used &= ~(TileMesh::kNoVertex << (4 * place));
        used |= static_cast<std::uint64_t>(vertex) << (4 * place);
    };
    for (std::size_t loop = 0; loop < cell_case.loops; ++loop) {
        std::array<Crossing, 12> crossings;
        std::array<Sampled, 12> sampled;
        std::size_t count = 0;
        for (std::size_t i = cell_case.first_edge[loop]; i < cell_case.first_edge[loop + 1]; ++i) {
            const std::uint8_t e = cell_case.edges[i];
            const CellEdge& edge = kCellEdges[e];
            const EdgeSample& s = samples.sample_at(edge.axis, lowest_node + edge.node_offset);
            crossings[count] = {edge.corner + edge.direction * s.along, s.normal};
            sampled[count++] = {&s, e, 0};
        }
        const Vec3f in_cell = feature_point({crossings.data(), count});
        const std::size_t first_of_loop = vertices.size() - first;
        const std::size_t pieces = find_pieces({sampled.data(), count});
        if (loop > 0) use(12 + loop, first_of_loop);
        for (std::size_t i = 0; i < count; ++i) use(sampled[i].edge, first_of_loop + sampled[i].piece);
        for (std::size_t p = 0; p < pieces; ++p) {
            std::size_t i = 0;
            while (sampled[i].piece != p) ++i;
            Vec3f normal_sum = sampled[i].sample->normal;
            ColourSum colour(solid.materials[sampled[i].sample->material]);
            while (++i < count) {
                if (sampled[i].piece != p) continue;
                normal_sum += sampled[i].sample->normal;
                colour.add(solid.materials[sampled[i].sample->material]);
            }
            vertices.push_back(vertex_at(solid.lattice, first_node, cell, in_cell, normal_sum, colour.mean()));
        }
    }
    if (cell_case.twice_faces == 0) used &= ~TileMesh::kPassedTwice;
    return used;
}

shared::SurfaceVertex make_face_vertex(const Solid& solid, const std::array<int, 3>& first_node, const Local& cell,
                                       const EdgeCrossing& a, const EdgeCrossing& b) {
    const auto place = [&](const EdgeCrossing& c) {
        Vec3f p(static_cast<float>(c.node[0] - cell[0]), static_cast<float>(c.node[1] - cell[1]),
                static_cast<float>(c.node[2] - cell[2]));
        p[c.axis] += c.sample.along;
        return p;
    };
    ColourSum colour(solid.materials[a.sample.material]);
    colour.add(solid.materials[b.sample.material]);
    return vertex_at(solid.lattice, first_node, cell, (place(a) + place(b)) * 0.5f, a.sample.normal + b.sample.normal,
                     colour.mean());
}

}  // namespace burin
