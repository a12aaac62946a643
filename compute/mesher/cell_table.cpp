// SPDX-License-Identifier: MIT
#include "compute/mesher/cell_table.hpp"

#include "shaders/shared/cell_row.h"

namespace burin::compute {
namespace {

using shared::cell_edge;

struct FaceRing {
    std::array<int, 4> corners;  // in order around the face
    std::array<int, 4> edges;    // edges[i] joins corners[i] and corners[i + 1]
};

constexpr FaceRing face_ring(int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto corner = [&](int cu, int cv) { return (side << axis) | (cu << u) | (cv << v); };
    return {{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
            {cell_edge(u, 0, side), cell_edge(v, side, 1), cell_edge(u, 1, side), cell_edge(v, side, 0)}};
}

// Labels of the cell's edges: edges of one loop carry the same label. Joining two edges gives both the smaller label.
struct Labels {
    std::array<int, 12> of_edge{};
    constexpr void join(int a, int b) {
        const int from = of_edge[static_cast<std::size_t>(a)] > of_edge[static_cast<std::size_t>(b)]
                             ? of_edge[static_cast<std::size_t>(a)]
                             : of_edge[static_cast<std::size_t>(b)];
        const int to = of_edge[static_cast<std::size_t>(a)] + of_edge[static_cast<std::size_t>(b)] - from;
        for (int& label : of_edge) {
            if (label == from) label = to;
        }
    }
};

constexpr CellCase make_case(unsigned pattern) {
    const auto inside = [&](int corner) { return (pattern >> corner & 1u) != 0; };
    Labels labels;
    std::array<bool, 12> crossed{};
    for (int e = 0; e < 12; ++e) labels.of_edge[static_cast<std::size_t>(e)] = e;
    std::uint8_t ambiguous = 0;
    for (int face = 0; face < 6; ++face) {
        const FaceRing ring = face_ring(face / 2, face % 2);
        std::array<int, 4> found{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (inside(ring.corners[i]) != inside(ring.corners[(i + 1) % 4])) {
                crossed[static_cast<std::size_t>(ring.edges[i])] = true;
                found[count++] = ring.edges[i];
            }
        }
        if (count == 2) labels.join(found[0], found[1]);
        if (count == 4) {
            ambiguous = static_cast<std::uint8_t>(ambiguous | (1u << face));
            for (std::size_t i = 0; i < 4; ++i) {
                if (inside(ring.corners[i])) labels.join(ring.edges[(i + 3) % 4], ring.edges[i]);
            }
        }
    }
    CellCase result;
    std::array<int, 12> loop_of_label{};
    loop_of_label.fill(-1);
    for (std::size_t e = 0; e < 12; ++e) {
        result.loop_of_edge[e] = kNotCrossed;
        if (!crossed[e]) continue;
        int& loop = loop_of_label[static_cast<std::size_t>(labels.of_edge[e])];
        if (loop < 0) loop = result.loops++;
        result.loop_of_edge[e] = static_cast<std::uint8_t>(loop);
    }
    for (int face = 0; face < 6; ++face) {
        if ((ambiguous >> face & 1) == 0) continue;
        const FaceRing ring = face_ring(face / 2, face % 2);
        bool one_loop = true;
        for (const int edge : ring.edges) {
            one_loop = one_loop && result.loop_of_edge[static_cast<std::size_t>(edge)] ==
                                       result.loop_of_edge[static_cast<std::size_t>(ring.edges[0])];
        }
        if (one_loop) result.twice_faces = static_cast<std::uint8_t>(result.twice_faces | (1u << face));
    }
    std::uint8_t listed = 0;
    for (std::uint8_t loop = 0; loop < 4; ++loop) {
        for (std::uint8_t e = 0; e < 12; ++e) {
            if (result.loop_of_edge[e] == loop) result.edges[listed++] = e;
        }
        result.first_edge[loop + 1u] = listed;
    }
    result.all_use_first = ~std::uint64_t{0};
    for (std::uint8_t i = 0; i < listed; ++i) result.all_use_first &= ~(std::uint64_t{0xf} << (4 * result.edges[i]));
    if (result.twice_faces == 0) result.all_use_first &= ~(std::uint64_t{1} << 48);
    return result;
}

constexpr std::array<CellCase, 256> make_table() {
    std::array<CellCase, 256> table{};
    for (unsigned pattern = 0; pattern < 256; ++pattern) table[pattern] = make_case(pattern);
    return table;
}

}  // namespace

const std::array<CellCase, 256>& cell_table() {
    static constexpr std::array<CellCase, 256> kTable = make_table();
    return kTable;
}

}  // namespace burin::compute
