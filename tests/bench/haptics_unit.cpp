// SPDX-License-Identifier: MIT
// The surface that bench haptics touches against closed forms, and its parts at small sizes: what must come out
// whatever the machine's speed.
#include "bench/haptics/haptics.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <random>
#include <set>

#include "base/json.hpp"
#include "bench/haptics/bumpy_sphere.hpp"
#include "bench/haptics/hand_path.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {
namespace {

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
}

const Tell kSilent = [](const std::string&) {};

Haptics small() {
    Haptics all;
    all.options = quick_haptics();
    return all;
}

}  // namespace

TEST(BumpySphere, GradientIsThatOfItsValue) {
    const BumpySphere shape;
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = 0.05 * (0.9 + 0.001 * i) * random_direction(random), d = random_direction(random);
        const double h = 1e-7, slope = (shape.value_m(p + h * d) - shape.value_m(p - h * d)) / (2.0 * h);
        EXPECT_NEAR(glm::dot(shape.gradient(p), d), slope, 1e-7);
    }
}

TEST(BumpySphere, TheNearestPointIsOnTheSurfaceAndNoneNearIsNearer) {
    const BumpySphere shape;
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        const Vec3 n = random_direction(random), from = (shape.radius_at_m(n) - 0.0015) * n;
        const auto nearest = shape.nearest(from, shape.radius_at_m(n) * n);
        ASSERT_TRUE(nearest.found);
        EXPECT_NEAR(shape.value_m(nearest.point), 0.0, 1e-12);
        const double distance = glm::length(nearest.point - from);
        for (int k = 0; k < 50; ++k) {
            const Vec3 m = glm::normalize(glm::normalize(nearest.point) + 0.02 * random_direction(random));
            EXPECT_GE(glm::length(shape.radius_at_m(m) * m - from), distance - 1e-12);
        }
    }
}

TEST(BumpySphere, MeshIsClosedTurnedOutwardsAndLiesOnTheSurface) {
    const BumpySphere shape;
    const geometry::TriangleMesh mesh = mesh_of(shape, 20);
    ASSERT_EQ(mesh.triangles.size(), 12u * 400u);
    EXPECT_EQ(mesh.positions_m.size(), 6u * 400u + 2u);  // Euler: V = 2 + F / 2
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second);
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
    for (const Vec3& p : mesh.positions_m) EXPECT_NEAR(shape.value_m(p), 0.0, 1e-15);
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += glm::dot(mesh.positions_m[a], glm::cross(mesh.positions_m[b], mesh.positions_m[c])) / 6.0;
    EXPECT_NEAR(volume, 4.0 / 3.0 * 3.14159265 * 1.25e-4, 0.01 * 5.236e-4);
    EXPECT_EQ(squares_for(2'000'000), 408);
}

TEST(PressedPath, GoesAtItsSpeedAndAsDeepAsItSays) {
    const BumpySphere ball{.bumps = 0.0};
    PressedPath path(ball, {.mean_m = 0.001, .swing_m = 0.0});
    path.step();
    for (int i = 0; i < 1000; ++i) {
        const Vec3 before = path.outward();
        path.step();
        EXPECT_NEAR(glm::length(path.outward() - before) * ball.radius_m, 1e-4, 1e-9);
        EXPECT_NEAR(ball.value_m(path.hip_m()), -0.001, 1e-12);
        EXPECT_NEAR(glm::length(path.orientation() * Vec3(0, 1, 0) - path.outward()), 0.0, 1e-12);
    }
}

TEST(BenchHaptics, AProxyStaysOnTheSurfaceAndLosesNoContactInMetresOrMillimetres) {
    Haptics all = small();
    ASSERT_TRUE(measure_accuracy(all, kSilent).has_value());
    EXPECT_EQ(all.errors.in_contact, all.errors.ticks);
    EXPECT_EQ(all.errors.not_solved, 0u);
    ASSERT_EQ(all.contact.size(), 3u);
    for (const LostContact& contact : all.contact) {
        EXPECT_GT(contact.inside, contact.ticks / 3) << contact.part;
        EXPECT_LT(contact.inside, contact.ticks) << contact.part;
        EXPECT_EQ(contact.lost, 0u) << contact.part << ' ' << contact.unit;
    }
    EXPECT_EQ(all.contact[2].part, "whole_loop");
    EXPECT_EQ(all.contact[0].inside, all.contact[1].inside);
    EXPECT_EQ(all.metres_and_1024ths_differ_um, 0.0);  // to the last bit
    ASSERT_EQ(all.jumps.size(), 2u);
    EXPECT_TRUE(all.jumps[0].shading);
    EXPECT_LT(all.jumps[0].largest_percent, all.jumps[1].largest_percent);
}

TEST(BenchHaptics, EveryEditIsUsedAndFeltAtTheNextTick) {
    Haptics all = small();
    ASSERT_TRUE(measure_edits(all, kSilent).has_value());
    EXPECT_EQ(all.edits.prepare_ms.size(), all.options.edits);
    EXPECT_EQ(all.edits.used_at_next_tick, all.options.edits);
    EXPECT_EQ(all.edits.felt_at_next_tick, all.options.edits);
    EXPECT_GT(all.edits.patches_made, 0u);
    EXPECT_EQ(all.edits.deform_ms.size(), all.options.edits);
}

TEST(BenchHaptics, TicksTouchEverySceneWithEveryProbe) {
    Haptics all = small();
    ASSERT_TRUE(measure_ticks(all, kSilent).has_value());
    EXPECT_EQ(all.ticks.size(), 3u * (4u * all.options.sizes.size() + 1u));
    for (const TickCosts& t : all.ticks) {
        const bool paced = t.pacing != "back_to_back";
        EXPECT_EQ(t.tick_us.size(), paced ? all.options.paced_ticks : all.options.back_to_back_ticks);
        EXPECT_EQ(t.lateness_us.size(), paced ? t.tick_us.size() : 0u);
        EXPECT_EQ(t.warm_up_us.size(), t.pacing == "paced" ? t.tick_us.size() : 0u);
        EXPECT_GT(t.in_contact, 9 * t.tick_us.size() / 10) << t.scene << " " << t.probe << " " << t.pacing;
        if (t.scene == "carving" && t.pacing == "back_to_back") {
            EXPECT_GE(t.surfaces_used, t.tick_us.size() / 10);
        }
    }
    EXPECT_NE(haptics_table(all).find("20_points"), std::string::npos);
    EXPECT_NE(haptics_svg(all).find("paced at 1 kHz"), std::string::npos);
    EXPECT_EQ(std::ranges::count(haptics_csv(all), '\n'), static_cast<std::ptrdiff_t>(all.ticks.size()) + 2);
}

TEST(BenchHaptics, ReportsAsJson) {
    const Workplace place;
    const auto outcome = place.run(std::string(BURIN_COMMAND) +
                                   " bench haptics --quick --paced-ticks 5 --ticks 500 --json out.json --csv out.csv");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(place.read("out.csv").starts_with("# "));
    const auto report = Json::parse(place.read("out.json"));
    EXPECT_EQ(report["ticks"].size(), 27u);
    EXPECT_TRUE(report["ticks"][0].contains("tick_p999_us"));
    EXPECT_EQ(report["contact"][0]["ticks"], 500);
    EXPECT_TRUE(report["edit"].contains("prepare_p99_ms"));
    EXPECT_TRUE(report["force_jumps"][0].contains("largest_jump_percent"));
}

}  // namespace burin::bench
