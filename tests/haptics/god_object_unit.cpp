// SPDX-License-Identifier: MIT
// The proxy against closed forms: where a ball must rest on shapes simple enough to say so.
#include "haptics/contact/god_object.hpp"

#include <gtest/gtest.h>

#include <array>

#include "haptics/contact/touching.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

using test::Surface;

// Walks the HIP in straight steps and returns the last result; gives the proxy time to arrive.
struct Walker {
    const geometry::LocalSurface* surface;
    double radius;
    ProxyState state{};
    Vec3 hip{0.0};
    ProxyResult last{};

    ProxyResult put(const Vec3& to) {
        last = move_proxy(state, to, {radius}, *surface);
        state = last.next;
        hip = to;
        return last;
    }
    ProxyResult walk(const Vec3& to, double step) {
        const Vec3 from = hip;
        const int n = std::max(1, static_cast<int>(std::ceil(glm::length(to - from) / step)));
        for (int i = 1; i <= n; ++i) put(from + (to - from) * (double(i) / n));
        return last;
    }
    [[nodiscard]] Vec3 proxy() const { return last.next.position_object_m; }
};

}  // namespace

TEST(GodObject, InFreeSpaceTheProxyIsTheHipToTheLastBit) {
    const Surface plane = test::plane();
    Walker w{plane.get(), 5 * kMm};
    for (int i = 0; i < 1000; ++i) {
        const Vec3 hip(0.03 * std::sin(0.01 * i), 0.0053 + 1e-4 * std::cos(0.1 * i), 0.02 * std::cos(0.013 * i));
        w.put(hip);
        EXPECT_EQ(w.proxy(), hip);
        EXPECT_EQ(w.last.constraints, 0u);
    }
}

TEST(GodObject, BallOnAPlaneRestsOneRadiusAboveIt) {
    const Surface plane = test::plane();
    for (const double radius : {0.0, 1 * kMm, 5 * kMm}) {
        Walker w{plane.get(), radius};
        w.put({0.0013, 0.02, -0.0007});
        w.walk({0.0113, -0.004, 0.0057}, 1e-4);
        // A point probe is a ball of 1/500 edge (10 mm squares: edges 10 and 14 mm).
        const double rest = radius > 0 ? radius : 0.0;
        const double tolerance = radius > 0 ? 1e-9 : 0.0142 / 500;
        EXPECT_NEAR(w.proxy().y, rest, tolerance) << radius;
        EXPECT_NEAR(w.proxy().x, 0.0113, 1e-7 + 1e-4 * radius) << radius;
        EXPECT_NEAR(w.proxy().z, 0.0057, 1e-7 + 1e-4 * radius) << radius;
        EXPECT_EQ(w.last.constraints, 1u);
        EXPECT_FALSE(w.last.work_limited);
    }
}

TEST(GodObject, BallInAVGrooveTouchesBothWalls) {
    // Walls at 45 degrees: the ball's centre rests sqrt(2) R above the bottom line.
    const Surface v = test::height_field(0.05, 20, [](double x, double) { return std::abs(x); });
    const double radius = 4 * kMm;
    Walker w{v.get(), radius};
    w.put({0.002, 0.03, 0.001});
    w.walk({0.0, 0.0, 0.003}, 1e-4);
    EXPECT_NEAR(w.proxy().x, 0.0, 1e-8);
    EXPECT_NEAR(w.proxy().y, std::sqrt(2.0) * radius, 1e-8);
    EXPECT_NEAR(w.proxy().z, 0.003, 1e-4 * radius);
    EXPECT_EQ(w.last.constraints, 2u);
}

TEST(GodObject, BallInACornerTouchesThreeWalls) {
    // The inner corner of a room: three walls of a box turned inside out.
    test::SurfaceBuilder b;
    const double s = 0.05;
    b.quad(Vec3(0, 0, 0), Vec3(0, 0, s), Vec3(s, 0, s), Vec3(s, 0, 0));
    b.quad(Vec3(0, 0, 0), Vec3(0, s, 0), Vec3(0, s, s), Vec3(0, 0, s));
    b.quad(Vec3(0, 0, 0), Vec3(s, 0, 0), Vec3(s, s, 0), Vec3(0, s, 0));
    const Surface room = b.finish();
    const double radius = 3 * kMm;
    Walker w{room.get(), radius};
    w.put({0.01, 0.02, 0.015});
    w.walk({-0.004, -0.002, -0.006}, 2e-4);
    EXPECT_NEAR(w.proxy().x, radius, 1e-8);
    EXPECT_NEAR(w.proxy().y, radius, 1e-8);
    EXPECT_NEAR(w.proxy().z, radius, 1e-8);
    EXPECT_EQ(w.last.constraints, 3u);
}

TEST(GodObject, BallOnASphereStandsBetweenFacetAndVertexHeight) {
    const double big = 0.03, radius = 4 * kMm;
    const Surface sphere = test::sphere(big, 4);  // edges about 2.2 mm, facets up to e^2/(8 big)*... inside the sphere
    const double edge = sphere->mean_edge_m();
    const double sagitta = 1.2 * edge * edge / (6.0 * big);  // circumradius e/sqrt(3): depth e^2/(6 big), edges vary
    Walker w{sphere.get(), radius};
    w.put({0.0, 0.05, 0.0});
    for (int i = 0; i <= 400; ++i) {
        const double a = 0.004 * i;
        const Vec3 way(std::sin(a) * std::cos(0.7 * a), std::cos(a), std::sin(a) * std::sin(0.7 * a));
        w.put((big + radius - 2 * kMm) * way);
        const double height = glm::length(w.proxy());
        EXPECT_LE(height, big + radius + 1e-7);
        EXPECT_GE(height, big + radius - sagitta);
        // Directly over the HIP, give or take the facet's tilt.
        EXPECT_LT(glm::length(w.proxy() / height - way), edge / big);
    }
}

TEST(GodObject, ActiveTriangleLiesUnderTheProxy) {
    const Surface plane = test::plane(0.05, 10);
    Walker w{plane.get(), 2 * kMm};
    w.put({0.0, 0.02, 0.0});
    for (int i = 0; i < 300; ++i) {
        w.put({0.04 * std::sin(0.02 * i), -0.001, 0.04 * std::cos(0.03 * i)});
        ASSERT_NE(w.last.active_triangle, 0xffffffffu);
        const geometry::Triangle active = plane->triangle(w.last.active_triangle);
        Box box;
        for (const Vec3& corner : {active.a, active.b, active.c}) box.include(corner);
        const double slack = 0.05 * 2 * kMm;  // a touched neighbour: within sqrt(2 * 1e-3) R
        EXPECT_GE(w.proxy().x, box.lo.x - slack);
        EXPECT_LE(w.proxy().x, box.hi.x + slack);
        EXPECT_GE(w.proxy().z, box.lo.z - slack);
        EXPECT_LE(w.proxy().z, box.hi.z + slack);
    }
}

TEST(GodObject, DoesNotPassThroughAThinSheetFromEitherSideAtTwoMetresASecond) {
    const Surface sheet = test::box({-0.05, -5e-5, -0.05}, {0.05, 5e-5, 0.05}, 9);  // 0.1 mm thick
    for (const double radius : {0.0, 3 * kMm})
        for (const double side : {1.0, -1.0})
            for (const double slant : {0.0, 0.7, 3.0}) {
                Walker w{sheet.get(), radius};
                w.put({-0.01, side * 0.02, 0.003});
                const Vec3 way = glm::normalize(Vec3(slant, -side, 0.3 * slant));
                for (int i = 0; i < 12; ++i) {  // 2 mm a tick
                    w.put(w.hip + 2 * kMm * way);
                    EXPECT_GT(side * w.proxy().y, 0.9 * radius) << radius << ' ' << side << ' ' << slant;
                }
            }
}

TEST(GodObject, SlidesOverLevelFacetEdgesWithoutSticking) {
    // Facets far smaller than the ball: the ball's nearest point crosses an edge every few ticks.
    for (const int n : {7, 40, 120}) {
        const Surface plane = test::plane(0.03, n);
        for (const double radius : {0.0, 0.5 * kMm, 6 * kMm}) {
            Walker w{plane.get(), radius};
            w.put({-0.02, 0.02, -0.0031});
            w.walk({-0.02, -0.001, -0.0031}, 1e-4);
            for (int i = 0; i < 400; ++i) {
                w.put(w.hip + Vec3(1e-4, 0.0, 0.37e-4));
                EXPECT_NEAR(w.proxy().x, w.hip.x, 2e-6) << n << ' ' << radius;
                EXPECT_NEAR(w.proxy().z, w.hip.z, 2e-6) << n << ' ' << radius;
                EXPECT_FALSE(w.last.work_limited);
            }
        }
    }
}

TEST(GodObject, ForceDirectionTurnsByNoMoreThanAFacetAngleOnASphere) {
    const double big = 0.03;
    const Surface sphere = test::sphere(big, 3);
    const double facet_angle = 1.5 * sphere->mean_edge_m() / big;  // neighbours' normals differ by less
    for (const double radius : {0.0, 2 * kMm, 8 * kMm}) {
        Walker w{sphere.get(), radius};
        w.put({0.0, 0.06, 0.0});
        const double depth = 1 * kMm;
        Vec3 last_way(0.0);
        for (int i = 0; i <= 1500; ++i) {
            const double a = 0.002 * i;
            w.put((big + radius - depth) * Vec3(std::sin(a) * 0.8, std::cos(a), std::sin(a) * 0.6));
            const Vec3 way = glm::normalize(w.proxy() - w.hip);
            if (i > 0) {
                EXPECT_LT(glm::length(way - last_way), facet_angle) << radius << " " << i;
            }
            last_way = way;
        }
    }
}

TEST(GodObject, FollowsTheHipWhenTheSurfaceRecedes) {
    const double radius = 5 * kMm;
    const Surface before = test::plane(0.05, 20, 0.0);
    Surface after = test::plane(0.05, 20, -4 * kMm);
    after->sequence = 2;
    Walker w{before.get(), radius};
    w.put({0.0, 0.02, 0.0});
    w.walk({0.0, 2 * kMm, 0.0}, 1e-4);
    EXPECT_NEAR(w.proxy().y, radius, 1e-8);
    w.surface = after.get();
    w.put(w.hip);
    EXPECT_EQ(w.proxy(), w.hip);  // now one millimetre above the carved surface
    EXPECT_EQ(w.last.constraints, 0u);
}

TEST(GodObject, IsPutOutsideTheNearestWayWhenItStartsInsideMaterial) {
    const Surface block = test::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}, 8);
    const double radius = 3 * kMm;
    for (const Vec3 start : {Vec3(0.018, 0.001, 0.002), Vec3(0.003, -0.013, 0.001), Vec3(-0.0192, 0.0191, 0.0)}) {
        Walker w{block.get(), radius};
        w.put(start);
        EXPECT_TRUE(w.last.pushed_out);
        // Outside by a radius on the side that was nearest.
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (std::abs(start[i]) > std::abs(start[axis])) axis = i;
        EXPECT_NEAR(std::abs(w.proxy()[axis]), 0.02 + radius, 1e-7) << start.x;
        EXPECT_GT(w.proxy()[axis] * start[axis], 0.0);
    }
}

TEST(GodObject, MaterialThatGrowsOverTheProxyPushesItOut) {
    const double radius = 4 * kMm;
    const Surface before = test::plane(0.05, 20, 0.0);
    for (const double rise : {1 * kMm, 3 * kMm, 7 * kMm}) {
        Surface after = test::plane(0.05, 20, rise);
        after->sequence = 2;
        Walker w{before.get(), radius};
        w.put({0.0, 0.02, 0.0});
        w.walk({0.0, 3.9 * kMm, 0.0}, 1e-4);
        w.surface = after.get();
        w.put(w.hip);
        EXPECT_NEAR(w.proxy().y, rise + radius, 1e-7) << rise;
    }
}

TEST(GodObject, ABallInItsOwnNoisyGrooveDoesNotJitter) {
    // Facets of 0.16 R, corners off the circle by 0.2 % of R; contact ball 2 % smaller, as the tick makes it.
    const double radius = 5 * kMm;
    const Surface groove = test::groove(radius, 0.04, 20, 50, 1e-5);
    Walker w{groove.get(), 0.98 * radius};
    w.put({0.0, 0.01, -0.012});
    w.walk({0.0, -3 * kMm, -0.012}, 1e-4);
    Vec3 last = w.proxy();
    double worst = 0.0, lowest = 1.0, highest = -1.0;
    int limited = 0;
    for (int i = 0; i < 2000; ++i) {  // 12 mm/s along the groove, swaying 0.6 mm at 2 Hz
        w.put({0.6 * kMm * std::sin(0.0126 * i), -3 * kMm, -0.012 + 12e-6 * i});
        worst = std::max(worst, glm::length(w.proxy() - last));
        lowest = std::min(lowest, w.proxy().y);
        highest = std::max(highest, w.proxy().y);
        last = w.proxy();
        limited += w.last.work_limited;
    }
    EXPECT_LE(limited, 10);  // of 2000: a proxy that arrives a tick later is allowed, not a proxy that never arrives
    // The bottom lies 0.1 mm below the centre of the circle; chords and noise take up to 3 % of R of it.
    EXPECT_GT(lowest, -0.02 * radius - 3e-5);
    EXPECT_LT(highest, 0.03 * radius);
    // The noise tilts facets of 0.8 mm by up to 0.025 either way; under a HIP 3 mm deep the foot moves as much as that.
    EXPECT_LT(worst, 2 * 0.025 * 3 * kMm);
}

TEST(GodObject, MillimetresAndMetresGiveTheSameMotion) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        const auto shape = [scale](double x, double z) {
            return 0.3 * scale * std::sin(3.0 * x / scale) * std::cos(2.0 * z / scale);
        };
        const Surface wavy = test::height_field(2.0 * scale, 40, shape);
        const Surface unit =
            test::height_field(2.0, 40, [](double x, double z) { return 0.3 * std::sin(3.0 * x) * std::cos(2.0 * z); });
        Walker w{wavy.get(), 0.2 * scale}, u{unit.get(), 0.2};
        int compared = 0;
        for (int i = 0; i < 500; ++i) {
            const Vec3 hip(1.5 * std::sin(0.011 * i), 0.6 - 0.002 * i, 1.5 * std::sin(0.007 * i));
            w.put(scale * hip);
            u.put(hip);
            // A proxy that is still on its way when its steps are used up may be a step ahead of the other.
            if (w.last.work_limited || u.last.work_limited) continue;
            ++compared;
            // Single-precision vertices round differently at each scale: 1e-7 of 2.
            EXPECT_LT(glm::length(w.proxy() / scale - u.proxy()), 1e-4) << scale << ' ' << i;
        }
        EXPECT_GE(compared, 480);
    }
}

TEST(GodObject, LooksAtFewTrianglesOfMany) {
    const Surface plane = test::plane(0.05, 160);  // 51 200 triangles of 0.6 mm
    Walker w{plane.get(), 2 * kMm};
    w.put({0.0, 0.02, 0.0});
    w.walk({0.01, 1 * kMm, 0.0}, 1e-4);
    const ProxyResult r = w.put({0.0101, 1 * kMm, 0.0});
    EXPECT_LT(r.work.triangles_seen, 2000u);
    EXPECT_LT(r.work.triangles_tested, 100u);
    EXPECT_LE(r.work.steps, 4u);
}

TEST(GodObject, StopsSafelyWhenItsWorkIsUsedUp) {
    const Surface plane = test::plane(0.05, 40);
    Walker w{plane.get(), 5 * kMm};
    w.put({0.0, 0.0052, 0.0});
    const Vec3 hip(0.0, -0.01, 0.0);
    const ContactWork needed = move_proxy(w.state, hip, {w.radius}, *plane).work;
    // At any budget it stays outside and keeps to the budget but for its last step; with enough it arrives.
    int limited = 0;
    for (double share = 0.0; share <= 2.5; share += 0.01) {
        const double budget = share * cost_ns(needed);
        const ProxyResult r = move_proxy(w.state, hip, {w.radius}, *plane, {.max_cost_ns = budget});
        EXPECT_GE(r.next.position_object_m.y, 0.998 * w.radius) << share;
        EXPECT_LE(cost_ns(r.work), std::max(budget, WorkCost::kTick_ns) + WorkCost::kStep_ns + 2e3) << share;
        limited += r.work_limited;
        if (!r.work_limited) {
            EXPECT_NEAR(r.next.position_object_m.y, w.radius, 1e-6) << share;
        }
    }
    EXPECT_GT(limited, 20);
    EXPECT_FALSE(move_proxy(w.state, hip, {w.radius}, *plane, {.max_cost_ns = 2.5 * cost_ns(needed)}).work_limited);
}

TEST(GodObject, AProxyThatCannotLookAroundStaysInContact) {
    const Surface plane = test::plane(0.05, 40);
    Walker w{plane.get(), 5 * kMm};
    w.put({0.0, 0.0052, 0.0});
    w.put({0.0, 0.004, 0.0});
    const ProxyResult r = move_proxy(w.state, {0.0, 0.0039, 0.0}, {w.radius}, *plane, {.max_cost_ns = 0.0});
    EXPECT_TRUE(r.work_limited);
    EXPECT_GT(r.constraints, 0u);
    EXPECT_EQ(r.next.position_object_m, w.proxy());
    EXPECT_NEAR(r.normal_object.y, 1.0, 1e-6);
}

// At the front of a cut a facet may be folded over: it stands a little proud and shows its back. A ball that comes by
// must not take itself for buried and be put outside through the material.
TEST(GodObject, AFacetFoldedOverDoesNotPullABallThroughTheSurface) {
    test::SurfaceBuilder builder;
    const double h = 0.25 * kMm;
    std::array<std::array<std::uint32_t, 41>, 41> grid{};
    for (std::size_t z = 0; z < 41; ++z)
        for (std::size_t x = 0; x < 41; ++x)
            grid[z][x] = builder.vertex({(double(x) - 20.0) * h, 0.0, (double(z) - 20.0) * h});
    for (std::size_t z = 0; z < 40; ++z)
        for (std::size_t x = 0; x < 40; ++x)
            builder.quad(grid[z][x], grid[z + 1][x], grid[z + 1][x + 1], grid[z][x + 1]);
    const double proud = 0.04 * kMm;
    const std::uint32_t a = builder.vertex({-0.5 * h, proud, 0.0}), b = builder.vertex({0.5 * h, proud, 0.0}),
                        c = builder.vertex({0.0, proud, 0.5 * h});
    builder.triangle(a, b, c);  // its normal points down
    const test::Surface surface = builder.finish();
    for (const double friction : {0.0, 0.3}) {
        const double radius = 2.0 * kMm;
        ProxyState state;
        ProxySettings settings{radius};
        settings.static_friction = settings.dynamic_friction = friction;
        for (int i = 0; i <= 400; ++i) {
            const double x = (i - 200) * 0.015 * kMm, y = i < 20 ? 3.0 * kMm : 1.2 * kMm;
            const ProxyResult moved = move_proxy(state, {x, y, 0.02 * kMm}, settings, *surface);
            ASSERT_GT(moved.next.position_object_m.y, 0.99 * radius) << i;
            ASSERT_LT(moved.next.position_object_m.y, 3.0 * kMm + 1e-9) << i;
            ASSERT_FALSE(moved.pushed_out) << i;
            state = moved.next;
        }
    }
}

// A ball that the surface has come to, as after a fill, comes out; friction does not hold it there.
TEST(GodObject, ASunkBallComesOutDespiteFriction) {
    const Surface plane = test::plane();
    ProxySettings settings{2.0 * kMm};
    settings.static_friction = settings.dynamic_friction = 0.5;
    ProxyState state;
    state.position_object_m = {0.0, 1.0 * kMm, 0.0};  // half a radius in
    state.surface_sequence = plane->sequence;
    state.placed = true;
    const ProxyResult moved = move_proxy(state, {0.0, 0.5 * kMm, 0.0}, settings, *plane);
    EXPECT_NEAR(moved.next.position_object_m.y, 2.0 * kMm, 0.01 * kMm);
}

TEST(GodObject, EachQuestionToTheSurfaceCountsWhatItLooksAtAndEndsWithTheTicksWork) {
    const test::Surface fine = test::plane(0.05, 60);
    const Vec3 center(0.001, -0.0005, 0.002);
    ContactWork work;
    ContactSearch search(*fine, 0.004, ProxyBudget{}, work);
    EXPECT_NEAR(search.nearest(center, 1.0).distance, 0.0005, 1e-9);
    const std::uint32_t after_nearest = work.triangles_seen;
    EXPECT_GT(after_nearest, 0u);
    EXPECT_TRUE(search.sees_backs(center, 0.004));
    const std::uint32_t after_backs = work.triangles_seen;
    EXPECT_GT(after_backs, after_nearest);
    EXPECT_TRUE(search.broad_phase({center, center}));
    EXPECT_GT(work.triangles_seen, after_backs);

    ContactWork little;
    ContactSearch poor(*fine, 0.004, {.max_cost_ns = WorkCost::kTick_ns + 5 * WorkCost::kLook_ns}, little);
    EXPECT_EQ(poor.nearest(center, 1.0).distance, HUGE_VAL);
    EXPECT_FALSE(poor.sees_backs(center, 0.004));
    EXPECT_FALSE(poor.broad_phase({center, center}));
    EXPECT_LE(little.triangles_seen, 5u);
}

}  // namespace burin::haptics
