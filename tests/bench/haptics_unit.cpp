// SPDX-License-Identifier: MIT
// The surface that bench haptics touches against closed forms, and its parts at small sizes: what must come out
// whatever the machine's speed.
#include "bench/haptics/haptics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "base/json.hpp"
#include "base/statistics.hpp"
#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics_rows.hpp"
#include "bench/measure/bumpy_sphere.hpp"
#include "bench/peers/proxy_peer.hpp"
#include "session/state/session_room.hpp"
#include "session/state/session_state.hpp"
#include "tests/support/places.hpp"
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

// By counts, which are the same on every machine.
TEST(BenchHaptics, BothEndsOfAWandInATubeTakeAtMostTwiceTheWorkOfOne) {
    Haptics all = small();
    ASSERT_TRUE(measure_wand(all, kSilent));
    ASSERT_EQ(all.wand.size(), 3u);
    for (const WandWork& ends : all.wand) {
        EXPECT_EQ(ends.cost_us.size(), all.options.wand_ticks) << ends.points;
        EXPECT_GT(ends.in_contact, all.options.wand_ticks / 20) << ends.points;
    }
    EXPECT_GT(all.wand[0].in_contact, std::max(all.wand[1].in_contact, all.wand[2].in_contact));
    for (const double share : {0.5, 0.999}) {
        const double one = 0.5 * (quantile(all.wand[1].cost_us, share) + quantile(all.wand[2].cost_us, share));
        EXPECT_GT(one, 0.0);
        EXPECT_LE(quantile(all.wand[0].cost_us, share), 2.2 * one) << share;
    }
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
    all.options.scenes.workpiece = "no/such/file.obj";
    ASSERT_TRUE(measure_ticks(all, kSilent).has_value());
    std::set<std::string> scenes;
    for (const TickCosts& t : all.ticks) {
        const std::string what = t.scene + " " + t.probe + " " + t.pacing;
        scenes.insert(t.scene);
        const bool paced = t.pacing != "back_to_back";
        EXPECT_EQ(t.tick_us.size(), paced ? all.options.paced_ticks : all.options.back_to_back_ticks) << what;
        EXPECT_EQ(t.lateness_us.size(), t.tick_us.size()) << what;
        EXPECT_EQ(t.warm_up_us.size(), t.pacing == "rehearsed" ? t.tick_us.size() : 0u) << what;
        for (const auto* counts : {&t.tests, &t.looks, &t.gathered, &t.steps, &t.solves, &t.cost_us})
            EXPECT_EQ(counts->size(), t.tick_us.size()) << what;
        EXPECT_EQ(t.contact_lost.has_value(), !paced && t.probe != "two_points" && t.probe != "20_points") << what;
        // Between needles a point is in the open.
        if (t.scene != "needles") {
            EXPECT_GT(t.in_contact, 8 * t.tick_us.size() / 10) << what;
        }
    }
    EXPECT_EQ(scenes, (std::set<std::string>{"sphere", "rough_ball", "rough_plate", "file", "machined", "needles"}));
    ASSERT_EQ(all.notes.size(), 2u);
    EXPECT_TRUE(all.notes[0].starts_with("no/such/file.obj"));
    EXPECT_NE(all.notes[1].find("--models"), std::string::npos);
}

TEST(BenchHaptics, TheCountsAreTheSameAgain) {
    const auto counts = [] {
        Haptics all = small();
        all.options.scenes = {.rough_triangles = 2'000, .sides = 16, .needles = 4, .workpiece = "no/such/file.obj"};
        all.options.paced_ticks = 1;
        EXPECT_TRUE(measure_ticks(all, kSilent).has_value());
        std::vector<double> tests;
        for (const TickCosts& t : all.ticks)
            if (t.pacing == "back_to_back") tests.insert(tests.end(), t.tests.begin(), t.tests.end());
        return tests;
    };
    EXPECT_EQ(counts(), counts());
}

TEST(BenchHaptics, AToolIsFeltWhileItCarvesAndInItsOwnGroove) {
    Haptics all = small();
    ASSERT_TRUE(measure_carving_ticks(all, kSilent).has_value());
    EXPECT_EQ(all.ticks.size(), 12u);  // carving and groove, two tools, three pacings
    for (const TickCosts& t : all.ticks) {
        // Paced, a busy machine may let the carving thread fall behind the hand.
        if (t.scene.starts_with("carving") && t.pacing != "back_to_back") continue;
        EXPECT_GT(t.in_contact, 9 * t.tick_us.size() / 10) << t.scene << " " << t.probe << " " << t.pacing;
        EXPECT_EQ(t.left_behind, 0u) << t.scene << " " << t.probe << " " << t.pacing;
        if (t.pacing == "back_to_back") {
            EXPECT_GE(t.surfaces_used, t.tick_us.size() / 10) << t.scene;
        }
    }
}

TEST(BenchHaptics, ModelsOfAFolderAreTouchedAndAnEmptyOneIsRefused) {
    const Workplace place;
    EXPECT_FALSE(touch_scenes({.models = (place / "").string()}).has_value());
    place.write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n7 0 0\n0 5 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    place.write("notes.txt", "not a mesh");
    const auto scenes = touch_scenes({.models = (place / "").string()});
    ASSERT_TRUE(scenes.has_value());
    EXPECT_EQ(scenes->scenes.back().name, "tetrahedron");
    const auto mesh = scenes->scenes.back().make();
    ASSERT_TRUE(mesh.has_value());
    Box box;
    for (const Vec3& p : mesh->positions_m) box.include(p);
    EXPECT_NEAR(box.extent().x, 0.1, 1e-12);
    EXPECT_NEAR(box.center().z, 0.0, 1e-12);
}

TEST(BenchHaptics, TheWorstStandsFirstAndSkippedDeadlinesAreNamed) {
    const auto run = [](const char* scene, const char* pacing, double us) {
        TickCosts t;
        t.scene = scene, t.pacing = pacing, t.probe = "point";
        t.tick_us = {1.0, us};
        t.tests = t.looks = t.steps = t.solves = {1.0, 2.0};
        return t;
    };
    std::vector<TickCosts> ticks{run("easy", "cold", 2.0), run("easy", "back_to_back", 50.0), run("hard", "cold", 9.0),
                                 run("hard", "back_to_back", 8.0)};
    sort_worst_first(ticks);
    EXPECT_EQ(ticks[0].scene, "hard");
    EXPECT_EQ(ticks[1].scene, "hard");
    EXPECT_EQ(ticks[2].pacing, "cold");
    Haptics all;
    all.ticks = ticks;
    EXPECT_LT(haptics_table(all).find("hard"), haptics_table(all).find("easy"));
    EXPECT_NE(haptics_table(all).find("no deadline of 4 was skipped"), std::string::npos);
    all.ticks[0].skipped_deadlines = 3;
    EXPECT_NE(haptics_table(all).find("3 of 7 deadlines were SKIPPED, in 1 runs"), std::string::npos);
    EXPECT_NE(haptics_svg(all).find("cold"), std::string::npos);
    EXPECT_EQ(std::ranges::count(haptics_csv(all), '\n'), static_cast<std::ptrdiff_t>(all.ticks.size()) + 2);
}

TEST(BenchHaptics, ThePeerIsComparedInEverySceneOrSaysWhyNot) {
    Haptics all = small();
    all.options.scenes = {.rough_triangles = 2'000, .sides = 16, .needles = 4, .workpiece = "no/such/file.obj"};
    ASSERT_TRUE(measure_peer_ticks(all, kSilent).has_value());
    if (!has_chai3d()) {
        ASSERT_EQ(all.notes.size(), 1u);
        EXPECT_NE(all.notes[0].find("-DBURIN_CHAI3D"), std::string::npos);
        EXPECT_TRUE(all.peers.empty());
        return;
    }
    EXPECT_EQ(all.peers.size(), 5u * 3u * 2u * 5u);  // programs and modes, probes, friction, scenes
    for (const PeerTicks& t : all.peers) {
        EXPECT_EQ(t.cold_us.size(), all.options.peer_ticks);
        EXPECT_EQ(t.back_to_back_us.size(), 2 * all.options.peer_ticks);
        EXPECT_EQ(t.from_nearest_um.size(), t.probe == "point" ? 2 * all.options.peer_ticks : 0u);
    }
}

TEST(BenchHaptics, RatiosToThePeerAreOfTheSameTicksAndTheWorstStandsFirst) {
    std::vector<PeerTicks> peers;
    for (const double ours_us : {2.0, 6.0})
        for (const char* who : {"burin_tick", "burin_contact", "burin_unshaded", "chai3d_static", "chai3d_dynamic"}) {
            PeerTicks t;
            t.scene = ours_us > 5.0 ? "hard" : "easy", t.probe = "point", t.who = who;
            const bool theirs = t.who.starts_with("chai3d");
            t.cold_us = t.back_to_back_us = {theirs ? 4.0 : ours_us};
            t.sunk_um = t.from_hand_mm = {1.0};
            peers.push_back(t);
        }
    const Json ratios = peer_ratios(peers);
    ASSERT_EQ(ratios.size(), 2u);
    EXPECT_EQ(ratios[0]["scene"].get<std::string>(), "hard");
    EXPECT_EQ(ratios[0]["cold_contact_over_dynamic_p999"], 1.5);
    EXPECT_EQ(ratios[1]["back_to_back_tick_over_static_p50"], 0.5);
    EXPECT_LT(peers_table(peers).find("hard"), peers_table(peers).find("easy"));
    EXPECT_EQ(peers_table({}), "");
}

TEST(BenchHaptics, TouchesWithTheParametersOfASession) {
    session::SessionState state;
    ASSERT_TRUE(session::take_up(state));
    const session::Room room;
    const haptics::TickParameters bench = session_parameters({}, true), session = session::parameters_of(state, room);
    EXPECT_EQ(bench.shading, session.shading);
    EXPECT_EQ(bench.clearance_ratio, session.clearance_ratio);
    EXPECT_EQ(bench.action, session.action);
    EXPECT_EQ(bench.max_surface_age_s, session.max_surface_age_s);
    EXPECT_EQ(bench.position_noise_m, session.position_noise_m);
    EXPECT_EQ(bench.signals.force_alpha, session.signals.force_alpha);
    EXPECT_EQ(bench.signals.velocity, session.signals.velocity);
    EXPECT_EQ(bench.limit_stiffness, session.limit_stiffness);
    for (std::size_t i = 0; i < bench.materials.size(); ++i) {
        EXPECT_EQ(bench.materials[i].static_friction, session.materials[i].static_friction);
        EXPECT_EQ(bench.materials[i].dynamic_friction, session.materials[i].dynamic_friction);
        EXPECT_EQ(bench.materials[i].stiffness_N_per_m, session.materials[i].stiffness_N_per_m);
        EXPECT_EQ(bench.materials[i].hardness_Ns_per_m3, session.materials[i].hardness_Ns_per_m3);
    }
    EXPECT_EQ(session_parameters({}, false).materials[0].static_friction, 0.0);
}

TEST(BenchHaptics, ReportsAsJson) {
    const Workplace place;
    const auto outcome = place.run(std::string(kBurinCommand) +
                                   " bench haptics --quick --paced-ticks 2 --ticks 500 --json out.json --csv out.csv");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(place.read("out.csv").starts_with("# "));
    const auto report = Json::parse(place.read("out.json"));
    EXPECT_GT(report["ticks"].size(), 150u);
    EXPECT_TRUE(report["ticks"][0].contains("tick_p999_us"));
    EXPECT_EQ(report["ticks"][0]["pacing"].get<std::string>(), "cold");
    EXPECT_GE(report["notes"].size(), 2u);
    EXPECT_EQ(report["contact"][0]["ticks"], 500);
    EXPECT_TRUE(report["edit"].contains("prepare_p99_ms"));
    EXPECT_TRUE(report["force_jumps"][0].contains("largest_jump_percent"));
}

}  // namespace burin::bench
