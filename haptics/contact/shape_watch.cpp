// SPDX-License-Identifier: MIT
#include "haptics/contact/shape_watch.hpp"

#include <algorithm>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/separation.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

constexpr double kNear = 0.075;             // of the tool's width
constexpr double kComesNearer = 0.25;       // of the way
constexpr double kSeenFromOutside = -0.02;  // least cosine between the triangle's normal and the plane's
constexpr std::uint32_t kMostShapeLooks = 2000;

// Visits the triangles within reach of the rounded tool until a visit decides: visit(separation, triangle's normal in
// the tool's axes).
template <typename Visit>
Held search(const PosedShape& tool, double reach, const geometry::PosedSurface& surface, ContactWork& work,
            Visit&& visit) {
    const glm::dmat3 turn = glm::mat3_cast(tool.orientation);
    const Box& box = tool.shape.bounds;
    Box around;
    for (int corner = 0; corner < 8; ++corner)
        around.include(tool.place + turn * Vec3((corner & 1) != 0 ? box.hi.x : box.lo.x,
                                                (corner & 2) != 0 ? box.hi.y : box.lo.y,
                                                (corner & 4) != 0 ? box.hi.z : box.lo.z));
    geometry::Near near{.lo = around.lo, .hi = around.hi, .reach_m = reach};
    near.looks_left = kMostShapeLooks;
    Held held = Held::no;
    std::uint32_t tests = 0;
    const bool complete =
        geometry::for_each_triangle_near(surface, near, [&](std::uint32_t id, const geometry::Triangle& object) {
            const geometry::Triangle t{(object.a - tool.place) * turn, (object.b - tool.place) * turn,
                                       (object.c - tool.place) * turn};
            const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
            const Vec3 off = glm::max(glm::max(lo - box.hi, box.lo - hi), Vec3(0.0));
            if (glm::dot(off, off) > reach * reach) return true;
            if (++tests > kMostShapeTests) {
                held = Held::unknown;
                return false;
            }
            ++work.triangles_tested;
            const Vec3 face = outward_normal(t);
            const SeparationQuery query{Vec3(0.0), face, tool.shape.rounding_m + reach, 0.05 * tool.shape.rounding_m};
            for (std::uint32_t i = 0; i < tool.shape.piece_count; ++i) {
                const Separation found = separation(tool.shape, tool.shape.pieces[i], t, query);
                work.supports += found.supports;
                const bool outside =
                    found.overlaps || surface.two_sided(id) || glm::dot(face, found.normal) >= kSeenFromOutside;
                if (!outside || !visit(found)) continue;
                held = Held::yes;
                return false;
            }
            return true;
        });
    work.triangles_seen += kMostShapeLooks - near.looks_left;
    return held == Held::no && !complete ? Held::unknown : held;
}

}  // namespace

Held is_held(const PosedShape& tool, const Vec3& way, const geometry::PosedSurface& surface,
             ContactWork& work) noexcept {
    const double reach = kNear * tool.shape.size_m;
    const Vec3 way_of_tool = glm::conjugate(tool.orientation) * way;
    return search(tool, reach, surface, work, [&](const Separation& found) {
        return !found.overlaps && found.gap_m <= tool.shape.rounding_m + reach &&
               -glm::dot(found.normal, way_of_tool) > kComesNearer;
    });
}

Held touches_something(const PosedShape& tool, const geometry::PosedSurface& surface, ContactWork& work) noexcept {
    return search(tool, 0.0, surface, work,
                  [&](const Separation& found) { return found.overlaps || found.gap_m <= tool.shape.rounding_m; });
}

}  // namespace burin::haptics
