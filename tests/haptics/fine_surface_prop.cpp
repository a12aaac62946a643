// SPDX-License-Identifier: MIT
// A ball much larger than the triangles touches their vertices alone: how far that is from touching the triangles, and
// that it costs no more than a small ball does.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "haptics/contact/touching.hpp"
#include "haptics/contact/triangle_contact.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/smooth_shapes.hpp"

namespace burin::haptics {
namespace {

using test::BumpySphere;

// A hand that is pressed into the shape by two millimetres and moves over it at 100 mm/s.
Vec3 hand_at(const BumpySphere& shape, double radius, int tick) {
    const double a = 0.002 * tick;
    const Vec3 d = glm::normalize(Vec3(std::cos(a), std::sin(1.3 * a), std::sin(a)));
    const double press = std::min(0.002, 2e-5 * tick - 0.001);
    return shape.point(d) + (radius - press) * shape.normal(d);
}

double distance_from(const geometry::LocalSurface& surface, const Vec3& center_object) {
    ContactWork work;
    const auto search = std::make_unique<ContactSearch>(surface, 0.001, ProxyBudget{.max_cost_ns = 1e9}, work);
    return search->nearest(center_object - surface.origin_object, 1.0).distance;
}

}  // namespace

TEST(FineSurface, ABallSinksInByNoMoreThanStated) {
    const BumpySphere shape{.radius_m = 0.05, .bump_m = 0.0005};
    const test::Surface surface = test::touchable(test::mesh_of(shape, 6));
    for (const double ratio : {9.0, 14.0, 25.0}) {
        const double radius = ratio * surface->mean_edge_m();
        ProxyState state;
        double deepest = 0.0;
        std::uint32_t points = 0;
        for (int i = 0; i < compute::test::repeated(1600); ++i) {
            const ProxyResult r = move_proxy(state, hand_at(shape, radius, i), {radius, true}, *surface);
            state = r.next;
            points += r.work.points;
            if (r.constraints > 0)
                deepest = std::max(deepest, radius - distance_from(*surface, state.position_object_m));
        }
        EXPECT_GT(points, 0u) << ratio;
        // By edge^2 / (6 R), and by what edges and corners may sink in.
        EXPECT_LE(deepest, (kFineEdge * kFineEdge / 6.0 + 2.0 * kTouch) * radius) << ratio;
    }
}

TEST(FineSurface, ALargeBallCostsNoMoreThanASmallOne) {
    const BumpySphere shape{.radius_m = 0.05, .bump_m = 0.0005};
    const test::Surface surface = test::touchable(test::mesh_of(shape, 6));
    const auto costs = [&](double ratio) {
        const double radius = ratio * surface->mean_edge_m();
        ProxyState state;
        std::vector<double> all;
        for (int i = 0; i < 1500; ++i) {
            const ProxyResult r = move_proxy(state, hand_at(shape, radius, i), {radius, true}, *surface);
            state = r.next;
            if (i >= 150) all.push_back(cost_ns(r.work));
        }
        std::ranges::sort(all);
        return std::pair{all[all.size() / 2], all.back()};
    };
    const auto [small, small_most] = costs(3.5);
    for (const double ratio : {10.0, 14.0, 25.0}) {
        const auto [large, large_most] = costs(ratio);
        EXPECT_LT(large, 2.0 * small) << ratio;
        EXPECT_LT(large_most, 2.0 * small_most) << ratio;
    }
}

// The stride among the vertices grows in ticks whose budget is too small for a look. It once grew without a bound, to
// 2^32, which is 0: then no later look came to an end, and the hand was held for good.
TEST(FineSurface, ABallIsFreeAgainAfterTicksThatWereTooShort) {
    const BumpySphere shape{.radius_m = 0.05, .bump_m = 0.0005};
    const test::Surface surface = test::touchable(test::mesh_of(shape, 6));
    const double radius = 14.0 * surface->mean_edge_m();
    for (const double budget_ns : {2e3, 5e3, 10e3, 20e3, 333e3}) {
        const ProxyBudget budget{.max_cost_ns = budget_ns};
        ProxyState state;
        int limited = 0;
        for (int i = 0; i < 400; ++i) {
            const ProxyResult r = move_proxy(state, hand_at(shape, radius, 40 * i), {radius, true}, *surface, budget);
            state = r.next;
            limited += r.work_limited;
            ASSERT_GE(state.stride, 1u) << budget_ns << " ns, tick " << i;
        }
        if (budget_ns <= 5e3) {
            EXPECT_GT(limited, 100) << budget_ns;
        }
        // Straight away from where the ball is, so that nothing lies between.
        const Vec3 out = glm::normalize(state.position_object_m);
        ProxyResult last;
        for (int i = 1; i <= 100; ++i) {
            last = move_proxy(state, (0.06 + std::min(0.001 * i, 0.03)) * out + 2.0 * radius * out, {radius, true},
                              *surface, ProxyBudget{});
            state = last.next;
        }
        EXPECT_EQ(last.constraints, 0u) << budget_ns;
        EXPECT_FALSE(last.work_limited) << budget_ns;
    }
}

TEST(FineSurface, AProxyOnANeedleArrives) {
    geometry::TriangleMesh needle;
    constexpr std::uint32_t kSides = 8;
    for (std::uint32_t i = 0; i < kSides; ++i)
        needle.positions_m.push_back({4e-4 * std::cos(0.785398 * i), 0.0, 4e-4 * std::sin(0.785398 * i)});
    needle.positions_m.push_back({0.0, 0.02, 0.0});
    needle.positions_m.push_back({0.0, 0.0, 0.0});
    for (std::uint32_t i = 0; i < kSides; ++i) {
        needle.triangles.push_back({i, kSides, (i + 1) % kSides});
        needle.triangles.push_back({i, (i + 1) % kSides, kSides + 1});
    }
    const test::Surface surface = test::touchable(needle);
    for (const double friction : {0.0, 0.3}) {
        int limited = 0, in_contact = 0;
        for (int run = 0; run < 20; ++run) {
            ProxyState state;
            for (int i = 0; i < 1000; ++i) {
                const double aside = 0.001 * std::sin(0.01 * i + run), turn = 0.3 * run + 0.004 * i;
                const double press = 0.003 * std::sin(0.003 * i * (1.0 + 0.1 * run));
                ProxySettings settings{.contact_radius_m = 0.002};
                settings.static_friction = settings.dynamic_friction = friction;
                const ProxyResult r = move_proxy(state, {aside * std::cos(turn), 0.022 - press, aside * std::sin(turn)},
                                                 settings, *surface);
                state = r.next;
                limited += r.work_limited;
                in_contact += r.constraints > 0;
            }
        }
        EXPECT_GT(in_contact, 10'000);
        // A quarter of the ticks ran out of steps where each step went a part of the way alone.
        EXPECT_LT(limited, in_contact / 30) << friction;
    }
}

}  // namespace burin::haptics
