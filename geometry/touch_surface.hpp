// SPDX-License-Identifier: MIT
// The mesh behind a TouchMesh, on the publisher's side: places, triangles, who meets at a vertex, and normals.
//
// A vertex normal belongs to the smooth piece of surface around the vertex: triangles that share an edge at which they turn by
// less than 40 degrees are of one piece. Where several pieces meet, along a sharp edge, each has its own normal. Facets
// count as Max, "Weights for computing vertex normals from facet normals" (Journal of Graphics Tools 4(2), 1999)
// weights them: by the cross product of the two edges over the product of their squared lengths, which is exact for
// vertices on a sphere however they are meshed.
// Frame: float metres relative to an origin that its owner keeps. Publisher's thread only; allocates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/edge_table.hpp"

namespace burin {

class TouchSurface {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    // Indices in range, positions finite.
    TouchSurface(std::vector<Vec3f> positions_m, std::vector<VertexTriple> triangles);

    [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(positions_m_.size()); }
    [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(triangles_.size()); }
    [[nodiscard]] const Vec3f& position_m(std::uint32_t vertex) const { return positions_m_[vertex]; }
    // Of a triangle that is there.
    [[nodiscard]] const VertexTriple& triangle(std::uint32_t slot) const { return triangles_[slot]; }
    [[nodiscard]] bool is_there(std::uint32_t slot) const { return triangles_[slot][0] != kNone; }

    void place(std::uint32_t vertex, const Vec3f& position_m) { positions_m_[vertex] = position_m; }
    void add_vertex(const Vec3f& position_m);
    void remove(std::uint32_t slot);
    // Into a slot that is empty, or the next new one.
    void put(std::uint32_t slot, const VertexTriple& triangle);

    // Calls visit(slot) for each triangle at the vertex; for one that names it twice, twice.
    template <typename Visit>
    void for_each_at(std::uint32_t vertex, Visit&& visit) const {
        for (std::uint32_t corner = first_corner_[vertex]; corner != kNone; corner = next_corner_[corner])
            visit(corner / 3);
    }

    // The vertex's normal, or the finding that there are several, made anew.
    void renew_normal(std::uint32_t vertex);
    [[nodiscard]] bool is_split(std::uint32_t vertex) const { return split_[vertex] != 0; }
    // Unit; of a vertex that is not split. Zero where all triangles have no area.
    [[nodiscard]] const Vec3f& normal(std::uint32_t vertex) const { return normals_[vertex]; }

    // The smooth pieces around a split vertex.
    struct Piece {
        std::uint32_t slot = 0;   // of a triangle there
        std::uint32_t piece = 0;  // triangles of one piece have the same
        Vec3f normal{0.0f};       // unit
    };
    // In rising order of slot. Holds until the next call, or renewal.
    [[nodiscard]] std::span<const Piece> pieces_at(std::uint32_t vertex);

private:
    // The facet's normal times its weight at the corner; zero if it has no area.
    struct Facet {
        Vec3 cross{0.0};  // of the edges: the normal, of any length
        Vec3 weighted{0.0};
    };
    [[nodiscard]] Facet facet_at(std::uint32_t corner) const;
    void link(std::uint32_t slot);

    std::vector<Vec3f> positions_m_;
    std::vector<VertexTriple> triangles_;  // kNone: empty
    // A corner is 3 times the slot, and 0, 1 or 2. Those of a vertex are a chain.
    std::vector<std::uint32_t> first_corner_, next_corner_;
    std::vector<Vec3f> normals_;
    std::vector<std::uint8_t> split_;

    // Room for pieces_at.
    struct Spoke {  // an edge at the vertex, by its other end
        std::uint32_t to, facet;
    };
    std::vector<std::uint32_t> corners_;
    std::vector<Facet> facets_;
    std::vector<Spoke> spokes_;
    std::vector<Vec3> sums_;
    std::vector<Piece> pieces_;
};

}  // namespace burin
