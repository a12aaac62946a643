// SPDX-License-Identifier: MIT
// Friction of the proxy against Coulomb's law and what follows from it in closed form.
#include <gtest/gtest.h>

#include "haptics/contact/god_object.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

struct Rubbing {
    const geometry::LocalSurface* surface;
    ProxySettings settings;
    ProxyState state{};
    Vec3 hip{0.0};
    ProxyResult last{};

    ProxyResult put(const Vec3& to) {
        last = move_proxy(state, to, settings, *surface);
        state = last.next;
        hip = to;
        return last;
    }
    // The tangent of the force's angle to the normal.
    [[nodiscard]] double slope() const {
        const Vec3 force = last.next.position_object_m - hip;
        const double along = glm::dot(force, last.normal_object);
        return glm::length(force - along * last.normal_object) / along;
    }
};

ProxySettings rough(double radius, double at_rest, double sliding) {
    return {.contact_radius_m = radius, .shading = true, .static_friction = at_rest, .dynamic_friction = sliding};
}

}  // namespace

TEST(Friction, HoldsUpToTheStaticConeAndSlidesOnTheDynamicOne) {
    const test::Surface plane = test::plane(0.05, 20);
    for (const double radius : {0.0, 3 * kMm}) {
        Rubbing r{plane.get(), rough(radius, 0.6, 0.4)};
        r.put({-0.03, 0.02, 0.001});
        r.put({-0.03, radius - 1 * kMm, 0.001});
        const Vec3 stuck = r.last.next.position_object_m;
        ASSERT_TRUE(r.last.sticking);
        const double depth = stuck.y - r.hip.y;
        double held = 0.0;
        while (r.put(r.hip + Vec3(1e-6, 0.0, 0.0)).sticking) {
            ASSERT_EQ(r.last.next.position_object_m, stuck);
            held = r.hip.x - stuck.x;
        }
        EXPECT_NEAR(held, 0.6 * depth, 0.01 * 0.6 * depth) << radius;
        for (int i = 0; i < 300; ++i) {
            r.put(r.hip + Vec3(1e-4, 0.0, 0.3e-4));
            ASSERT_FALSE(r.last.sticking);
            ASSERT_NEAR(r.slope(), 0.4, 0.004) << radius << ' ' << i;
            ASSERT_NEAR(r.last.normal_object.y, 1.0, 1e-9);
        }
        // Turned back it sticks, until it is beyond the other side of the static cone.
        const Vec3 turned = r.last.next.position_object_m;
        r.put(r.hip - Vec3(1e-5, 0.0, 0.0));
        EXPECT_TRUE(r.last.sticking);
        EXPECT_EQ(r.last.next.position_object_m, turned);
    }
}

TEST(Friction, NothingDriftsWhileItSticks) {
    const test::BumpySphere shape{.bump_m = 0.4 * kMm};
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 4));
    for (const double radius : {0.0, 2 * kMm}) {
        Rubbing r{mesh.get(), rough(radius, 0.5, 0.3)};
        const Vec3 d = glm::normalize(Vec3(0.3, 0.8, 0.2));
        r.put(1.3 * shape.point(d));
        r.put(shape.point(d) + (radius - 2 * kMm) * shape.normal(d));
        r.put(r.hip);
        const Vec3 stuck = r.last.next.position_object_m, middle = r.hip;
        for (int i = 0; i < 3000; ++i) {  // within 0.4 of 2 mm, around and around
            r.put(middle + 0.3 * kMm * Vec3(std::sin(0.1 * i), std::sin(0.17 * i), std::sin(0.23 * i)));
            ASSERT_TRUE(r.last.sticking) << i;
            ASSERT_EQ(r.last.next.position_object_m, stuck) << i;
        }
    }
}

TEST(Friction, NoneGivesTheSameBitsAsNotAskingForAny) {
    const test::BumpySphere shape{.bump_m = 0.4 * kMm};
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 4));
    Rubbing none{mesh.get(), rough(2 * kMm, 0.0, 0.0)}, plain{mesh.get(), {.contact_radius_m = 2 * kMm}};
    for (int i = 0; i < 1000; ++i) {
        const double a = 0.003 * i;
        const Vec3 hip =
            (i == 0 ? 0.06 : 0.0505) * glm::normalize(Vec3(std::sin(a), std::cos(a), 0.3 * std::sin(3 * a)));
        ASSERT_EQ(none.put(hip).next.position_object_m, plain.put(hip).next.position_object_m);
        ASSERT_FALSE(none.last.sticking);
        ASSERT_FALSE(none.last.next.slipping);
    }
}

TEST(Friction, OnASphereTheConeStandsOnTheShadedNormal) {
    const test::BumpySphere shape;
    const test::Surface mesh = test::touchable(test::mesh_of(shape, 5));
    for (const double radius : {0.0, 2 * kMm}) {
        Rubbing r{mesh.get(), rough(radius, 0.5, 0.3)};
        for (int i = 0; i < 1200; ++i) {
            const double a = 0.002 * i;
            r.put((i == 0 ? 0.06 : 0.048 + radius) * Vec3(std::sin(a) * 0.8, std::cos(a), std::sin(a) * 0.6));
            if (i < 50) continue;
            ASSERT_NEAR(r.slope(), 0.3, 0.003) << radius << ' ' << i;
            const Vec3 away = glm::normalize(r.last.next.position_object_m);
            ASSERT_LT(glm::length(r.last.normal_object - away), 1e-3) << radius << ' ' << i;
        }
    }
}

TEST(Friction, InAGrooveOfTwoPlanesItStandsOnTheirCommonNormal) {
    const test::Surface v = test::height_field(0.05, 20, [](double x, double) { return std::abs(x); });
    const double radius = 4 * kMm;
    Rubbing r{v.get(), rough(radius, 0.5, 0.3)};
    r.put({0.0, 0.03, -0.03});
    r.put({0.0, 3 * kMm, -0.03});
    const Vec3 stuck = r.last.next.position_object_m;
    const double depth = stuck.y - r.hip.y;
    EXPECT_NEAR(stuck.y, std::sqrt(2.0) * radius, 3e-3 * radius);  // sweeps end 2e-3 R deep in either wall
    double held = 0.0;
    while (r.put(r.hip + Vec3(0.0, 0.0, 2e-6)).sticking) held = r.hip.z - stuck.z;
    EXPECT_NEAR(held, 0.5 * depth, 0.005 * depth);
    for (int i = 0; i < 200; ++i) {
        r.put(r.hip + Vec3(0.0, 0.0, 1e-4));
        ASSERT_NEAR(r.slope(), 0.3, 0.003) << i;
        ASSERT_NEAR(r.last.normal_object.y, 1.0, 1e-6);
        ASSERT_EQ(r.last.constraints, 2u);
    }
}

// A block on a belt: mass m, pressed on with N, drawn by a spring c whose other end moves at V. It sticks until the
// spring pulls with mu_s N, slips as a harmonic oscillator about mu_d N until it stands again, and so on. With
// A = (mu_s - mu_d) N / c and w = sqrt(c / m) the period is 2 A / V + (2 / w) (pi - atan(A w / V)).
TEST(Friction, AMassOnASpringSticksAndSlipsWithThePeriodOfTheClosedForm) {
    const test::Surface plane = test::plane(0.2, 20);
    const double mass = 0.1, spring = 100.0, speed = 4 * kMm, wall = 20'000.0, dt = 1e-4;
    const double at_rest = 0.5, sliding = 0.3, radius = 5 * kMm, depth = 0.05 * kMm, load = wall * depth;
    Rubbing r{plane.get(), rough(radius, at_rest, sliding)};
    r.put({-0.1, 0.02, 0.0});
    r.put({-0.1, radius - depth, 0.0});
    double x = -0.1, v = 0.0, driver = x, most = 0.0;
    std::vector<double> slips;  // when each began
    bool stuck = true;
    for (int i = 0; i < 60'000 && slips.size() < 5; ++i) {
        driver += speed * dt;
        const double friction = wall * (r.last.next.position_object_m.x - x);
        most = std::max(most, -friction);
        // While it sticks the contact damps: a block would else go on ringing on the wall's stiffness.
        const double damping = r.last.sticking ? 20.0 : 0.0;
        v += dt * (spring * (driver - x) + friction - damping * v) / mass;
        x += dt * v;
        r.put({x, radius - depth, 0.0});
        if (stuck && !r.last.sticking && x - r.last.next.position_object_m.x > 0.0 && v > 4.0 * speed) {
            slips.push_back(i * dt);
            stuck = false;
        }
        if (r.last.sticking && std::abs(v) < speed) stuck = true;
    }
    ASSERT_EQ(slips.size(), 5u);
    EXPECT_NEAR(most, at_rest * load, 0.01 * at_rest * load);
    const double a = (at_rest - sliding) * load / spring, w = std::sqrt(spring / mass);
    const double period = 2.0 * a / speed + 2.0 / w * (std::numbers::pi - std::atan(a * w / speed));
    for (std::size_t i = 2; i < slips.size(); ++i) EXPECT_NEAR(slips[i] - slips[i - 1], period, 0.02 * period) << i;
}

}  // namespace burin::haptics
