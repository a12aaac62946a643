// SPDX-License-Identifier: MIT
// What is thin is not passed through, and what is sharp holds: a sheet of 0.1 mm, edges and corners, grooves of planes.
#include <gtest/gtest.h>

#include <vector>

#include "haptics/contact/god_object.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

Vec3 any_direction(compute::test::Random& random) {
    for (;;) {
        const Vec3 v(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        if (glm::length(v) > 0.1 && glm::length(v) < 1.0) return glm::normalize(v);
    }
}

Quat any_turn(compute::test::Random& random) {
    return glm::angleAxis(random.between(0.0, 6.28), any_direction(random));
}

// The same triangles, turned, with what corners they share made one.
geometry::TriangleMesh turned(const geometry::LocalSurface& soup, const Quat& turn) {
    geometry::TriangleMesh mesh;
    std::map<std::array<float, 3>, std::uint32_t> index;
    for (const auto& t : soup.loose->triangles) {
        auto& corners = mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3f p = soup.loose->positions_m[t[k]];
            const auto [at, is_new] = index.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(index.size()));
            if (is_new) mesh.positions_m.push_back(turn * Vec3(p));
            corners[k] = at->second;
        }
    }
    return mesh;
}

}  // namespace

TEST(ThinSheet, IsNotPassedThroughAtTwoMetresASecondFromEitherSideAtAnyAngle) {
    compute::test::Random random(11);
    constexpr int kCells = 9;
    const double half = 50 * kMm, cell = 2.0 * half / kCells;
    const test::Surface flat = test::box({-half, -0.05 * kMm, -half}, {half, 0.05 * kMm, half}, kCells);
    int strokes = 0, beyond = 0;
    for (int sheet = 0; sheet < 6; ++sheet) {
        const Quat turn = any_turn(random);
        const test::Surface surface = test::touchable(turned(*flat, turn));
        for (int stroke = 0; stroke < compute::test::repeated(200); ++stroke) {
            const double side = random.chance(0.5) ? 1.0 : -1.0;
            // At a vertex, an edge, or anywhere; from the front or grazing; sometimes with friction.
            Vec3 target(random.between(-30, 30) * kMm, 0.0, random.between(-30, 30) * kMm);
            const int kind = random.small(0, 2);
            if (kind <= 1) target.x = -half + cell * random.small(3, 6);
            if (kind == 0) target.z = -half + cell * random.small(3, 6);
            Vec3 way = any_direction(random);
            way.y = -side * (0.02 + std::abs(way.y));
            way = glm::normalize(way);
            ProxySettings settings{.contact_radius_m = random.chance(0.5) ? 0.0 : 3 * kMm};
            settings.shading = random.chance(0.5);
            if (random.chance(0.3)) settings.static_friction = settings.dynamic_friction = 0.5;
            // Where it touches first: over the target, however flat the way. Then on, 2 mm a tick, until the HIP is far
            // on the other side or gone past the rim.
            const Vec3 touching = target + Vec3(0.0, side * (settings.contact_radius_m + 0.05 * kMm), 0.0);
            const double ahead = random.between(1.0, 4.0) * kMm;
            const double most = half - 1 * kMm - settings.contact_radius_m;
            ProxyState state;
            bool is_beyond = false;
            for (int i = 0; i < 60; ++i) {
                const Vec3 hip = touching + (2 * kMm * i - ahead) * way;
                if (std::abs(hip.x) > most || std::abs(hip.z) > most || side * hip.y < -12 * kMm) break;
                const ProxyResult r = move_proxy(state, turn * hip, settings, *surface);
                state = r.next;
                const Vec3 proxy = glm::conjugate(turn) * r.next.position_object_m;
                ASSERT_GT(side * proxy.y, 0.05 * kMm + 0.99 * settings.contact_radius_m - 1e-7)
                    << sheet << ' ' << stroke << ' ' << i << " kind " << kind << " radius "
                    << settings.contact_radius_m;
                is_beyond = is_beyond || side * hip.y < -0.05 * kMm;
            }
            ++strokes;
            beyond += is_beyond;
        }
    }
    EXPECT_GT(beyond, strokes * 4 / 5);  // else little would have been tested
}

TEST(ThinSheet, DroppedOnItsRimTheBallRestsOnTheEdge) {
    const test::Surface flat = test::box({-0.05, -0.05 * kMm, -0.05}, {0.05, 0.05 * kMm, 0.05}, 5);
    compute::test::Random random(5);
    for (int drop = 0; drop < 100; ++drop) {
        const double radius = 3 * kMm, z = random.between(-0.03, 0.03);
        const ProxySettings settings{.contact_radius_m = radius};
        ProxyState state = move_proxy({}, {0.06, 0.0, z}, settings, *flat).next;
        ProxyResult r;
        for (int i = 1; i <= 6; ++i) {
            r = move_proxy(state, {0.06 - 2 * kMm * i, 0.0, z}, settings, *flat);
            state = r.next;
        }
        // Its two edges are 0.1 mm apart: the ball lies on both.
        const double rest = 0.05 + std::sqrt(radius * radius - 0.05 * kMm * 0.05 * kMm);
        ASSERT_NEAR(r.next.position_object_m.x, rest, 3e-3 * radius) << drop;
        ASSERT_NEAR(r.next.position_object_m.y, 0.0, 3e-3 * radius) << drop;
    }
}

TEST(Corners, ABallOnAnEdgeOrACornerOfABoxStandsWhereTheNearestPointSays) {
    // Seen from outside a box is convex, so the HIP's rest is the nearest point of the box grown by the radius, as long
    // as the HIP is outside the box itself: q + R (hip - q) / |hip - q|, q the HIP clamped to the box.
    const Vec3 half(0.02, 0.015, 0.01);
    const test::Surface box = test::box(-half, half, 3);
    compute::test::Random random(3);
    for (int i = 0; i < compute::test::repeated(2000); ++i) {
        const double radius = 4 * kMm;
        const Vec3 d = any_direction(random);
        const Vec3 far = 0.06 * d,
                   goal(random.between(-0.023, 0.023), random.between(-0.018, 0.018), random.between(-0.013, 0.013));
        const Vec3 q = glm::clamp(goal, -half, half);
        const double outside = glm::length(goal - q);
        if (outside < 0.2 * kMm || outside > radius) continue;
        const Vec3 rest = q + radius * (goal - q) / outside;
        ProxyState state;
        const ProxySettings settings{.contact_radius_m = radius};
        for (int k = 0; k < 3; ++k) state = move_proxy(state, far + 0.01 * rest, settings, *box).next;
        state = move_proxy({}, rest + 1 * kMm * (goal - q) / outside, settings, *box).next;  // above the rest
        for (int k = 0; k < 20; ++k) state = move_proxy(state, goal, settings, *box).next;
        // An edge may sink in by 1e-3 R, which on a ball this far out moves it aside by 4.5e-2 R at most.
        ASSERT_LT(glm::length(state.position_object_m - rest), 3e-3 * radius) << i;
    }
}

namespace {

// Dykstra's alternating projections: the nearest point of an intersection of half-spaces n . x >= offset. Slow and
// sure.
Vec3 nearest_common_point(const std::vector<Vec3>& normals, double offset, const Vec3& goal) {
    Vec3 x = goal;
    std::vector<Vec3> carried(normals.size(), Vec3(0.0));
    for (int i = 0; i < 20'000; ++i) {
        Vec3 moved(0.0);
        for (std::size_t k = 0; k < normals.size(); ++k) {
            const Vec3 y = x + carried[k];
            const Vec3 p = y + std::max(0.0, offset - glm::dot(normals[k], y)) * normals[k];
            carried[k] = y - p;
            moved += glm::abs(p - x);
            x = p;
        }
        if (glm::length(moved) < 1e-15) break;
    }
    return x;
}

}  // namespace

TEST(Grooves, OfTwoAndThreePlanesHoldTheBallAtTheNearestPointThatIsFree) {
    compute::test::Random random(8);
    const double wall = 0.1;
    for (int groove = 0; groove < compute::test::repeated(60); ++groove) {
        const int planes = random.small(2, 3);
        std::vector<Vec3> normals;
        const double start = random.between(0.0, 6.28);
        for (int k = 0; k < planes; ++k) {
            const double a = start + 6.2832 * k / planes + random.between(-0.4, 0.4), tilt = random.between(0.5, 1.2);
            normals.push_back(Vec3(std::sin(tilt) * std::cos(a), std::cos(tilt), std::sin(tilt) * std::sin(a)));
        }
        test::SurfaceBuilder b;
        const auto facet = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& up) {
            const bool is_up = glm::dot(glm::cross(q - p, r - p), up) > 0.0;
            const auto vp = b.vertex(p), vq = b.vertex(is_up ? q : r), vr = b.vertex(is_up ? r : q);
            b.triangle(vp, vq, vr);
        };
        if (planes == 3) {
            std::vector<Vec3> creases;  // between wall k and the next, upwards
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3 c = glm::normalize(glm::cross(normals[k], normals[(k + 1) % 3]));
                creases.push_back(c.y < 0.0 ? -c : c);
            }
            for (std::size_t k = 0; k < 3; ++k)
                facet(Vec3(0.0), wall * creases[k], wall * creases[(k + 2) % 3], normals[k]);
        } else {
            const Vec3 crease = glm::normalize(glm::cross(normals[0], normals[1]));
            for (const Vec3& n : normals) {
                Vec3 up = glm::normalize(glm::cross(n, crease));
                if (up.y < 0.0) up = -up;
                facet(-wall * crease, wall * crease, wall * (up - crease), n);
                facet(wall * crease, wall * (up + crease), wall * (up - crease), n);
            }
        }
        const test::Surface surface = b.finish();
        const double radius = 2 * kMm;
        const ProxySettings settings{.contact_radius_m = radius};
        Vec3 inside(0.0);
        for (const Vec3& n : normals) inside += n;
        ProxyState state = move_proxy({}, 8 * kMm * glm::normalize(inside), settings, *surface).next;
        for (int i = 0; i < 40; ++i) {
            const Vec3 hip(random.between(-3, 3) * kMm, random.between(-4, 3) * kMm, random.between(-3, 3) * kMm);
            ProxyResult r;
            for (int k = 0; k < 20; ++k) {
                r = move_proxy(state, hip, settings, *surface);
                state = r.next;
            }
            const Vec3 rest = nearest_common_point(normals, radius, hip);
            ASSERT_LT(glm::length(r.next.position_object_m - rest), 8e-3 * radius) << groove << ' ' << i;
            ASSERT_FALSE(r.work_limited);
        }
    }
}

}  // namespace burin::haptics
