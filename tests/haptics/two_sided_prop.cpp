// SPDX-License-Identifier: MIT
// Surfaces without thickness: a tube touched from inside and from outside, and a single sheet around whose edge a ball
// can go. The side is the one on which the proxy is.
#include <gtest/gtest.h>

#include <numbers>

#include "haptics/contact/god_object.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

constexpr double kTube = 12 * kMm, kLength = 200 * kMm;
constexpr int kSides = 24, kRings = 60;
// Chords lie inside the circle by this much.
const double kSagitta = kTube * (1.0 - std::cos(std::numbers::pi / kSides));

double bend(double y) { return 20 * kMm * std::sin(3.0 * (y / kLength + 0.5)); }

// A bent tube of triangles without thickness, open at both ends.
test::Surface tube() {
    geometry::TriangleMesh mesh;
    for (int j = 0; j <= kRings; ++j)
        for (int i = 0; i < kSides; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / kSides, y = kLength * (double(j) / kRings - 0.5);
            mesh.positions_m.push_back({bend(y) + kTube * std::cos(angle), y, kTube * std::sin(angle)});
        }
    for (std::uint32_t j = 0; j < kRings; ++j)
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t a = j * kSides + i, b = j * kSides + (i + 1) % kSides;
            mesh.triangles.push_back({a, a + kSides, b});
            mesh.triangles.push_back({b, a + kSides, b + kSides});
        }
    test::Surface surface = test::touchable(mesh);
    surface->meshes[0].two_sided = true;
    return surface;
}

double from_axis(const Vec3& p) { return std::sqrt((p.x - bend(p.y)) * (p.x - bend(p.y)) + p.z * p.z); }

}  // namespace

TEST(TwoSided, ATubeIsFeltFromInsideAndFromOutsideWithoutALostTick) {
    const test::Surface surface = tube();
    compute::test::Random random(1);
    int felt = 0, ticks = 0;
    for (const double radius : {0.0, 1 * kMm, 3 * kMm, 8 * kMm})
        for (const bool shading : {false, true})
            for (const bool inside : {false, true})
                for (int run = 0; run < compute::test::repeated(16); ++run) {
                    double y = random.between(-80, 80) * kMm, angle = random.between(0.0, 6.28);
                    const double turn = random.between(-7.5e-3, 7.5e-3), along = random.between(-0.05, 0.05) * kMm;
                    const auto hand = [&](double distance) {
                        return Vec3(bend(y) + distance * std::cos(angle), y, distance * std::sin(angle));
                    };
                    const double resting = inside ? kTube - radius : kTube + radius;
                    ProxyState state;
                    for (int i = 0; i < 600; ++i) {
                        angle += turn;
                        y = std::clamp(y + along, -90 * kMm, 90 * kMm);
                        // From 1 mm before the wall to 2 mm behind it, at 20 mm/s.
                        const double press = std::min(-1.0 + 0.02 * i, 2.0) * kMm;
                        const ProxyResult r = move_proxy(state, hand(inside ? resting + press : resting - press),
                                                         {radius, shading}, *surface);
                        state = r.next;
                        const double now = from_axis(state.position_object_m);
                        if (inside)
                            ASSERT_LT(now, kTube - 0.99 * radius + 0.01 * kMm) << radius << ' ' << shading << ' ' << i;
                        else
                            ASSERT_GT(now, kTube + 0.99 * radius - 1.5 * kSagitta)
                                << radius << ' ' << shading << ' ' << i;
                        if (press < 0.5 * kMm) continue;
                        ++ticks;
                        felt += r.constraints > 0;
                    }
                }
    EXPECT_EQ(felt, ticks);
    EXPECT_GT(ticks, 1000);
}

TEST(TwoSided, ABallGoesAroundTheEdgeOfASheetAndIsThenOnItsOtherSide) {
    test::Surface surface = test::touchable([] {
        geometry::TriangleMesh mesh;
        mesh.positions_m = {{0, 0, 0}, {0.02, 0, 0}, {0.02, 0, 0.02}, {0, 0, 0.02}};
        mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
        return mesh;
    }());
    surface->meshes[0].two_sided = true;
    const double radius = 2 * kMm;
    for (const bool shading : {false, true}) {
        ProxyState state;
        ProxyResult last;
        const auto go = [&](const Vec3& to) {
            const Vec3 from = state.hip_object_m;
            for (int i = 1; i <= 300; ++i) {
                last = move_proxy(state, from + (to - from) * (i / 300.0), {radius, shading}, *surface);
                state = last.next;
            }
        };
        state.hip_object_m = {0.01, 0.01, 0.01};
        go({0.01, -0.001, 0.01});  // pressed onto it from above
        EXPECT_NEAR(state.position_object_m.y, radius, 0.01 * kMm);
        EXPECT_GT(last.normal_object.y, 0.99);
        go({0.03, -0.001, 0.01});  // past the edge
        go({0.03, -0.01, 0.01});
        go({0.01, -0.01, 0.01});  // below it
        go({0.01, 0.001, 0.01});  // and pressed onto it from below
        EXPECT_NEAR(state.position_object_m.y, -radius, 0.01 * kMm);
        EXPECT_LT(last.normal_object.y, -0.99);
        EXPECT_GT(last.constraints, 0u);
    }
}

TEST(TwoSided, AMeshThatIsNotIsStillFeltFromOutsideAlone) {
    test::Surface surface = tube();
    surface->meshes[0].two_sided = false;
    ProxyState state;
    for (int i = 0; i < 100; ++i)  // from inside, where its back is
        state = move_proxy(state, {bend(0.0) + i * 0.2 * kMm, 0.0, 0.0}, {1 * kMm, true}, *surface).next;
    EXPECT_NEAR(state.position_object_m.x - bend(0.0), 19.8 * kMm, 1e-9);
}

}  // namespace burin::haptics
