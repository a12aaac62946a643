// SPDX-License-Identifier: MIT
#include "haptics/contact/candidates.hpp"

#include <algorithm>

#include "geometry/contact/local_surface_search.hpp"

namespace burin::haptics {
namespace {

// Tests that a triangle lies beside a segment: the bounding box of a long segment also holds triangles far from it, and
// planes near it are few.
class BesideSegment {
public:
    BesideSegment(const Way& way, double reach) noexcept
        : from_(way.from), motion_(way.to - way.from), reach2_(reach * reach) {
        const double length2 = glm::dot(motion_, motion_);
        along_ = Vec3f(motion_);
        by_length2_ = length2 > 0.0 ? along_ / static_cast<float>(length2) : Vec3f(0.0f);
        near_way_ = static_cast<float>(reach + 1.6e-6 * (reach + std::sqrt(length2)));
    }
    // The ball's centre is relative to the segment's beginning.
    [[nodiscard]] bool is_beside(const TriangleBall& ball) const noexcept {
        const float share = glm::dot(ball.middle, by_length2_);
        const Vec3f off = ball.middle - (share < 0.0f ? 0.0f : (share > 1.0f ? 1.0f : share)) * along_;
        const float limit = near_way_ + std::sqrt(ball.size2);
        return glm::dot(off, off) * (1.0f - 4e-6f) > limit * limit;
    }
    // Compares squares scaled by the normal's length, so that planes too far away cost no square root.
    [[nodiscard]] bool is_above_or_below(const geometry::Triangle& t, const Vec3& normal,
                                         double normal2) const noexcept {
        const double at_start = glm::dot(normal, from_ - t.a), at_end = at_start + glm::dot(normal, motion_);
        const double limit = reach2_ * normal2;
        return at_start * at_end > 0.0 && at_start * at_start > limit && at_end * at_end > limit;
    }

private:
    Vec3 from_, motion_;
    double reach2_;
    Vec3f along_{0.0f}, by_length2_{0.0f};
    float near_way_ = 0.0f;
};

}  // namespace

Candidates::Gathered Candidates::gather(const geometry::PosedSurface& surface, const Query& query,
                                        std::uint32_t& looks_left) noexcept {
    const Way& way = way_ = query.way;
    slack_ = -1.0;
    const double reach = query.radius + query.slack, length = glm::length(way.to - way.from);
    fours_.begin(way.from, reach + length, surface.mean_edge_m());
    points_.begin(way.from, reach + length);
    const BesideSegment beside(way, reach);
    const bool any_two_sided = std::ranges::any_of(surface.surface().meshes, &geometry::TouchedMesh::two_sided);
    auto gathered = Gathered::all;
    const auto add_triangle = [&](std::uint32_t id, const geometry::Triangle& t) {
        const TriangleBall ball = fours_.ball_around(t);
        if (beside.is_beside(ball)) return true;
        const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const double normal2 = glm::dot(normal, normal);
        if (beside.is_above_or_below(t, normal, normal2)) return true;
        if (fours_.count() == query.most_triangles) {
            gathered = Gathered::too_many_triangles;
            return false;
        }
        const std::uint32_t i = fours_.count();
        ids_[i] = id;
        triangles_[i] = t;
        two_sided_[i] = any_two_sided && surface.two_sided(id);
        fours_.add(t, normal / std::sqrt(normal2), ball, two_sided_[i]);
        return true;
    };
    const auto add_point = [&](const geometry::SurfacePoint& point) {
        if (points_.count() == query.most_points) {
            gathered = Gathered::too_many_points;
            return false;
        }
        points_.add(point);
        return true;
    };
    geometry::Near near{
        glm::min(way.from, way.to), glm::max(way.from, way.to), reach, looks_left, true, way.from, way.to};
    const bool complete =
        geometry::for_each_near(surface, near, geometry::MixedVisitor{add_triangle, add_point, query.fineness});
    looks_left = near.looks_left;
    if (gathered != Gathered::all) return gathered;
    if (!complete) return Gathered::out_of_looks;
    fours_.end();
    points_.end();
    slack_ = query.slack;
    return Gathered::all;
}

}  // namespace burin::haptics
