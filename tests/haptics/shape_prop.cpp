// SPDX-License-Identifier: MIT
// The proxy of a tool's shape on surfaces of which nothing is known but their triangles: it stays out of them, and it
// touches where the tool in the hand would not fit. Distances by alternating projections, which know no planes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/contact/shape_proxy.hpp"
#include "haptics/contact/triangle_contact.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/haptics/turned_tools.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

using compute::test::Random;
using test::KnownTool;

// The least distance of the tool's hull from the surface.
double nearest_m(const KnownTool& tool, const Vec3& place, const Quat& orientation,
                 const geometry::LocalSurface& surface) {
    double least = HUGE_VAL;
    const Quat back = glm::conjugate(orientation);
    for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
        const geometry::Triangle t = surface.triangle(id);
        const auto in_tool = [&](const Vec3& p) { return back * (p + surface.origin_object - place); };
        const geometry::Triangle turned{in_tool(t.a), in_tool(t.b), in_tool(t.c)};
        const Vec3 lo = glm::min(glm::min(turned.a, turned.b), turned.c),
                   hi = glm::max(glm::max(turned.a, turned.b), turned.c);
        const Vec3 off = glm::max(glm::max(lo - tool.shape.bounds.hi, tool.shape.bounds.lo - hi), Vec3(0.0));
        if (glm::length(off) > std::min(least, 2.0 * tool.shape.rounding_m)) continue;
        least = std::min(least, test::distance_by_projections(turned, tool.onto_hull));
    }
    return least;
}

struct Walk {
    int ticks = 0, in_contact = 0, lost = 0, limited = 0, unfit = 0;
    double deepest = 0.0;  // of the rounding
};

// The hand goes from goal to goal over and into the surface, and turns.
Walk walk(const KnownTool& tool, const geometry::LocalSurface& surface, double reach_m, double friction, int ticks,
          std::uint64_t seed) {
    Random random(seed);
    Walk result;
    ProxyState state;
    Vec3 hand(0.0, reach_m + tool.shape.reach_m, 0.0), way(0.0);
    Quat orientation(1.0, 0.0, 0.0, 0.0), held = orientation;
    Vec3 spin(0.0);
    for (int i = 0; i < ticks; ++i, ++result.ticks) {
        if (i % 40 == 0) {
            const Vec3 goal(random.between(-1, 1) * reach_m, random.between(-0.3, 0.5) * reach_m,
                            random.between(-1, 1) * reach_m);
            way = (goal - hand) / 40.0;
            spin = 0.02 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        }
        hand += way;
        orientation = glm::normalize(Quat(1.0, 0.5 * spin.x, 0.5 * spin.y, 0.5 * spin.z) * orientation);
        const ShapeResult moved =
            move_shape(state, {hand, held, orientation, friction, friction}, tool.shape, surface, {.max_cost_ns = 1e9});
        state = moved.proxy.next;
        held = moved.orientation_object;
        result.limited += moved.proxy.work_limited;
        if (state.unfit_ticks > 0) {
            ++result.unfit;
            continue;
        }
        const bool contact = moved.proxy.constraints > 0;
        result.in_contact += contact;
        const double gap = nearest_m(tool, state.position_object_m, held, surface);
        result.deepest = std::max(result.deepest, 1.0 - gap / tool.shape.rounding_m);
        // Where the tool would reach through the surface in the hand, it is held off.
        if (!contact && nearest_m(tool, hand, orientation, surface) < 0.9 * tool.shape.rounding_m) ++result.lost;
    }
    return result;
}

geometry::LocalSurface& bumps(double edge_m) {
    static std::map<double, test::Surface> made;
    test::Surface& surface = made[edge_m];
    if (!surface) {
        surface = test::height_field(0.012, static_cast<int>(0.024 / edge_m), [](double x, double z) {
            return 0.0008 * std::sin(700.0 * x) * std::cos(900.0 * z) + 0.0004 * std::sin(2100.0 * x + 1300.0 * z);
        });
    }
    return *surface;
}

}  // namespace

TEST(ShapeProxy, StaysOutOfBumpsAndLosesNoContact) {
    const int ticks = burin::test::costly_cases(4000);
    for (const KnownTool& tool : {test::box_tool({0.002, 0.0015, 0.0025}), test::cylinder_tool(0.002, 0.006),
                                  test::cylinder_tool(0.003, 0.0015)})
        for (const double edge_m : {0.001, 0.0003})
            for (const double friction : {0.0, 0.3}) {
                const Walk found = walk(tool, bumps(edge_m), 0.005, friction, ticks, 3);
                std::printf(
                    "%s edge %.1f mm friction %.1f: %d ticks, %d in contact, %d lost, %d limited, %d unfit, "
                    "deepest %.3f\n",
                    tool.name, 1e3 * edge_m, friction, found.ticks, found.in_contact, found.lost, found.limited,
                    found.unfit, found.deepest);
                EXPECT_EQ(found.lost, 0) << tool.name;
                EXPECT_LT(found.deepest, 0.05) << tool.name;
                EXPECT_GT(found.in_contact, found.ticks / 8) << tool.name;
            }
}

}  // namespace burin::haptics
