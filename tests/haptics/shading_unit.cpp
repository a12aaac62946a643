// SPDX-License-Identifier: MIT
// Force shading against the smooth shapes that the meshes stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "haptics/contact/god_object.hpp"
#include "haptics/contact/shading.hpp"
#include "haptics/contact/touching.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

using test::BumpySphere;

Vec3 around(double angle) {
    return glm::normalize(Vec3(std::sin(angle) * 0.8, std::cos(angle), std::sin(angle) * 0.6) + Vec3(0.01, 0.02, 0.1));
}

struct Felt {
    double worst_jump = 0.0;       // of the force between two ticks, as a share of it
    double worst_direction = 0.0;  // of the force, from the smooth surface's normal, radians
    double worst_normal = 0.0;     // of the normal that is told, from the force
    int lost = 0, limited = 0;
};

// The HIP follows the smooth surface at one depth, 0.1 mm a tick: what is felt should change as slowly as the normal
// does.
Felt feel(const BumpySphere& shape, const geometry::LocalSurface& surface, const ProxySettings& settings,
          double depth) {
    const auto hip_at = [&](double angle) {
        const Vec3 d = around(angle);
        return shape.point(d) + (settings.contact_radius_m - depth) * shape.normal(d);
    };
    ProxyState state = move_proxy({}, 1.3 * hip_at(0.0), settings, surface).next;
    state = move_proxy(state, hip_at(0.0), settings, surface).next;
    Felt felt;
    Vec3 last(0.0);
    for (int i = 0; i < compute::test::repeated(2000); ++i) {
        const double angle = i * 0.1 * kMm / shape.radius_m;
        const ProxyResult r = move_proxy(state, hip_at(angle), settings, surface);
        state = r.next;
        const Vec3 force = (r.next.position_object_m - hip_at(angle)) / depth;
        if (i > 0) felt.worst_jump = std::max(felt.worst_jump, glm::length(force - last));
        last = force;
        const Vec3 way = glm::normalize(force);
        felt.worst_direction = std::max(felt.worst_direction, glm::length(way - shape.normal(around(angle))));
        felt.worst_normal = std::max(felt.worst_normal, glm::length(way - r.normal_object));
        felt.lost += r.constraints == 0;
        felt.limited += r.work_limited;
    }
    return felt;
}

}  // namespace

TEST(ForceShading, G5TheForceOnASphereChangesByLessThanTwoPercentATickAndPointsAwayFromItsMiddle) {
    const BumpySphere shape;
    for (const int times : {4, 5}) {  // edges of 3.8 and 1.9 mm; facets meet at 0.09 and 0.045 radians
        const test::Surface mesh = test::touchable(test::mesh_of(shape, times));
        for (const double radius : {0.0, 0.5 * kMm, 4 * kMm, 20 * kMm}) {
            const Felt felt = feel(shape, *mesh, {.contact_radius_m = radius}, 2 * kMm);
            EXPECT_LE(felt.worst_jump, 0.02) << times << ' ' << radius;
            // The normals at the corners are exact here, and so is what is made of them.
            EXPECT_LE(felt.worst_direction, 3e-4) << times << ' ' << radius;
            EXPECT_LE(felt.worst_normal, 2e-4) << times << ' ' << radius;
            EXPECT_EQ(felt.lost + felt.limited, 0) << times << ' ' << radius;
        }
    }
}

TEST(ForceShading, G5TheForceOnABumpySphereIsFarNearerToTheSmoothOneThanThatOfFacets) {
    const BumpySphere shape{.bump_m = 0.4 * kMm};
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 5));
    for (const double radius : {0.0, 0.5 * kMm, 4 * kMm}) {
        const Felt smooth = feel(shape, *mesh, {.contact_radius_m = radius}, 2 * kMm);
        const Felt facets = feel(shape, *mesh, {.contact_radius_m = radius, .shading = false}, 2 * kMm);
        EXPECT_LE(smooth.worst_jump, 0.02) << radius;
        EXPECT_GE(facets.worst_jump, 0.02) << radius;  // else it were no feat
        EXPECT_LE(smooth.worst_direction, 0.25 * facets.worst_direction) << radius;
        EXPECT_EQ(smooth.lost + smooth.limited, 0) << radius;
    }
}

TEST(ForceShading, G5InsideABallItPointsToItsMiddle) {
    // Hollow everywhere: the HIP, 8 mm deep below a wall of 30 mm, is drawn more strongly along it than on a flat one.
    const BumpySphere shape{.radius_m = 0.03};
    geometry::TriangleMesh hollow = test::mesh_of(shape, 4);
    for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
    const test::Surface mesh = test::touchable(hollow);
    for (const double radius : {0.0, 3 * kMm}) {
        const ProxySettings settings{.contact_radius_m = radius};
        ProxyState state = move_proxy({}, Vec3(0.001, 0.002, 0.0), settings, *mesh).next;
        for (int i = 0; i < 1500; ++i) {
            const Vec3 hip = (0.038 - radius) * around(0.002 * i);
            const ProxyResult r = move_proxy(state, hip, settings, *mesh);
            state = r.next;
            if (i == 0) continue;  // comes from afar
            ASSERT_FALSE(r.work_limited) << i;
            const Vec3 way = glm::normalize(r.next.position_object_m - hip);
            ASSERT_LT(glm::length(way + around(0.002 * i)), 3e-4) << radius << ' ' << i;
        }
    }
}

TEST(ForceShading, ABoxFeelsAsItDoesWithoutIt) {
    geometry::TriangleMesh box;
    const test::Surface soup = test::box(Vec3(-0.02), Vec3(0.02), 4);
    std::map<std::array<float, 3>, std::uint32_t> index;  // corners that are shared are one
    for (const auto& t : soup->loose->triangles) {
        auto& corners = box.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3f p = soup->loose->positions_m[t[k]];
            const auto [at, is_new] = index.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(index.size()));
            if (is_new) box.positions_m.emplace_back(p);
            corners[k] = at->second;
        }
    }
    const test::Surface mesh = test::touchable(box);
    for (const double radius : {0.0, 2 * kMm}) {
        ProxyState shaded, plain;
        for (int i = 0; i < 3000; ++i) {  // around the box, over edges and corners, 1 mm deep and less
            const double a = 0.0021 * i;
            const Vec3 round = Vec3(std::cos(a), std::sin(0.37 * a), std::sin(a));
            const Vec3 way = round / std::max({std::abs(round.x), std::abs(round.y), std::abs(round.z)});
            const Vec3 hip = (i == 0 ? 0.04 : 0.0195) * way;
            const ProxyResult with = move_proxy(shaded, hip, {.contact_radius_m = radius}, *mesh);
            const ProxyResult without = move_proxy(plain, hip, {.contact_radius_m = radius, .shading = false}, *mesh);
            shaded = with.next;
            plain = without.next;
            // To within the angle at which shading calls it done.
            const double depth = glm::length(plain.position_object_m - hip);
            ASSERT_LT(glm::length(shaded.position_object_m - plain.position_object_m), 3e-4 * depth + 1e-9)
                << radius << ' ' << i;
        }
    }
}

TEST(ForceShading, WhileTheHipStandsStillSoDoesTheProxy) {
    const BumpySphere shape{.bump_m = 1.0 * kMm};  // hollows and bumps of 3 mm curvature
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 5));
    for (const double radius : {0.0, 1.5 * kMm})
        for (int place = 0; place < 60; ++place) {
            const Vec3 d = around(0.1 * place);
            const ProxySettings settings{.contact_radius_m = radius};
            ProxyState state = move_proxy({}, 1.3 * shape.point(d), settings, *mesh).next;
            const Vec3 hip = shape.point(d) + (radius - 2 * kMm) * shape.normal(d) + 0.3 * kMm * around(place);
            for (int i = 0; i < 20; ++i) state = move_proxy(state, hip, settings, *mesh).next;
            const Vec3 rest = state.position_object_m;
            for (int i = 0; i < 20; ++i) {
                state = move_proxy(state, hip, settings, *mesh).next;
                ASSERT_LT(glm::length(state.position_object_m - rest), 1e-3 * kMm) << radius << ' ' << place;
            }
        }
}

// On an open rim a ball hangs over the edge, far beyond the last facet over which normals are known.
TEST(ForceShading, NormalsAreCarriedOnPastAFacetsRimByAQuarterOfItAtMost) {
    // Strips of 1 mm along a cylinder of 5.7 mm: each facet is turned by 10 degrees against the one before.
    constexpr int kStrips = 6;
    const double turn = 10.0 * std::numbers::pi / 180.0, side = 1 * kMm, width = 40 * kMm;
    geometry::TriangleMesh strip;
    Vec3 edge(0.0);
    for (int i = 0; i <= kStrips; ++i) {
        strip.positions_m.push_back(edge - Vec3(0.0, 0.0, 0.5 * width));
        strip.positions_m.push_back(edge + Vec3(0.0, 0.0, 0.5 * width));
        edge += side * Vec3(std::cos(turn * i), -std::sin(turn * i), 0.0);
    }
    for (std::uint32_t i = 0; i < kStrips; ++i) {
        const std::uint32_t v = 2 * i;
        strip.triangles.push_back({v, v + 1, v + 3});
        strip.triangles.push_back({v, v + 3, v + 2});
    }
    const test::Surface mesh = test::touchable(strip);
    const Vec3 up(0.0, 1.0, 0.0);  // the first facet's normal, and so the one at its rim
    for (const double radius : {2 * kMm, 5 * kMm, 20 * kMm})
        for (const double beyond : {0.1, 0.5, 0.9}) {  // of the radius: the ball touches the rim with its side
            const Vec3 center = radius * Vec3(-beyond, std::sqrt(1.0 - beyond * beyond), 0.0) - mesh->origin_object;
            ContactWork work;
            ContactSearch search(*mesh, radius, ProxyBudget{}, work);
            ASSERT_TRUE(search.broad_phase({center, center}));
            Touches touches;
            ASSERT_TRUE(search.touching(center, touches).complete);
            ASSERT_GT(touches.count, 0u);
            NearestInside goal;
            goal.found = true;
            goal.bearing_count = 1;
            goal.bearing[0] = 0;
            SmoothFacets facets(*mesh);
            const ShadedPlanes planes = shaded(facets, search.candidates(), touches, goal, center, radius);
            ASSERT_TRUE(planes.any) << radius << ' ' << beyond;
            // Over the first facet the normal turns by 5 degrees, to the mean of two facets' normals.
            const double angle = std::acos(std::min(1.0, glm::dot(planes.planes[0].normal, up)));
            EXPECT_LE(angle, 0.26 * 0.5 * turn) << radius << ' ' << beyond;
        }
}

TEST(ForceShading, FacetsThatAreAskedForAgainAreTheSameInAnyOrder) {
    const test::Surface mesh = test::touchable(test::mesh_of(BumpySphere{}, 3));
    const Vec3 top = Vec3(0.0, 0.05, 0.0) - mesh->origin_object;
    ContactWork work;
    ContactSearch search(*mesh, 0.02, ProxyBudget{}, work);
    ASSERT_TRUE(search.broad_phase({top, top}));
    const Candidates& candidates = search.candidates();
    ASSERT_GT(candidates.triangles(), 30u);
    SmoothFacets facets(*mesh);
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const std::uint32_t candidate =
            (i * i + i / 3) % std::min(candidates.triangles(), 20u);  // a few more than it keeps
        const auto facet = facets.of(candidates.id(candidate), candidates.triangle(candidate), false);
        ASSERT_TRUE(facet);
        ASSERT_EQ(facet->triangle.a, candidates.triangle(candidate).a) << i;
        ASSERT_EQ(facet->triangle.b, candidates.triangle(candidate).b) << i;
        ASSERT_EQ(facet->triangle.c, candidates.triangle(candidate).c) << i;
    }
}

}  // namespace burin::haptics
