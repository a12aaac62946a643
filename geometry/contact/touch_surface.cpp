// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_surface.hpp"

#include <algorithm>
#include <cmath>

namespace burin::geometry {
namespace {

constexpr double kCosSharp = 0.766044443118978;      // 40 degrees
constexpr double kCosHalfSharp = 0.939692620785908;  // 20 degrees

// Above this number of triangles at one edge, not all pairs are compared.
constexpr std::size_t kMostAtEdge = 16;

// Tells whether the angle between a and b is below the angle of this cosine, which is above 0.
bool within(const Vec3& a, const Vec3& b, double cosine) {
    const double along = glm::dot(a, b);
    return along > 0.0 && along * along > cosine * cosine * glm::dot(a, a) * glm::dot(b, b);
}

Vec3f unit(const Vec3& v) {
    const double length2 = glm::dot(v, v);
    return length2 > 0.0 ? Vec3f(v / std::sqrt(length2)) : Vec3f(0.0f);
}

std::size_t and_a_quarter(std::size_t count) { return count + count / 4; }

}  // namespace

TouchSurface::TouchSurface(std::span<const Vec3f> positions_m, std::span<const VertexTriple> triangles) {
    vertices_.reserve(and_a_quarter(positions_m.size()));
    triangles_.reserve(and_a_quarter(triangles.size()));
    links_.reserve(and_a_quarter(triangles.size()));
    edge_sum_m_.reserve(and_a_quarter(triangles.size()));
    for (const Vec3f& p : positions_m) add_vertex(p);
    triangles_.assign(triangles.begin(), triangles.end());
    links_.resize(triangles.size());
    edge_sum_m_.resize(triangles.size(), 0.0f);
    for (std::uint32_t slot = slots(); slot-- > 0;) link(slot);
    for (std::uint32_t v = 0; v < vertices(); ++v) renew_normal(v);
    changed_ = {};
}

void TouchSurface::link(std::uint32_t slot) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t& first = vertices_[triangles_[slot][k]].first_corner;
        links_[slot].next_corner[k] = first;
        first = 4 * slot + k;
    }
}

void TouchSurface::place(std::uint32_t vertex, const Vec3f& position_m) {
    Vertex& v = vertices_[vertex];
    v.position_m = position_m;
    if (v.stale == Stale::kFacets) return;
    v.stale = Stale::kFacets;
    moved_.push_back(vertex);
}

void TouchSurface::normals_are_stale(std::uint32_t slot) {
    for (const std::uint32_t v : triangles_[slot]) {
        if (vertices_[v].stale != Stale::kNo) continue;
        vertices_[v].stale = Stale::kNormal;
        stale_normals_.push_back(v);
    }
}

void TouchSurface::remove(std::uint32_t slot) {
    normals_are_stale(slot);
    for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t* at = &vertices_[triangles_[slot][k]].first_corner;
        while (*at != 4 * slot + k) at = &next(*at);
        *at = links_[slot].next_corner[k];
    }
    triangles_[slot] = {kNone, kNone, kNone};
}

void TouchSurface::put(std::uint32_t slot, const VertexTriple& triangle) {
    if (slot == slots()) {
        triangles_.push_back(triangle);
        links_.emplace_back();
        edge_sum_m_.push_back(0.0f);
    }
    triangles_[slot] = triangle;
    link(slot);
    normals_are_stale(slot);
}

void TouchSurface::make_facet(std::uint32_t slot) {
    if (facet_count_ == facets_.size()) make_room_for_facets();
    const auto [a, b, c] = triangles_[slot];
    TouchFacet& facet = facets_[facet_count_];
    facet = TouchFacet({Vec3(position_m(a)), Vec3(position_m(b)), Vec3(position_m(c))}, slot);
    edge_sum_m_[slot] = facet.edge_sum_m;
    links_[slot].facet = facet_count_++;
}

void TouchSurface::make_room_for_facets() { facets_.resize(std::max<std::size_t>(64, 2 * facets_.size())); }

std::span<const std::uint32_t> TouchSurface::renew_normals() {
    facet_count_ = 0, changed_.clear();
    if (moved_.size() > vertices() / 4) order_moved();
    for (const std::uint32_t v : moved_) renew_around(v);
    for (const std::uint32_t v : stale_normals_) {
        if (vertices_[v].stale == Stale::kNormal) renew_normal(v);
        vertices_[v].stale = Stale::kNo;
    }
    for (const std::uint32_t v : moved_) vertices_[v].stale = Stale::kNo;
    moved_.clear(), stale_normals_.clear();
    return changed_;
}

// Sorts many moved vertices by number, so that neighbours are renewed one after another while their facets are cached.
void TouchSurface::order_moved() {
    moved_.clear();
    for (std::uint32_t v = 0; v < vertices(); ++v)
        if (vertices_[v].stale == Stale::kFacets) moved_.push_back(v);
}

// Renews the normal of a vertex that has moved, and marks those of its neighbours as stale.
void TouchSurface::renew_around(std::uint32_t vertex) {
    const std::size_t before = changed_.size();
    renew_normal(vertex);
    for (std::size_t i = before; i < changed_.size(); ++i) normals_are_stale(changed_[i]);
}

// Renews the vertex's normal, or finds that it has several.
void TouchSurface::renew_normal(std::uint32_t vertex) {
    const std::span<const Around> around = facets_around(vertex);
    const Vec3 sum = weighted_sum(around);
    vertices_[vertex].normal = unit(sum);
    vertices_[vertex].split = false;
    if (is_smooth(around, sum)) return;
    find_pieces(vertex);
    const auto is_other = [&](const Piece& p) { return p.piece != pieces_.front().piece; };
    vertices_[vertex].split = std::ranges::any_of(pieces_, is_other);
}

std::span<const TouchSurface::Around> TouchSurface::facets_around(std::uint32_t vertex) {
    forget_facets_if_many();
    std::uint32_t count = 0;
    for (std::uint32_t corner = vertices_[vertex].first_corner; corner != kNone; corner = next(corner)) {
        const std::uint32_t slot = slot_of(corner);
        if (!knows_facet(slot)) {
            make_facet(slot);
            changed_.push_back(slot);
        }
        if (count == around_.size()) around_.resize(2 * count + 16);
        around_[count++] = {links_[slot].facet, corner & 3};
    }
    return {around_.data(), count};
}

Vec3 TouchSurface::weighted_sum(std::span<const Around> around) const {
    Vec3 sum(0.0);
    for (const auto& [facet, corner] : around) sum += facets_[facet].weight[corner] * facets_[facet].cross;
    return sum;
}

// Tells whether all facets are within 20 degrees of their sum, so that no two of them turn by 40: true for nearly all
// vertices of a fine mesh.
bool TouchSurface::is_smooth(std::span<const Around> around, const Vec3& sum) const {
    const double least2 = kCosHalfSharp * kCosHalfSharp * glm::dot(sum, sum);
    for (const auto& [facet, corner] : around) {
        const double along = glm::dot(sum, facets_[facet].cross);
        const bool is_near = along > 0.0 && along * along > least2 * facets_[facet].cross2;
        if (!is_near && facets_[facet].weight[corner] > 0.0) return false;
    }
    return true;
}

std::span<const TouchSurface::Piece> TouchSurface::pieces_at(std::uint32_t vertex) {
    forget_facets_if_many();
    find_pieces(vertex);
    return pieces_;
}

void TouchSurface::find_pieces(std::uint32_t vertex) {
    corners_.clear(), crosses_.clear(), sums_.clear(), spokes_.clear(), pieces_.clear();
    for (std::uint32_t at = vertices_[vertex].first_corner; at != kNone; at = next(at)) corners_.push_back(at);
    std::ranges::sort(corners_);
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
        const std::uint32_t slot = slot_of(corners_[i]), k = corners_[i] & 3;
        const VertexTriple& t = triangles_[slot];
        const TouchFacet& facet = facets_[facet_number(slot)];
        crosses_.push_back(facet.weight[k] > 0.0 ? facet.cross : Vec3(0.0));
        pieces_.push_back({slot, i, Vec3f(0.0f)});
        spokes_.push_back({t[k == 2 ? 0 : k + 1], i});
        spokes_.push_back({t[k == 0 ? 2 : k - 1], i});
    }
    std::ranges::sort(spokes_, {}, [](const Spoke& s) { return std::uint64_t{s.to} << 32 | s.corner; });
    DisjointSets sets(corners_.size());
    for (std::size_t i = 0; i < spokes_.size(); ++i)
        for (std::size_t j = i + 1; j < std::min(i + kMostAtEdge, spokes_.size()) && spokes_[j].to == spokes_[i].to;
             ++j) {
            const std::uint32_t a = spokes_[i].corner, b = spokes_[j].corner;
            if (within(crosses_[a], crosses_[b], kCosSharp)) sets.unite(a, b);
        }
    sums_.assign(corners_.size(), Vec3(0.0));
    for (std::uint32_t i = 0; i < corners_.size(); ++i)
        sums_[sets.set_of(i)] += facets_[facet_number(slot_of(corners_[i]))].weight[corners_[i] & 3] * crosses_[i];
    for (Piece& piece : pieces_) {
        piece.piece = sets.set_of(piece.piece);
        piece.normal = unit(sums_[piece.piece]);
    }
}

}  // namespace burin::geometry
