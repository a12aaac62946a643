// SPDX-License-Identifier: MIT
// The mesh behind a TouchMesh, on the publisher's side: positions, triangles, the triangles around each vertex, and
// normals.
//
// A vertex normal belongs to the smooth piece of surface around the vertex: triangles that share an edge at which they
// turn by less than 40 degrees are of one piece. Where several pieces meet, along a sharp edge, each has its own
// normal. See geometry/contact/touch_facet.hpp for the weights of facets in a normal.
// Frame: float metres relative to an origin that its owner keeps. Publisher's thread only; allocates.
// Memory: a vertex is 32 bytes in one struct, since readers need nearly all of it; a triangle is 32. A quarter more of
// each is reserved, so that an edit that adds some does not have to move all the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/contact/touch_facet.hpp"
#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

class TouchSurface {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    // Requires indices in range and finite positions.
    TouchSurface(std::span<const Vec3f> positions_m, std::span<const VertexTriple> triangles);

    [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(vertices_.size()); }
    [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(triangles_.size()); }
    [[nodiscard]] const Vec3f& position_m(std::uint32_t vertex) const { return vertices_[vertex].position_m; }
    // Requires a triangle that is present.
    [[nodiscard]] const VertexTriple& triangle(std::uint32_t slot) const { return triangles_[slot]; }
    [[nodiscard]] bool is_there(std::uint32_t slot) const { return triangles_[slot][0] != kNone; }

    void place(std::uint32_t vertex, const Vec3f& position_m);
    void add_vertex(const Vec3f& position_m) { vertices_.push_back({.position_m = position_m}); }
    void remove(std::uint32_t slot);
    // Stores the triangle in an empty slot, or in the next new one.
    void put(std::uint32_t slot, const VertexTriple& triangle);

    // Calls visit(slot) for each triangle at the vertex; twice for a triangle that names the vertex twice.
    template <typename Visit>
    void for_each_at(std::uint32_t vertex, Visit&& visit) const {
        for (std::uint32_t at = vertices_[vertex].first_corner; at != kNone; at = next(at)) visit(slot_of(at));
    }

    // Recomputes the normals around all changes since the last call. Returns the triangles that have one of these
    // normals at a corner, possibly with repetitions. The span is valid until the next call.
    [[nodiscard]] std::span<const std::uint32_t> renew_normals();

    // Valid after renew_normals():
    [[nodiscard]] bool is_split(std::uint32_t vertex) const { return vertices_[vertex].split; }
    // Unit normal of a vertex that is not split. Zero where all its triangles have no area.
    [[nodiscard]] const Vec3f& normal(std::uint32_t vertex) const { return vertices_[vertex].normal; }
    // Sum of the triangle's edges; 0 where the triangle is degenerate.
    [[nodiscard]] float edge_sum_m(std::uint32_t slot) const { return edge_sum_m_[slot]; }
    // The smooth pieces around a split vertex.
    struct Piece {
        std::uint32_t slot = 0;   // of a triangle at the vertex
        std::uint32_t piece = 0;  // equal for triangles of one piece
        Vec3f normal{0.0f};       // unit
    };
    // Returns the pieces in ascending order of slot. The span is valid until the next call, or renewal.
    [[nodiscard]] std::span<const Piece> pieces_at(std::uint32_t vertex);

private:
    // kFacets: the vertex has moved, so that the facets around it have changed too.
    enum class Stale : std::uint8_t { kNo, kNormal, kFacets };
    struct Vertex {
        Vec3f position_m{0.0f};
        Vec3f normal{0.0f};
        std::uint32_t first_corner = kNone;
        bool split = false;
        Stale stale = Stale::kNo;
    };
    static_assert(sizeof(Vertex) == 32);

    // A corner is 4 times the slot, plus 0, 1 or 2. The corners of a vertex form a linked list.
    struct Links {
        std::array<std::uint32_t, 3> next_corner{kNone, kNone, kNone};  // one for each corner
        std::uint32_t facet = 0;                                        // index of its facet, see facets_
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
    // Clears the facet cache when it is full; called only where no facet is in use.
    void forget_facets_if_many() {
        if (facet_count_ >= kMostFacets) facet_count_ = 0;
    }

    std::vector<Vertex> vertices_;
    std::vector<VertexTriple> triangles_;  // kNone: empty slot
    std::vector<Links> links_;             // one for each slot
    std::vector<float> edge_sum_m_;        // one for each slot

    // Cache of the facets that the latest edit needed, cleared before normals are recomputed. The facet index of a slot
    // may be stale, which shows when the facet at that index belongs to another slot; so the indices need not be
    // cleared.
    static constexpr std::uint32_t kMostFacets = 32768;  // 2 MiB, to stay in a second-level cache
    std::vector<TouchFacet> facets_;                     // storage, of which facet_count_ are in use
    std::uint32_t facet_count_ = 0;

    std::vector<std::uint32_t> moved_, stale_normals_;  // vertices
    std::vector<std::uint32_t> changed_;                // slots
    std::vector<Around> around_;                        // buffer of facets_around

    // Buffers of pieces_at.
    struct Spoke {  // an edge at the vertex, by its other end
        std::uint32_t to, corner;
    };
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3> crosses_;  // one for each corner; zero where it has no weight
    std::vector<Spoke> spokes_;
    std::vector<Vec3> sums_;
    std::vector<Piece> pieces_;
};

}  // namespace burin::geometry
