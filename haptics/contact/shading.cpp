// SPDX-License-Identifier: MIT
#include "haptics/contact/shading.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Cosine: in a smooth piece a corner's normal is at least this close to its facet's.
constexpr double kSmooth = 0.7;
constexpr double kSameNormal = 0.05;  // greatest difference between facets' normals at a shared point
constexpr double kOneRegion = 0.9;    // cosine: planes closer than this may belong to one smooth piece
// Area of the moved triangle over the facet's; less means a hollow too tight for the ball.
constexpr double kLeastArea = 0.25;
constexpr double kBeyondFacet = 0.25;  // how far normals are extrapolated past a facet, in barycentric coordinates
constexpr std::uint32_t kMostTried = 24;
constexpr std::uint32_t kManyTouches = 16;
constexpr double kAsNear = 1.0 + 4e-4;  // ratio of squared distances that count as equal

using Facet = SmoothFacet;

std::optional<Facet> facet_of(const geometry::PosedSurface& surface, std::uint32_t id, const geometry::Triangle& t,
                              bool from_back) {
    const geometry::CornerNormals corners = surface.corner_normals(id);
    if (!corners.known) return std::nullopt;
    Facet facet{t, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) facet.normals[k] = Vec3(corners.normals[k]);
    if (from_back) {
        std::swap(facet.triangle.b, facet.triangle.c);
        facet.normals = {-facet.normals[0], -facet.normals[2], -facet.normals[1]};
    }
    facet.normal = glm::cross(facet.triangle.b - facet.triangle.a, facet.triangle.c - facet.triangle.a);
    const double least = kSmooth * std::sqrt(glm::dot(facet.normal, facet.normal));
    for (const Vec3& normal : facet.normals)
        if (!(glm::dot(normal, facet.normal) >= least)) return std::nullopt;
    return facet;
}

// Barycentric coordinates of p's foot on the triangle. None where the triangle's normal, projected on `outward`, is
// shorter than kLeastArea of it or points the other way.
std::optional<Vec3> coordinates(const geometry::Triangle& t, const Vec3& outward, const Vec3& p) {
    const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    if (!(glm::dot(normal, outward) >= kLeastArea * glm::dot(outward, outward))) return std::nullopt;
    const double size2 = glm::dot(normal, normal);
    const double b = glm::dot(glm::cross(p - t.a, t.c - t.a), normal) / size2;
    const double c = glm::dot(glm::cross(t.b - t.a, p - t.a), normal) / size2;
    return Vec3(1.0 - b - c, b, c);
}

Vec3 interpolated(const Facet& facet, const Vec3& coordinates) {
    const Vec3 sum =
        coordinates.x * facet.normals[0] + coordinates.y * facet.normals[1] + coordinates.z * facet.normals[2];
    return sum / std::sqrt(glm::dot(sum, sum));
}

geometry::Triangle moved_out(const Facet& facet, double radius) {
    return {facet.triangle.a + radius * facet.normals[0], facet.triangle.b + radius * facet.normals[1],
            facet.triangle.c + radius * facet.normals[2]};
}

double least_of(const Vec3& v) { return std::min({v.x, v.y, v.z}); }

class Shader {
public:
    Shader(SmoothFacets& facets, const Candidates& candidates, const Touches& touches, const Vec3& center,
           double radius)
        : facets_(facets), candidates_(candidates), touches_(touches), center_(center), radius_(radius) {}

    [[nodiscard]] std::optional<Vec3> normal_of(std::uint32_t touch) const {
        if (Candidates::is_point(touches_.places[touch].candidate)) return normal_at_point(touch);
        const auto own = facet(touch);
        if (!own || !agreed(*own, touch)) return std::nullopt;
        Best best;
        look_at(best, *own);
        if (best.inside < 0.0) look_beside(best, touch);
        if (!best.found) return std::nullopt;
        return best.normal;
    }

private:
    struct Best {
        bool found = false;
        double inside = -HUGE_VAL;  // the least barycentric coordinate
        Vec3 normal{0.0};
    };

    // The triangle that is touched, if it is part of a smooth surface.
    [[nodiscard]] std::optional<Facet> facet(std::uint32_t touch) const {
        const Touches::Place& place = touches_.places[touch];
        return facets_.of(candidates_.id(place.candidate), candidates_.triangle(place.candidate), place.seen_from_back);
    }

    // The same from the facets around a vertex, all of which must agree about its normal.
    [[nodiscard]] std::optional<Vec3> normal_at_point(std::uint32_t touch) const {
        const Vec3& vertex = touches_.places[touch].point;
        Best best;
        std::optional<Vec3> agreed;
        bool smooth = true;
        std::uint32_t tried = 0;
        geometry::for_each_triangle_around(
            facets_.surface(), vertex, [&](std::uint32_t id, const geometry::Triangle& t) {
                const auto facet = facets_.of(id, t, false);
                smooth = facet && ++tried <= kMostTried && agree(agreed, normal_at(*facet, vertex));
                if (smooth) look_at(best, *facet);
                return smooth;
            });
        if (!smooth || !best.found) return std::nullopt;
        return best.normal;
    }
    // The normal at the facet's corner nearest to a vertex.
    [[nodiscard]] static const Vec3& normal_at(const Facet& facet, const Vec3& vertex) {
        const auto apart2 = [&](const Vec3& corner) { return glm::dot(corner - vertex, corner - vertex); };
        const double a = apart2(facet.triangle.a), b = apart2(facet.triangle.b), c = apart2(facet.triangle.c);
        return facet.normals[a <= b && a <= c ? 0 : (b <= c ? 1 : 2)];
    }
    [[nodiscard]] static bool agree(std::optional<Vec3>& known, const Vec3& normal) {
        if (!known) known = normal;
        const Vec3 difference = normal - *known;
        return glm::dot(difference, difference) <= kSameNormal * kSameNormal;
    }

    // Keeps the facet under the centre: the one whose moved triangle contains it by the largest margin.
    void look_at(Best& best, const Facet& facet) const {
        const auto at = coordinates(moved_out(facet, radius_), facet.normal, center_);
        if (!at || least_of(*at) <= best.inside) return;
        Vec3 held = glm::max(*at, Vec3(-kBeyondFacet));
        held /= held.x + held.y + held.z;
        best = {true, least_of(*at), interpolated(facet, held)};
    }

    // Tries the other facets touched on this side; if there are very many, only those about as near as the nearest.
    void look_beside(Best& best, std::uint32_t touch) const {
        const Vec3& way = touches_.planes[touch].normal;
        const bool many = touches_.count > kManyTouches;
        double nearest2 = HUGE_VAL;
        for (std::uint32_t i = 0; many && i < touches_.count; ++i) nearest2 = std::min(nearest2, distance2_of(i));
        std::uint32_t tried = 0;
        for (std::uint32_t i = 0; i < touches_.count && tried < kMostTried; ++i) {
            if (i == touch || glm::dot(touches_.planes[i].normal, way) < kOneRegion) continue;
            if (many && distance2_of(i) > nearest2 * kAsNear) continue;
            ++tried;
            if (Candidates::is_point(touches_.places[i].candidate)) continue;
            if (const auto beside = facet(i)) look_at(best, *beside);
            if (best.inside >= 0.0) return;
        }
    }

    [[nodiscard]] double distance2_of(std::uint32_t touch) const {
        const Vec3 off = center_ - touches_.places[touch].point;
        return glm::dot(off, off);
    }

    // Whether all facets that meet at a point on an edge or corner agree about its normal.
    [[nodiscard]] bool agreed(const Facet& own, std::uint32_t touch) const {
        const Touches::Place& place = touches_.places[touch];
        if (place.on_face) return true;
        const auto at = coordinates(own.triangle, own.normal, place.point);
        if (!at) return false;
        const Vec3 normal = interpolated(own, *at);
        const double tie = 1e2 * kTie * radius_;
        std::uint32_t tried = 0;
        for (std::uint32_t i = 0; i < touches_.count; ++i) {
            const Vec3 apart = touches_.places[i].point - place.point;
            if (i == touch || glm::dot(apart, apart) > tie * tie) continue;
            if (++tried > kMostTried) return false;
            if (Candidates::is_point(touches_.places[i].candidate)) continue;
            const auto other = facet(i);
            if (!other) return false;
            const auto there = coordinates(other->triangle, other->normal, place.point);
            if (!there) return false;
            const Vec3 difference = interpolated(*other, *there) - normal;
            if (glm::dot(difference, difference) > kSameNormal * kSameNormal) return false;
        }
        return true;
    }

    SmoothFacets& facets_;
    const Candidates& candidates_;
    const Touches& touches_;
    const Vec3& center_;
    double radius_;
};

}  // namespace

std::optional<SmoothFacet> SmoothFacets::of(std::uint32_t id, const geometry::Triangle& triangle,
                                            bool from_back) noexcept {
    for (std::uint32_t i = 0; i < std::min(count_, kMost); ++i)
        if (ids_[i] == id && from_back_[i] == from_back)
            return is_smooth_[i] ? std::optional(facets_[i]) : std::nullopt;
    const std::uint32_t place = count_++ % kMost;
    const auto facet = facet_of(surface_, id, triangle, from_back);
    ids_[place] = id;
    from_back_[place] = from_back;
    is_smooth_[place] = facet.has_value();
    if (facet) facets_.put(place, *facet);
    return facet;
}

ShadedPlanes shaded(SmoothFacets& facets, const Candidates& candidates, const Touches& touches,
                    const NearestInside& goal, const Vec3& center, double radius) noexcept {
    const Shader shader(facets, candidates, touches, center, radius);
    ShadedPlanes result;
    for (std::uint32_t i = 0; i < goal.bearing_count; ++i) {
        HalfSpace plane = touches.planes[goal.bearing[i]];
        if (const auto normal = shader.normal_of(goal.bearing[i])) {
            plane.normal = *normal;
            result.any = true;
        }
        result.planes[result.count++] = plane;
    }
    return result;
}

Vec3 onto_true_planes(const Touches& touches, const Vec3& wish, const Vec3& normal, double tolerance) noexcept {
    double deepest = 0.0, lowest = HUGE_VAL;
    for (const HalfSpace& plane : touches.span()) {
        const double height = glm::dot(plane.normal, wish) - plane.offset, square = glm::dot(plane.normal, normal);
        deepest = std::max(deepest, -height);
        if (square > 0.1) lowest = std::min(lowest, height / square);
    }
    if (deepest > tolerance) {
        const NearestInside inside = nearest_inside(touches.span(), wish, tolerance);
        return inside.found ? inside.point : Vec3(0.0);
    }
    return lowest > 0.0 && lowest < HUGE_VAL ? wish - lowest * normal : wish;
}

double StepShare::of(const Vec3& center, const Vec3& wish) noexcept {
    if (known_) {
        const Vec3 moved = center - center_, lost = wish_ - wish;
        const double curvature = glm::dot(moved, lost), moved2 = glm::dot(moved, moved);
        if (curvature > 0.0) share_ = std::clamp(moved2 / curvature, 0.05, 4.0);
    }
    known_ = true;
    center_ = center;
    wish_ = wish;
    return share_;
}

}  // namespace burin::haptics
