// SPDX-License-Identifier: MIT
// Rest is rest: a hand that holds still feels a proxy that holds still, to the last bit, whatever the probe, the
// shading and the friction. On rough surfaces, where the interpolated normals know no place of rest.
#include <gtest/gtest.h>

#include <vector>

#include "haptics/contact/god_object.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/rough_surfaces.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

struct Rests {
    int rests = 0, restless = 0, in_contact = 0;
};

// The hand comes to a place a little inside the surface on a way of its own, and stays there.
Rests rest_at_many_places(const geometry::LocalSurface& surface, const ProxySettings& settings, int times,
                          std::uint64_t seed) {
    constexpr int kWay = 60, kSettling = 200, kStill = 40;
    compute::test::Random random(seed);
    const double edge = surface.mean_edge_m();
    const auto anywhere = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
    Rests result;
    for (int i = 0; i < times; ++i) {
        const geometry::Triangle t =
            surface.triangle(static_cast<std::uint32_t>(random.between(0.0, 0.999) * surface.triangles()));
        if (geometry::is_degenerate(t)) continue;
        const Vec3 up = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
        const Vec3 place = surface.origin_object + t.a + settings.contact_radius_m * up;
        const Vec3 from = place + (2.0 * edge) * up + edge * anywhere();
        const Vec3 to = place - random.between(0.1, 3.0) * edge * up + 2.0 * edge * anywhere();
        ProxyState state;
        const auto put = [&](const Vec3& hip) {
            const ProxyResult r = move_proxy(state, hip, settings, surface);
            state = r.next;
            return r;
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
void expect_rest(const geometry::LocalSurface& surface, const std::vector<double>& radii_in_edges, int times) {
    const std::uint64_t seed = burin::test::property_cases().seed;
    int rests = 0, in_contact = 0;
    for (const double radius : radii_in_edges)
        for (const bool shading : {false, true})
            for (const double friction : {0.0, 0.3}) {
                ProxySettings settings;
                settings.contact_radius_m = radius * surface.mean_edge_m();
                settings.shading = shading;
                settings.static_friction = settings.dynamic_friction = friction;
                const Rests found = rest_at_many_places(surface, settings, burin::test::costly_cases(times), seed);
                EXPECT_EQ(found.restless, 0) << radius << " edges, shading " << shading << ", friction " << friction;
                rests += found.rests;
                in_contact += found.in_contact;
            }
    // In carved noise a ball of several edges mostly begins where it does not fit, and is set down beside it: a few
    // rests in contact are enough to tell. Under a sanitizer each ball has a single rest, so all are counted together.
    EXPECT_GT(in_contact, rests / 10) << "of " << rests;
}

}  // namespace

TEST(Rest, AProxyOnARoughMeshHoldsStillUnderAStillHand) {
    expect_rest(*test::rough_ball(4, 0.2, 1), {0.0, 0.5, 1.0, 3.5}, 160);
    expect_rest(*test::rough_ball(5, 0.1, 2), {7.0, 14.0}, 60);
}

TEST(Rest, AProxyOnCarvedNoiseHoldsStillUnderAStillHand) {
    expect_rest(*test::noise_tiles(), {0.0, 0.5, 2.0, 4.0}, 80);
}

}  // namespace burin::haptics
