// SPDX-License-Identifier: MIT
// The way of a tool that its hand leads away: whether anything is between the two.
//
// The tool is convex, so where it is beyond a triangle's plane at both ends of a straight way it is all along; most of
// a groove's walls are settled by that, whole groups of them at once, and nothing has to be gathered. In its own bed a
// tool lies between facets that may stand out by more than the clearance. These are not in its way: it has been there.
#include <algorithm>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/shape_search.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Of the work left: what a look at the way may take.
constexpr double kOfWorkForWay = 0.85;
// Edges up to this share of the tool's width are passed by their vertices.
constexpr double kFineForWay = 0.1;
// Cosine of normals between which a tool lies.
constexpr double kOpposes = -0.5;

}  // namespace

// What is found on a way.
struct ShapeSearch::WaySeen {
    Vec3 step{0.0};
    double squeezed_m = 0.0;
    Vec3 first{0.0};  // the normal of the first face that is near the tool
    bool lies_between = false, is_deep = false;
};

bool ShapeSearch::is_way_free(const Vec3& at, const Vec3& step, double squeezed_m) noexcept {
    const double floor_ns = (1.0 - kOfWorkForWay) * left_ns(), slack = 0.5 * glm::length(step);
    const double stop = rounding_ * (1.0 - 2.0 * kEdge);
    gathered_at_ = at + 0.5 * step;
    WaySeen seen{step, squeezed_m};
    bool free = true;
    geometry::Near near = near_tool(gathered_at_, slack);
    const std::uint32_t most_looks = near.looks_left = affords(0.5 * kOfWorkForWay, WorkCost::kLook_ns);
    const auto pass = [&](const geometry::Triangle& object, const Vec3& normal, std::uint32_t id, bool is_vertex) {
        const Vec3 a = to_tool(object.a), b = to_tool(object.b), c = to_tool(object.c);
        if (is_beside(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), slack)) return true;
        free = left_ns() > floor_ns && passes(candidate_of(object, normal, id, is_vertex), at, seen);
        return free;
    };
    const auto add_triangle = [&](std::uint32_t id, const geometry::Triangle& t) {
        return pass(t, outward_normal(t), id, false);
    };
    const auto add_vertex = [&](const geometry::SurfacePoint& point) {
        return pass({point.position, point.position, point.position}, point.normal(), kNoId, true);
    };
    Vec3 last_normal(0.0);
    double lowest = 0.0;
    const auto skips = [&](const Box& box, const geometry::TriangleSlab& slab) {
        ++work_.triangles_seen;
        const Vec3 size = 0.5 * (box.hi - box.lo), center = to_tool(0.5 * (box.lo + box.hi));
        const Vec3 half(glm::dot(glm::abs(turn_[0]), size), glm::dot(glm::abs(turn_[1]), size),
                        glm::dot(glm::abs(turn_[2]), size));
        if (is_beside(center - half, center + half, slack)) return true;
        const Vec3 normal(slab.normal);
        if (normal == Vec3(0.0)) return false;
        const Vec3 turned = to_tool(normal);
        if (normal != last_normal) last_normal = normal, lowest = glm::dot(lowest_along(turned), turned);
        const double from = lowest + glm::dot(at, turned) - static_cast<double>(slab.top_m);
        return std::min(from, from + glm::dot(step, turned)) >= stop;
    };
    const bool complete = geometry::for_each_near(
        surface_, near,
        geometry::SkippingVisitor{add_triangle, add_vertex, geometry::Fineness{kFineForWay * shape_.size_m, 1}, skips});
    work_.triangles_seen += most_looks - near.looks_left;
    return complete && free && (!seen.is_deep || seen.lies_between);
}

// Whether the tool goes past a triangle and is clear of it then.
bool ShapeSearch::passes(Candidate c, const Vec3& at, WaySeen& seen) noexcept {
    const double stop = rounding_ * (1.0 - 2.0 * kEdge);
    const Vec3 to = at + seen.step;
    const bool is_left = leaves(c, seen.step);
    if (passes_a_side(c, at, seen.step, stop)) return true;
    if (!c.two_sided && c.face != Vec3(0.0)) {
        const Vec3 deepest = to + lowest_along(c.face);
        const double after = glm::dot(c.face, deepest) - c.height, before = after - glm::dot(c.face, seen.step);
        const double height = is_left && !c.is_vertex ? after : std::min(after, before);
        if (height < rounding_ + seen.squeezed_m && height > stop - seen.squeezed_m) {
            seen.lies_between = seen.lies_between || glm::dot(seen.first, c.face) < kOpposes;
            if (seen.first == Vec3(0.0)) seen.first = c.face;
        }
        if (height >= stop) return true;
        // The place that is the deepest behind its plane is beneath the triangle itself, or nearly.
        const Vec3 off = deepest - nearest_on_triangle(deepest, c.triangle).point;
        const double near = 2.0 * rounding_;
        if (glm::dot(off, off) <= after * after + near * near) {
            if (height >= stop - seen.squeezed_m) return seen.is_deep = true;
            if (after < stop) return false;
        }
    }
    ++work_.triangles_tested;
    const Separation s = from(c, to, rounding_);
    if (s.overlaps || (s.gap_m < stop && faces(c, s.normal))) return false;
    return is_left || until(c, at, seen.step) > 1.0;
}

}  // namespace burin::haptics
