// SPDX-License-Identifier: MIT
#include "geometry/touch_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin {
namespace {

constexpr double kCosSharp = 0.766044443118978;      // 40 degrees
constexpr double kCosHalfSharp = 0.939692620785908;  // 20 degrees

// Of more triangles than these at one edge, not all pairs are compared.
constexpr std::size_t kMostAtEdge = 16;

// Whether the angle between them is below that of the cosine, which is above 0.
bool within(const Vec3& a, const Vec3& b, double cosine) {
    const double along = glm::dot(a, b);
    return along > 0.0 && along * along > cosine * cosine * glm::dot(a, a) * glm::dot(b, b);
}

Vec3f unit(const Vec3& v) {
    const double length2 = glm::dot(v, v);
    return length2 > 0.0 ? Vec3f(v / std::sqrt(length2)) : Vec3f(0.0f);
}

}  // namespace

TouchSurface::TouchSurface(std::vector<Vec3f> positions_m, std::vector<VertexTriple> triangles)
    : positions_m_(std::move(positions_m)),
      triangles_(std::move(triangles)),
      first_corner_(positions_m_.size(), kNone),
      next_corner_(3 * triangles_.size(), kNone),
      normals_(positions_m_.size(), Vec3f(0.0f)),
      split_(positions_m_.size(), 0) {
    for (std::uint32_t slot = slots(); slot-- > 0;) link(slot);
    for (std::uint32_t v = 0; v < vertices(); ++v) renew_normal(v);
}

void TouchSurface::link(std::uint32_t slot) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = 3 * slot + k, vertex = triangles_[slot][k];
        next_corner_[corner] = first_corner_[vertex];
        first_corner_[vertex] = corner;
    }
}

void TouchSurface::add_vertex(const Vec3f& position_m) {
    positions_m_.push_back(position_m);
    first_corner_.push_back(kNone);
    normals_.push_back(Vec3f(0.0f));
    split_.push_back(0);
}

void TouchSurface::remove(std::uint32_t slot) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t* at = &first_corner_[triangles_[slot][k]];
        while (*at != 3 * slot + k) at = &next_corner_[*at];
        *at = next_corner_[3 * slot + k];
    }
    triangles_[slot] = {kNone, kNone, kNone};
}

void TouchSurface::put(std::uint32_t slot, const VertexTriple& triangle) {
    if (slot == slots()) {
        triangles_.push_back(triangle);
        next_corner_.resize(next_corner_.size() + 3, kNone);
    }
    triangles_[slot] = triangle;
    link(slot);
}

TouchSurface::Facet TouchSurface::facet_at(std::uint32_t corner) const {
    const std::uint32_t slot = corner / 3, k = corner - 3 * slot;
    const VertexTriple& t = triangles_[slot];
    const Vec3 at(positions_m_[t[k]]);
    const Vec3 next = Vec3(positions_m_[t[k == 2 ? 0 : k + 1]]) - at;
    const Vec3 before = Vec3(positions_m_[t[k == 0 ? 2 : k - 1]]) - at;
    const Vec3 cross = glm::cross(next, before);
    const double lengths2 = glm::dot(next, next) * glm::dot(before, before);
    // An angle of less than 1e-6: its normal is noise.
    if (!(glm::dot(cross, cross) > 1e-12 * lengths2)) return {};
    return {cross, (1.0 / lengths2) * cross};
}

void TouchSurface::renew_normal(std::uint32_t vertex) {
    facets_.clear();
    Vec3 sum(0.0);
    for (std::uint32_t corner = first_corner_[vertex]; corner != kNone; corner = next_corner_[corner]) {
        facets_.push_back(facet_at(corner));
        sum += facets_.back().weighted;
    }
    split_[vertex] = 0;
    normals_[vertex] = unit(sum);
    // Where all facets are near their sum, no two of them turn by much: nearly all vertices of a fine mesh.
    const auto near_sum = [&](const Facet& f) { return f.cross == Vec3(0.0) || within(sum, f.cross, kCosHalfSharp); };
    if (std::ranges::all_of(facets_, near_sum)) return;
    const auto pieces = pieces_at(vertex);
    split_[vertex] = std::ranges::any_of(pieces, [&](const Piece& p) { return p.piece != pieces.front().piece; });
}

std::span<const TouchSurface::Piece> TouchSurface::pieces_at(std::uint32_t vertex) {
    corners_.clear(), facets_.clear(), spokes_.clear(), pieces_.clear();
    for (std::uint32_t corner = first_corner_[vertex]; corner != kNone; corner = next_corner_[corner])
        corners_.push_back(corner);
    std::ranges::sort(corners_);
    for (const std::uint32_t corner : corners_) {
        const VertexTriple& t = triangles_[corner / 3];
        const std::uint32_t k = corner % 3, facet = static_cast<std::uint32_t>(facets_.size());
        facets_.push_back(facet_at(corner));
        pieces_.push_back({corner / 3, facet, Vec3f(0.0f)});
        spokes_.push_back({t[k == 2 ? 0 : k + 1], facet});
        spokes_.push_back({t[k == 0 ? 2 : k - 1], facet});
    }
    std::ranges::sort(spokes_, {}, [](const Spoke& s) { return std::uint64_t{s.to} << 32 | s.facet; });
    DisjointSets sets(facets_.size());
    for (std::size_t i = 0; i < spokes_.size(); ++i)
        for (std::size_t j = i + 1; j < std::min(i + kMostAtEdge, spokes_.size()) && spokes_[j].to == spokes_[i].to;
             ++j) {
            const std::uint32_t a = spokes_[i].facet, b = spokes_[j].facet;
            if (within(facets_[a].cross, facets_[b].cross, kCosSharp)) sets.unite(a, b);
        }
    sums_.assign(facets_.size(), Vec3(0.0));
    for (std::uint32_t i = 0; i < facets_.size(); ++i) sums_[sets.set_of(i)] += facets_[i].weighted;
    for (Piece& piece : pieces_) {
        piece.piece = sets.set_of(piece.piece);
        piece.normal = unit(sums_[piece.piece]);
    }
    return pieces_;
}

}  // namespace burin
