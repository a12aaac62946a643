// SPDX-License-Identifier: MIT
// The mesh behind a TouchMesh, on the publisher's side: places, triangles, who meets at a vertex, and normals.
//
// A vertex normal belongs to the smooth piece of surface around the vertex: triangles that share an edge at which they turn by
// less than 40 degrees are of one piece. Where several pieces meet, along a sharp edge, each has its own normal. How facets
// count in a normal: geometry/touch_facet.hpp.
// Frame: float metres relative to an origin that its owner keeps. Publisher's thread only; allocates.
// Cost: a vertex is 32 bytes in one piece, since whoever looks at one needs nearly all of it; a triangle is 32. Room for a quarter
// more of each is kept free, so that an edit that adds some does not have to move all the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/edge_table.hpp"
#include "geometry/touch_facet.hpp"

namespace burin {

class TouchSurface {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    // Indices in range, positions finite.
    TouchSurface(std::span<const Vec3f> positions_m, std::span<const VertexTriple> triangles);

    [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(vertices_.size()); }
    [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(triangles_.size()); }
    [[nodiscard]] const Vec3f& position_m(std::uint32_t vertex) const { return vertices_[vertex].position_m; }
    // Of a triangle that is there.
    [[nodiscard]] const VertexTriple& triangle(std::uint32_t slot) const { return triangles_[slot]; }
    [[nodiscard]] bool is_there(std::uint32_t slot) const { return triangles_[slot][0] != kNone; }

    void place(std::uint32_t vertex, const Vec3f& position_m);
    void add_vertex(const Vec3f& position_m) { vertices_.push_back({.position_m = position_m}); }
    void remove(std::uint32_t slot);
    // Into a slot that is empty, or the next new one.
    void put(std::uint32_t slot, const VertexTriple& triangle);

    // Calls visit(slot) for each triangle at the vertex; for one that names it twice, twice.
    template <typename Visit>
    void for_each_at(std::uint32_t vertex, Visit&& visit) const {
        for (std::uint32_t at = vertices_[vertex].first_corner; at != kNone; at = next(at)) visit(slot_of(at));
    }

    // The normals around all that has changed since the last time, made anew. Returns the triangles that have one of them at a
    // corner; one may be named again. Holds until the next call.
    [[nodiscard]] std::span<const std::uint32_t> renew_normals();

    // After renewal:
    [[nodiscard]] bool is_split(std::uint32_t vertex) const { return vertices_[vertex].split; }
    // Unit; of a vertex that is not split. Zero where all triangles have no area.
    [[nodiscard]] const Vec3f& normal(std::uint32_t vertex) const { return vertices_[vertex].normal; }
    // 0 where the triangle is degenerate.
    [[nodiscard]] float edge_sum_m(std::uint32_t slot) const { return edge_sum_m_[slot]; }
    // The smooth pieces around a split vertex.
    struct Piece {
        std::uint32_t slot = 0;   // of a triangle there
        std::uint32_t piece = 0;  // triangles of one piece have the same
        Vec3f normal{0.0f};       // unit
    };
    // In rising order of slot. Holds until the next call, or renewal.
    [[nodiscard]] std::span<const Piece> pieces_at(std::uint32_t vertex);

private:
    enum class Stale : std::uint8_t { kNo, kNormal, kFacets };  // kFacets: it has moved, and what is at it has changed
    struct Vertex {
        Vec3f position_m{0.0f};
        Vec3f normal{0.0f};
        std::uint32_t first_corner = kNone;
        bool split = false;
        Stale stale = Stale::kNo;
    };
    static_assert(sizeof(Vertex) == 32);

    // A corner is 4 times the slot, and 0, 1 or 2. Those of a vertex are a chain.
    struct Links {
        std::array<std::uint32_t, 3> next_corner{kNone, kNone, kNone};  // of each corner
        std::uint32_t facet = 0;                                        // the place of its facet, see facets_
    };
    static std::uint32_t slot_of(std::uint32_t corner) { return corner >> 2; }
    [[nodiscard]] std::uint32_t& next(std::uint32_t corner) { return links_[corner >> 2].next_corner[corner & 3]; }
    [[nodiscard]] const std::uint32_t& next(std::uint32_t corner) const {
        return links_[corner >> 2].next_corner[corner & 3];
    }
    void link(std::uint32_t slot);

    void normals_are_stale(std::uint32_t slot);
    void order_moved();
    void renew_around(std::uint32_t vertex);
    void renew_normal(std::uint32_t vertex);
    struct Around {
        std::uint32_t facet, corner;  // 0, 1 or 2
    };
    [[nodiscard]] std::span<const Around> facets_around(std::uint32_t vertex);
    [[nodiscard]] Vec3 weighted_sum(std::span<const Around> around) const;
    [[nodiscard]] bool is_smooth(std::span<const Around> around, const Vec3& sum) const;
    void find_pieces(std::uint32_t vertex);

    [[nodiscard]] bool knows_facet(std::uint32_t slot) const {
        const std::uint32_t number = links_[slot].facet;
        return number < facet_count_ && facets_[number].slot == slot;
    }
    [[nodiscard]] std::uint32_t facet_number(std::uint32_t slot) {
        if (!knows_facet(slot)) make_facet(slot);
        return links_[slot].facet;
    }
    void make_facet(std::uint32_t slot);
    void make_room_for_facets();
    // Where it does not take a facet away that is in use.
    void forget_facets_if_many() {
        if (facet_count_ >= kMostFacets) facet_count_ = 0;
    }

    std::vector<Vertex> vertices_;
    std::vector<VertexTriple> triangles_;  // kNone: empty
    std::vector<Links> links_;             // of each slot
    std::vector<float> edge_sum_m_;        // of each slot

    // Facets as they are needed, of the latest edit; forgotten before normals are made anew. What a slot has for the place of its
    // facet may be out of date, and then the facet there is of another slot: so nothing has to be wiped.
    static constexpr std::uint32_t kMostFacets = 32768;  // 2 MiB, to stay in a second-level cache
    std::vector<TouchFacet> facets_;                   // room; facet_count_ are there
    std::uint32_t facet_count_ = 0;

    std::vector<std::uint32_t> moved_, stale_normals_;  // vertices
    std::vector<std::uint32_t> changed_;                // slots
    std::vector<Around> around_;                        // room for facets_around

    // Room for pieces_at.
    struct Spoke {  // an edge at the vertex, by its other end
        std::uint32_t to, corner;
    };
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3> crosses_;  // of each corner; zero without weight
    std::vector<Spoke> spokes_;
    std::vector<Vec3> sums_;
    std::vector<Piece> pieces_;
};

}  // namespace burin
