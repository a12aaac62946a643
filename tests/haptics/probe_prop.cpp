// SPDX-License-Identifier: MIT
// The proxy on bumpy spheres that are known exactly: how near it stays, that it never lets go, and that it never goes
// in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "haptics/contact/god_object.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

using test::BumpySphere;

Vec3 around(double angle) {
    return glm::normalize(Vec3(std::sin(angle) * 0.8, std::cos(angle), std::sin(angle) * 0.6) + Vec3(0.01, 0.02, 0.1));
}

std::int64_t soak_operations(int otherwise) {
    const char* asked = std::getenv("BURIN_SOAK_OPERATIONS");
    return asked != nullptr ? std::stoll(asked) : compute::test::repeated(otherwise);
}

}  // namespace

TEST(Probe, At100MillimetresASecondOnABumpySphereThePointKeepsToTheSmoothSurface) {
    // 327 680 triangles, edges of 0.5 mm.
    const BumpySphere shape{.bump_m = 0.4 * kMm};
    const test::Surface mesh = test::touchable(test::mesh_of(shape, compute::test::kSanitized ? 5 : 7));
    std::vector<double> off, aside;
    ProxyState state = move_proxy({}, 1.2 * shape.point(around(0.0)), {}, *mesh).next;
    int lost = 0;
    for (int i = 0; i < compute::test::repeated(3000); ++i) {
        const Vec3 d = around(i * 0.1 * kMm / shape.radius_m);
        const Vec3 hip = shape.point(d) - 2 * kMm * shape.normal(d);
        const ProxyResult r = move_proxy(state, hip, {}, *mesh);
        state = r.next;
        lost += r.constraints == 0;
        const Vec3 p = r.next.position_object_m;
        off.push_back(std::abs(glm::length(p) - shape.radius_towards(glm::normalize(p))));
        // Where it should rest: straight above the HIP, as the HIP was made.
        const Vec3 n = shape.normal(d), miss = p - shape.point(d);
        aside.push_back(glm::length(miss - glm::dot(miss, n) * n));
    }
    std::ranges::sort(off);
    std::ranges::sort(aside);
    const std::size_t p99 = off.size() * 99 / 100;
    const double bound = compute::test::kSanitized ? 0.1 * kMm : 0.01 * kMm;
    EXPECT_LE(off[p99], bound);
    EXPECT_LE(aside[p99], bound);
    EXPECT_EQ(lost, 0);
}

TEST(Probe, ContactIsNeverLostAndIsTheSameInOtherUnits) {
    // Coordinates times 1024 are exact, and so must all that follows be, but for tolerances in metres, of which there
    // are none; times 1000 they round, by 6e-8 of 50.
    const BumpySphere shape{.bump_m = 0.4 * kMm};
    const geometry::TriangleMesh metres = test::mesh_of(shape, 5);
    for (const double radius : {0.0, 2 * kMm})
        for (const double scale : {1024.0, 1000.0}) {
            geometry::TriangleMesh larger = metres;
            for (Vec3& p : larger.positions_m) p = Vec3(Vec3f(p)) * scale;
            const test::Surface a = test::touchable(metres), b = test::touchable(larger);
            ProxyState of_a, of_b;
            for (int i = 0; i < compute::test::repeated(2000); ++i) {
                const Vec3 d = around(0.002 * i);
                const double depth = i == 0 ? -5 * kMm : (1.0 + std::sin(0.05 * i)) * kMm + 0.05 * kMm;
                const Vec3 hip = shape.point(d) + (radius - depth) * shape.normal(d);
                const ProxyResult in_a = move_proxy(of_a, hip, {.contact_radius_m = radius}, *a);
                const ProxyResult in_b = move_proxy(of_b, scale * hip, {.contact_radius_m = scale * radius}, *b);
                of_a = in_a.next;
                of_b = in_b.next;
                ASSERT_EQ(in_a.constraints > 0, i > 0) << i;
                ASSERT_EQ(in_b.constraints > 0, i > 0) << i;
                const double apart = glm::length(of_b.position_object_m / scale - of_a.position_object_m);
                ASSERT_LT(apart, scale == 1024.0 ? 1e-9 * 0.05 : 1e-5) << radius << ' ' << scale << ' ' << i;
            }
        }
}

TEST(Probe, DraggedSlowlyTheNextActiveTriangleIsANeighbourOfTheLast) {
    const BumpySphere shape{.bump_m = 0.4 * kMm};
    const geometry::TriangleMesh mesh = test::mesh_of(shape, 5);
    const test::Surface surface = test::touchable(mesh);
    const auto corners_of = [&](std::uint32_t id) {
        return mesh.triangles[surface->meshes[0].snapshot->mesh_triangle(id)];
    };
    for (const bool shading : {true, false}) {
        const ProxySettings settings{.contact_radius_m = 0.0, .shading = shading};
        ProxyState state = move_proxy({}, 1.2 * shape.point(around(0.0)), settings, *surface).next;
        std::uint32_t last = ~0u;
        int changes = 0;
        for (int i = 0; i < compute::test::repeated(4000); ++i) {  // 10 mm/s; edges are 1.9 mm
            const Vec3 d = around(i * 0.01 * kMm / shape.radius_m);
            const ProxyResult r = move_proxy(state, shape.point(d) - 0.5 * kMm * shape.normal(d), settings, *surface);
            state = r.next;
            ASSERT_GT(r.constraints, 0u);
            if (last != ~0u && r.active_triangle != last) {
                const auto was = corners_of(last), is = corners_of(r.active_triangle);
                ASSERT_TRUE(std::ranges::find_first_of(was, is) != was.end()) << shading << ' ' << i;
                ++changes;
            }
            last = r.active_triangle;
        }
        EXPECT_GT(changes, compute::test::kSanitized ? 0 : 20);
    }
}

// Random hands: never inside, never farther from the HIP than before, and at rest when nothing changes.
TEST(Probe, SoakedInRandomTicksItNeverGoesInAndNeverGoesAway) {
    const BumpySphere shape{.bump_m = 0.6 * kMm};
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 5));
    const double sagitta = 0.08 * kMm;  // facets of 1.9 mm lie below bumps of 10 mm curvature by up to that
    const std::int64_t ticks = soak_operations(20'000);
    compute::test::Random random(42);
    ProxyState state;
    ProxySettings settings;
    Vec3 hip = 0.08 * around(0.0), way(0.0);
    std::int64_t limited = 0, in_contact = 0;
    for (std::int64_t i = 0; i < ticks; ++i) {
        if (i % 500 == 0) {  // another tool
            settings.contact_radius_m = random.chance(0.4) ? 0.0 : random.between(0.3, 6.0) * kMm;
            settings.shading = random.chance(0.5);
            settings.dynamic_friction = random.chance(0.4) ? random.between(0.0, 0.8) : 0.0;
            settings.static_friction = settings.dynamic_friction * random.between(1.0, 1.5);
            state = {};
            hip = random.between(0.06, 0.08) * around(random.between(0.0, 6.28));
        }
        if (i % 25 == 0) {  // another way to go: in, out or along, slow, fast or still
            const Vec3 goal =
                random.between(0.044, 0.06) * glm::normalize(hip + 0.01 * around(random.between(0, 6.28)));
            way = (goal - hip) * (random.chance(0.2) ? 0.0 : random.between(0.001, 0.04));
            if (glm::length(way) > 2 * kMm) way *= 2 * kMm / glm::length(way);
        }
        hip += way;
        const Vec3 before = state.placed ? state.position_object_m : hip;
        const ProxyResult r = move_proxy(state, hip, settings, *mesh);
        state = r.next;
        const Vec3 p = r.next.position_object_m;
        // The distance from a bumpy sphere is at least the radial one times the cosine of its steepest slope, 0.12.
        const double radial = glm::length(p) - shape.radius_towards(glm::normalize(p));
        ASSERT_GE(radial, 0.99 * settings.contact_radius_m * 0.98 - sagitta) << i;
        limited += r.work_limited;
        in_contact += r.constraints > 0;
        ASSERT_LE(r.work.steps, ProxyBudget{}.max_steps);
        if (!settings.shading && !r.pushed_out) {
            const double radius = std::max(settings.contact_radius_m, mesh->mean_edge_m() / 500.0);
            ASSERT_LE(glm::length(p - hip), glm::length(before - hip) + 3e-3 * radius) << i;
        }
    }
    EXPECT_GT(in_contact, ticks / 10);
    EXPECT_LE(limited, ticks / 500);
}

}  // namespace burin::haptics
