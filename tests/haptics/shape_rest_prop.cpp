// SPDX-License-Identifier: MIT
// Rest is rest for a tool's shape as well: under a hand that holds still it holds still, to the last bit, on rough
// meshes and on carved tiles, with and without friction.
#include <gtest/gtest.h>

#include <vector>

#include "haptics/contact/shape_proxy.hpp"
#include "tests/haptics/rough_surfaces.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

struct ShapeRests {
    int rests = 0, restless = 0, in_contact = 0;
};

// The hand brings the tool, turned anyhow, to a place a little inside the surface, and holds still there.
ShapeRests rest_shape_at_many_places(const geometry::LocalSurface& surface, const ToolShape& shape, double friction,
                                     int times, std::uint64_t seed) {
    constexpr int kWay = 60, kSettling = 300, kStill = 40;
    compute::test::Random random(seed);
    const auto anywhere = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
    ShapeRests result;
    for (int i = 0; i < times; ++i) {
        const geometry::Triangle t =
            surface.triangle(static_cast<std::uint32_t>(random.between(0.0, 0.999) * surface.triangles()));
        if (geometry::is_degenerate(t)) continue;
        const Vec3 up = glm::normalize(glm::cross(t.b - t.a, t.c - t.a)), turn = anywhere();
        Quat held = glm::normalize(Quat(1.0, turn.x, turn.y, turn.z));
        const Quat wanted = held;
        const Vec3 place = surface.origin_object + t.a - held * shape.inside_m;
        const Vec3 from = place + 1.5 * shape.reach_m * up;
        const Vec3 to = place + random.between(0.0, 0.5) * shape.size_m * up;
        ProxyState state;
        const auto put = [&](const Vec3& hip) {
            const ShapeResult r = move_shape(state, {hip, held, wanted, friction, friction}, shape, surface);
            state = r.proxy.next;
            held = r.orientation_object;
            return r.proxy;
        };
        for (int k = 0; k <= kWay; ++k) put(from + (to - from) * (double(k) / kWay));
        for (int k = 0; k < kSettling; ++k) put(to);
        const Vec3 rest = state.position_object_m;
        bool still = true, contact = false;
        for (int k = 0; k < kStill; ++k) {
            contact = put(to).constraints > 0;
            still = still && state.position_object_m == rest;
        }
        ++result.rests;
        result.restless += !still;
        result.in_contact += contact;
    }
    return result;
}

// `times`: in the soak.
void expect_shapes_rest(const geometry::LocalSurface& surface, double size_of_edge, int times) {
    const std::uint64_t seed = burin::test::property_cases().seed;
    int rests = 0, in_contact = 0;
    for (const test::NamedTool& tool : test::session_tools(size_of_edge * surface.mean_edge_m()))
        for (const double friction : {0.0, 0.3}) {
            const ShapeRests found =
                rest_shape_at_many_places(surface, tool.shape, friction, burin::test::costly_cases(times), seed);
            EXPECT_EQ(found.restless, 0) << tool.name << " of " << size_of_edge << " edges, friction " << friction;
            rests += found.rests;
            in_contact += found.in_contact;
        }
    EXPECT_GT(in_contact, rests / 4) << "of " << rests;
}

}  // namespace

TEST(ShapeRest, AToolOnARoughMeshHoldsStillUnderAStillHand) {
    const test::Surface coarse = test::rough_ball(4, 0.2, 1), fine = test::rough_ball(5, 0.1, 2);
    expect_shapes_rest(*coarse, 1.5, 30);
    expect_shapes_rest(*fine, 6.0, 30);
}

TEST(ShapeRest, AToolOnCarvedNoiseHoldsStillUnderAStillHand) { expect_shapes_rest(*test::noise_tiles(), 0.7, 20); }

}  // namespace burin::haptics
