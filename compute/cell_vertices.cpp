// SPDX-License-Identifier: MIT
#include "compute/cell_vertices.hpp"

#include "compute/cell_table.hpp"
#include "compute/tile_mesher.hpp"
#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

// Crossings whose normals are closer than this (cosine, about 41 degrees) belong to one smooth piece of surface.
constexpr float kSmooth = 0.75f;
// Across a change of material already a smaller angle (about 10 degrees) is an edge: the vertex lies on it, so each side can
// keep its own colour. Where the surface runs on smoothly the border lies anywhere in the cell, and the colours blend.
constexpr float kSmoothAcrossMaterials = 0.985f;

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
    void add(const Material& material) {
        for (std::size_t c = 0; c < 3; ++c) sum_[c] += material.colour[c];
        ++count_;
    }
    [[nodiscard]] std::uint32_t mean() const {
        const auto channel = [&](std::size_t c) { return (sum_[c] + count_ / 2) / count_; };
        return channel(0) | channel(1) << 8 | channel(2) << 16 | 0xff000000u;
    }

private:
    std::array<std::uint32_t, 3> sum_{};
    std::uint32_t count_ = 0;
};

// Crossings of one loop that belong together, by the first of them.
struct Piece {
    Vec3f first_normal{0.0f}, normal_sum{0.0f};
    std::uint8_t first_material = 0;
    ColourSum colour;

    [[nodiscard]] bool takes(const EdgeSample& s) const {
        const float least = first_material == s.material ? kSmooth : kSmoothAcrossMaterials;
        return glm::dot(first_normal, s.normal) >= least;
    }
};

struct CellEdge {
    std::uint8_t axis;
    std::array<std::int8_t, 3> offset;
};

constexpr std::array<CellEdge, 12> kCellEdges = [] {
    std::array<CellEdge, 12> edges{};
    for (std::size_t e = 0; e < 12; ++e) {
        const std::size_t axis = e / 4;
        edges[e].axis = static_cast<std::uint8_t>(axis);
        edges[e].offset[(axis + 1) % 3] = static_cast<std::int8_t>(e & 1);
        edges[e].offset[(axis + 2) % 3] = static_cast<std::int8_t>(e >> 1 & 1);
    }
    return edges;
}();

Vec3f place_of(int axis, const Local& from_cell, const EdgeSample& sample) {
    Vec3f p(static_cast<float>(from_cell[0]), static_cast<float>(from_cell[1]), static_cast<float>(from_cell[2]));
    p[axis] += sample.along;
    return p;
}

}  // namespace

std::uint64_t make_cell_vertices(const Solid& solid, const std::array<int, 3>& first_node, const TileSamples& samples,
                                 const Local& cell, std::vector<shared::SurfaceVertex>& vertices) {
    const CellCase& cell_case = cell_table()[samples.cell_pattern(cell)];
    const std::size_t first = vertices.size();
    std::uint64_t used = ~std::uint64_t{0};  // kNoVertex everywhere
    const auto use = [&](std::size_t place, std::size_t vertex) {
        used &= ~(TileMesh::kNoVertex << (4 * place));
        used |= static_cast<std::uint64_t>(vertex) << (4 * place);
    };
    for (std::size_t loop = 0; loop < cell_case.loops; ++loop) {
        std::array<Crossing, 12> crossings;
        std::array<std::size_t, 12> edge_of{}, piece_of{};
        std::array<Piece, 12> pieces;
        std::size_t count = 0, piece_count = 0;
        for (std::size_t e = 0; e < 12; ++e) {
            if (cell_case.loop_of_edge[e] != loop) continue;
            const CellEdge& edge = kCellEdges[e];
            const Local offset{edge.offset[0], edge.offset[1], edge.offset[2]};
            const EdgeSample& s =
                samples.sample(edge.axis, {cell[0] + offset[0], cell[1] + offset[1], cell[2] + offset[2]});
            crossings[count] = {place_of(edge.axis, offset, s), s.normal};
            std::size_t p = 0;
            while (p < piece_count && !pieces[p].takes(s)) ++p;
            if (p == piece_count) {
                pieces[p].first_normal = s.normal;
                pieces[p].first_material = s.material;
                ++piece_count;
            }
            pieces[p].normal_sum += s.normal;
            pieces[p].colour.add(solid.materials[s.material]);
            edge_of[count] = e;
            piece_of[count++] = p;
        }
        const Vec3f in_cell = feature_point({crossings.data(), count});
        const std::size_t first_of_loop = vertices.size() - first;
        use(12 + loop, first_of_loop);
        for (std::size_t i = 0; i < count; ++i) use(edge_of[i], first_of_loop + piece_of[i]);
        for (std::size_t p = 0; p < piece_count; ++p) {
            vertices.push_back(
                vertex_at(solid.lattice, first_node, cell, in_cell, pieces[p].normal_sum, pieces[p].colour.mean()));
        }
    }
    return used;
}

shared::SurfaceVertex make_face_vertex(const Solid& solid, const std::array<int, 3>& first_node, const Local& cell,
                                       const EdgeCrossing& a, const EdgeCrossing& b) {
    const auto place = [&](const EdgeCrossing& c) {
        return place_of(c.axis, {c.node[0] - cell[0], c.node[1] - cell[1], c.node[2] - cell[2]}, c.sample);
    };
    ColourSum colour;
    colour.add(solid.materials[a.sample.material]);
    colour.add(solid.materials[b.sample.material]);
    return vertex_at(solid.lattice, first_node, cell, (place(a) + place(b)) * 0.5f, a.sample.normal + b.sample.normal,
                     colour.mean());
}

}  // namespace burin
