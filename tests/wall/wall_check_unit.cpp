// SPDX-License-Identifier: MIT
// Each mistake that people make with walls is found, named, and comes with a remedy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/wall/wall_samples.hpp"
#include "wall/output_settings.hpp"
#include "wall/screen.hpp"

namespace burin::wall {
namespace {

std::string all_lines(const std::vector<WallProblem>& problems) {
    std::string text;
    for (const WallProblem& p : problems) text += line_of(p) + "\n";
    return text;
}

void expect_found(const WallSetup& setup, bool error, const std::string& where, const std::string& part) {
    const auto problems = check(setup);
    EXPECT_TRUE(std::ranges::any_of(problems,
                                    [&](const WallProblem& p) {
                                        return p.error == error && p.where == where &&
                                               line_of(p).find(part) != std::string::npos;
                                    }))
        << "expected '" << part << "' of " << where << " in:\n"
        << all_lines(problems);
    for (const WallProblem& p : problems) {
        EXPECT_FALSE(p.remedy.empty()) << line_of(p);
        EXPECT_FALSE(p.what.empty());
    }
}

// Of a's corners to b's plane.
double nearest_corner_m(const Screen& a, const Screen& b) {
    const Vec3 n =
        glm::normalize(glm::cross(b.lower_right_world - b.lower_left_world, b.upper_left_world - b.lower_left_world));
    double least = HUGE_VAL;
    for (const Vec3& c : {a.lower_left_world, a.lower_right_world, a.upper_left_world,
                          a.lower_right_world + a.upper_left_world - a.lower_left_world}) {
        least = std::min(least, std::abs(glm::dot(c - b.lower_left_world, n)));
    }
    return least;
}

WallSetup with(const auto& change) {
    WallSetup setup = powerwall();
    change(setup, setup.screens[0]);
    return setup;
}

}  // namespace

TEST(WallCheck, FindsNothingWrongWithGoodWalls) {
    EXPECT_EQ(all_lines(check(powerwall())), "");
    EXPECT_EQ(all_lines(check(cave())), "");
}

TEST(WallCheck, FindsNothingWrongHoweverTheTrackerHangs) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 100; ++trial) {
        WallSetup setup = cave();
        const Pose moved{random_vector(random, 4.0), random_rotation(random)};
        const Quat back = glm::conjugate(moved.orientation);
        setup.world_from_tracker = {-(back * moved.position_m), back};
        for (WallScreen& s : setup.screens) {
            s.lower_left_tracker = moved * s.lower_left_tracker;
            s.lower_right_tracker = moved * s.lower_right_tracker;
            s.upper_left_tracker = moved * s.upper_left_tracker;
        }
        Pose& head = setup.fallback_head_tracker;
        head = {moved * head.position_m, moved.orientation * head.orientation};
        EXPECT_EQ(all_lines(check(setup)), "");
    }
}

TEST(WallCheck, FindsWrongCorners) {
    using S = WallSetup;
    using W = WallScreen;
    expect_found(with([](S&, W& w) { w.upper_left_tracker = {0, 0, 0}; }), true, "front", "on a line");
    expect_found(with([](S&, W& w) { w.upper_left_tracker.x += 0.1; }), true, "front", "87.50 degrees");
    expect_found(with([](S&, W& w) { w.upper_left_tracker.x = std::nan(""); }), true, "front", "not a number");
    expect_found(with([](S&, W& w) { w.upper_left_tracker = w.lower_left_tracker; }), true, "front", "0 m high");
    // As a mirror would have it.
    expect_found(with([](S&, W& w) {
                     std::swap(w.lower_left_tracker, w.lower_right_tracker);
                     w.upper_left_tracker = {1.524, 2.286, 0.0};
                 }),
                 true, "front", "left and right corners are exchanged");
    expect_found(with([](S&, W& w) {
                     w.lower_left_tracker = {1.524, 2.286, 0};
                     w.lower_right_tracker = {-1.524, 2.286, 0};
                     w.upper_left_tracker = {1.524, 0, 0};
                 }),
                 false, "front", "upside down");
    expect_found(with([](S& s, W&) {
                     s.fallback_head_tracker = {{0, 1.6, -2}, turned(0, 0, 0)};  // looks away from it
                 }),
                 true, "front", "2.00 m behind");
    expect_found(with([](S& s, W&) { s.fallback_head_tracker.position_m.z = 0.005; }), true, "front", "5.0 mm before");
}

// 3 m given as 3 mm, and as 3 km.
TEST(WallCheck, SuspectsTheUnitOfAbsurdSizes) {
    const auto scaled = [](double factor, LengthUnit unit) {
        WallSetup setup = powerwall();
        setup.unit = unit;
        for (Vec3* p : {&setup.screens[0].lower_left_tracker, &setup.screens[0].lower_right_tracker,
                        &setup.screens[0].upper_left_tracker}) {
            *p *= factor;
        }
        return setup;
    };
    expect_found(scaled(1e-3, LengthUnit::mm), true, "front", "units = \"m\" would make it 3.05 m");
    expect_found(scaled(1e3, LengthUnit::m), true, "front", "units = \"mm\" would make it 3.05 m");
    expect_found(scaled(0.01, LengthUnit::mm), true, "front", "0.03048 m wide");
}

TEST(WallCheck, FindsWrongEyes) {
    using S = WallSetup;
    using W = WallScreen;
    expect_found(with([](S& s, W&) { s.eyes = eyes_about({0, 0, 0}, 0.09); }), false, "viewer", "90 mm");
    expect_found(with([](S& s, W&) { s.eyes = eyes_about({0, 0, 0}, 0.04); }), false, "viewer", "40 mm");
    expect_found(with([](S& s, W&) { s.eyes = eyes_about({0, 0, 0}, 63.0); }), true, "viewer", "units");
    expect_found(with([](S& s, W&) { std::swap(s.eyes.left_sensor, s.eyes.right_sensor); }), true, "viewer",
                 "exchanged");
    expect_found(with([](S& s, W&) { s.eyes.left_sensor.x = std::nan(""); }), true, "viewer", "not a number");
    expect_found(with([](S& s, W&) { s.fallback_head_tracker.orientation = turned(0, 0, 1.4); }), false, "viewer",
                 "80 degrees from level");
}

TEST(WallCheck, FindsWrongOutputs) {
    using S = WallSetup;
    using W = WallScreen;
    expect_found(with([](S&, W& w) { w.pixels = {0, 1080}; }), true, "front", "0 by 1080");
    expect_found(with([](S&, W& w) { w.pixels = {1920, 1080}; }), false, "front", "1.59 mm wide and 2.12 mm high");
    expect_found(with([](S&, W& w) { w.homography = {{{1, 0, 0}, {2, 0, 0}, {0, 0, 1}}}; }), true, "front", "singular");
    expect_found(with([](S&, W& w) { w.homography = {{{1, 0, 0}, {0, 1, 0}, {-2, 0, 1}}}; }), true, "front",
                 "infinity");
    expect_found(with([](S&, W& w) { w.homography = {{{1.1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }), false, "front", "10 %");
    expect_found(with([](S&, W& w) { w.blend.left = 0.6; }), true, "front", "left edge blends over 0.6");
    expect_found(with([](S&, W& w) { w.blend.gamma = 22; }), true, "front", "gamma");
    expect_found(with([](S& s, W&) { s.timing.refresh_Hz = 0; }), true, "display", "0 Hz");
    expect_found(with([](S& s, W&) { s.timing.refresh_Hz = 60; }), false, "display", "30 Hz an eye");
    expect_found(with([](S& s, W&) { s.budget.crossed_deg = -1; }), true, "comfort", "-1 degrees");
    expect_found(with([](S& s, W&) { s.budget.uncrossed_deg = 5; }), false, "comfort", "5 degrees");
    expect_found(with([](S& s, W&) { s.screens.clear(); }), true, "wall", "no screen");
    expect_found(with([](S& s, W& w) {
                     w.homography = {{{0.9, 0.02, 0.03}, {0.01, 0.9, 0.04}, {0.02, -0.03, 1.0}}};
                     WallScreen second = screen_named("front", {2, 0, 0}, {4, 0, 0}, {2, 2, 0});
                     second.output = w.output;
                     s.screens.push_back(second);
                 }),
                 true, "front", "have this name");
}

TEST(WallCheck, AcceptsTheGammasThatTheOutputAcceptsAndNoOthers) {
    for (const double gamma : {-1.0, 0.0, 0.5, 0.99, 1.0, 2.2, 4.0, 4.01, std::nan("")}) {
        WallSetup setup;
        setup.screens.push_back(screen_named("front", {-1.5, 0, 0}, {1.5, 0, 0}, {-1.5, 2, 0}));
        setup.screens[0].blend.gamma = gamma;
        OutputSettings output;
        output.blend.gamma = gamma;
        const auto problems = check(setup);
        const bool refused =
            std::ranges::any_of(problems, [](const WallProblem& p) { return p.error && p.what.contains("gamma"); });
        EXPECT_EQ(refused, !check_output(output).has_value()) << gamma;
        EXPECT_EQ(refused, !(gamma >= 1.0 && gamma <= 4.0)) << gamma;
    }
}

TEST(WallCheck, FindsScreensThatShareAnOutputOrRoom) {
    WallSetup setup = cave();
    setup.screens[2].output = setup.screens[0].output;
    expect_found(setup, true, "right", "output left, as is screen left");
    setup = cave();
    for (Vec3* p : {&setup.screens[0].lower_left_tracker, &setup.screens[0].lower_right_tracker,
                    &setup.screens[0].upper_left_tracker}) {
        *p += Vec3{0.3, 0, -0.3};
    }
    expect_found(setup, true, "front", "passes through screen left");
    // Two projectors side by side, 20 cm on top of each other.
    WallSetup tiled = powerwall();
    tiled.screens = {screen_named("a", {-2, 0, 0}, {0.1, 0, 0}, {-2, 2, 0}),
                     screen_named("b", {-0.1, 0, 0}, {2, 0, 0}, {-0.1, 2, 0})};
    expect_found(tiled, false, "b", "without an edge blend");
    tiled.screens[0].blend.right = tiled.screens[1].blend.left = 0.2 / 2.1;
    EXPECT_EQ(all_lines(check(tiled)).find("blend"), std::string::npos);
}

// Two random rectangles cross just when a fine grid of points of one has points on both sides of the other near it.
TEST(ScreenOverlap, AgreesWithASearchByPoints) {
    std::mt19937 random(2);
    int crossing = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const auto rectangle = [&] {
            const Quat q = random_rotation(random);
            const Vec3 c = random_vector(random, 0.9), r = q * Vec3{1.0, 0, 0}, u = q * Vec3{0, 0.8, 0};
            return Screen{c - r - u, c + r - u, c - r + u};
        };
        const Screen a = rectangle(), b = rectangle();
        const Vec3 br = b.lower_right_world - b.lower_left_world, bu = b.upper_left_world - b.lower_left_world;
        const Vec3 bn = glm::normalize(glm::cross(br, bu));
        // Where rows of a pass through b's plane, seen in b's coordinates; the nearest to its inside in metres.
        double depth_m = -10.0;
        for (int i = 0; i <= 400; ++i) {
            for (const bool along : {false, true}) {
                const double t = 0.01 + 0.98 * i / 400.0;
                const Vec3 ar = a.lower_right_world - a.lower_left_world, au = a.upper_left_world - a.lower_left_world;
                const Vec3 from = a.lower_left_world + (along ? t * ar + 0.0125 * au : t * au + 0.01 * ar);
                const Vec3 to = from + (along ? 0.975 * au : 0.98 * ar);
                const double h0 = glm::dot(from - b.lower_left_world, bn), h1 = glm::dot(to - b.lower_left_world, bn);
                if (h0 * h1 >= 0.0) continue;
                const Vec3 d = from + (to - from) * (h0 / (h0 - h1)) - b.lower_left_world;
                const double x = glm::dot(d, br) / glm::length(br), y = glm::dot(d, bu) / glm::length(bu);
                depth_m = std::max(depth_m, std::min({x, glm::length(br) - x, y, glm::length(bu) - y}));
            }
        }
        // Touches, or only a corner's tip passes through: either answer will do.
        if (std::abs(depth_m) < 0.03 || std::min(nearest_corner_m(a, b), nearest_corner_m(b, a)) < 0.06) continue;
        EXPECT_EQ(overlap_of(a, b) == Overlap::crossing, depth_m > 0.0) << trial << ' ' << depth_m;
        EXPECT_EQ(overlap_of(a, b), overlap_of(b, a));
        crossing += depth_m > 0.0 ? 1 : 0;
    }
    EXPECT_GT(crossing, 50);
}

}  // namespace burin::wall
