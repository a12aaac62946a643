// SPDX-License-Identifier: MIT
#include "haptics/contact/shading.hpp"

#include <algorithm>
#include <optional>

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

std::optional<Facet> facet_of(const geometry::LocalSurface& surface, const Candidates& candidates,
                              std::uint32_t candidate) {
    const geometry::CornerNormals corners = surface.corner_normals(candidates.id(candidate));
    if (!corners.known) return std::nullopt;
    Facet facet{candidates.triangle(candidate), {}, {}};
    const geometry::Triangle& t = facet.triangle;
    facet.normal = glm::cross(t.b - t.a, t.c - t.a);
    const double least = kSmooth * std::sqrt(glm::dot(facet.normal, facet.normal));
    for (std::size_t k = 0; k < 3; ++k) {
        facet.normals[k] = Vec3(corners.normals[k]);
        if (!(glm::dot(facet.normals[k], facet.normal) >= least)) return std::nullopt;
    }
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
        const auto own = facets_.of(candidates_, touches_.places[touch].candidate);
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
            if (const auto facet = facets_.of(candidates_, touches_.places[i].candidate)) look_at(best, *facet);
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
            const auto other = facets_.of(candidates_, touches_.places[i].candidate);
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

std::optional<SmoothFacet> SmoothFacets::of(const Candidates& candidates, std::uint32_t candidate) noexcept {
    const std::uint32_t id = candidates.id(candidate);
    for (std::uint32_t i = 0; i < std::min(count_, kMost); ++i)
        if (ids_[i] == id) return is_smooth_[i] ? std::optional(facets_[i]) : std::nullopt;
    const std::uint32_t place = count_++ % kMost;
    const auto facet = facet_of(surface_, candidates, candidate);
    ids_[place] = id;
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
        if (curvature > 0.0) share_ = std::clamp(moved2 / curvature, 0.05, 2.0);
    }
    known_ = true;
    center_ = center;
    wish_ = wish;
    return share_;
}

}  // namespace burin::haptics
