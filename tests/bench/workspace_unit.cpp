// SPDX-License-Identifier: MIT
// The simulated hand against its own model's closed forms, and what must hold of any fair comparison of the techniques.
#include "bench/workspace/workspace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/json.hpp"
#include "base/plot/figures.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {
namespace {

const Vec3 kRoom{1.0};  // a device's box that limits nothing

HandModel exact_hand() {
    HandModel model;
    model.spread_s = model.least_spread_m = model.tremor_m = 0.0;
    return model;
}

double mean_of(const WorkspaceFigures& f, double Reach::* value) {
    double sum = 0.0;
    for (const Reach& r : f.reaches) sum += r.*value;
    return sum / static_cast<double>(f.reaches.size());
}

bool all_reached(const WorkspaceFigures& f) {
    return std::ranges::all_of(f.reaches, [](const Reach& r) { return r.reached; });
}

WorkspaceTask few_targets() {
    WorkspaceTask task;
    task.targets = 5;
    return task;
}

// Every technique once; the tests that follow look at the same run.
const std::vector<WorkspaceFigures>& one_run() {
    static const std::vector<WorkspaceFigures> run = [] {
        std::vector<WorkspaceFigures> figures;
        for (const Approach& approach : all_approaches()) figures.push_back(reach_targets(approach, few_targets()));
        return figures;
    }();
    return run;
}

const WorkspaceFigures& run_of(const std::string& name) {
    return *std::ranges::find(one_run(), name, [](const WorkspaceFigures& f) { return f.approach.name; });
}

}  // namespace

TEST(ReachingHand, FollowsTheMinimumJerkPathInTheTimeOfItsDistance) {
    ReachingHand hand(exact_hand(), kRoom, 1);
    const Vec3 goal(0.09, -0.03, 0.02);
    hand.aim(goal);
    const double lasts_s = 0.12 + 0.06 * std::log2(1.0 + glm::length(goal) / 0.002);
    for (int i = 1; i * 1e-3 < lasts_s; ++i) {
        const double u = i * 1e-3 / lasts_s;
        const Vec3 expected = goal * (u * u * u * (10.0 - 15.0 * u + 6.0 * u * u));  // Flash and Hogan 1985
        ASSERT_LT(glm::length(hand.step(Vec3(0.0), 1e-3) - expected), 1e-12) << i;
        ASSERT_TRUE(hand.moving());
    }
    EXPECT_LT(glm::length(hand.step(Vec3(0.0), 1e-3) - goal), 1e-6);
    EXPECT_FALSE(hand.moving());
}

TEST(ReachingHand, TurnsOnItsWayWithoutAJerk) {
    ReachingHand hand(exact_hand(), kRoom, 1);
    hand.aim({0.1, 0.0, 0.0});
    Vec3 before(0.0), speed(0.0);
    for (int i = 0; i < 800; ++i) {
        if (i == 150) hand.aim({0.0, 0.1, 0.0});
        const Vec3 now = hand.step(Vec3(0.0), 1e-3);
        const Vec3 next_speed = (now - before) / 1e-3;
        // 100 mm in 0.46 s: the greatest acceleration on the minimum-jerk path is 5.77 D / T^2 = 2.7 m/s^2.
        const double change = i > 0 ? glm::length(next_speed - speed) : 0.0;
        ASSERT_LT(change, 6.0 * 1e-3) << i;
        before = now;
        speed = next_speed;
    }
    EXPECT_LT(glm::length(before - Vec3(0.0, 0.1, 0.0)), 1e-6);
}

TEST(ReachingHand, MissesByAShareOfItsSpeedAlongTheWayAndHalfOfItAcross) {
    HandModel model;
    model.tremor_m = 0.0;
    double along = 0.0, across = 0.0;
    constexpr int kTries = 2000;
    const double distance = 0.08;
    for (int i = 0; i < kTries; ++i) {
        ReachingHand hand(model, kRoom, static_cast<std::uint64_t>(i));
        hand.aim({distance, 0.0, 0.0});
        while (hand.moving()) hand.step(Vec3(0.0), 1e-2);
        const Vec3 miss = hand.position_device_m() - Vec3(distance, 0.0, 0.0);
        along += miss.x * miss.x / kTries;
        across += miss.y * miss.y / kTries;
    }
    const double speed = distance / (0.12 + 0.06 * std::log2(1.0 + distance / 0.002));
    const double spread = std::hypot(0.0002, 0.02 * speed);
    // A variance of n normal deviates is known to sqrt(2 / n) of itself: 3 %; four of these.
    EXPECT_NEAR(along / (spread * spread), 1.0, 0.13);
    EXPECT_NEAR(across / (0.25 * spread * spread), 1.0, 0.13);
}

TEST(ReachingHand, TremblesYieldsAndStopsAtTheDevicesBox) {
    HandModel model = exact_hand();
    model.tremor_m = 0.00008;
    ReachingHand resting(model, kRoom, 3);
    Vec3 squares(0.0);
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 p = resting.step(Vec3(0.0), 1e-3);
        squares += p * p / 20'000.0;
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::sqrt(squares[axis]), 0.00008, 2e-6);

    ReachingHand pushed(exact_hand(), {0.16, 0.12, 0.07}, 3);
    for (int i = 0; i < 500; ++i) pushed.step({2.0, -1.0, 0.0}, 1e-3);
    EXPECT_LT(glm::length(pushed.position_device_m() - Vec3(0.01, -0.005, 0.0)), 1e-6) << "5 mm a newton";
    pushed.aim({0.5, 0.0, -0.5});
    for (int i = 0; i < 1000; ++i) pushed.step(Vec3(0.0), 1e-3);
    EXPECT_LT(glm::length(pushed.position_device_m() - Vec3(0.08, 0.0, -0.035)), 1e-6);
}

TEST(WorkspaceBench, GivesTheSameFiguresFromTheSameSeedAndOthersFromAnother) {
    WorkspaceTask task = few_targets();
    task.targets = 2;
    const Approach approach = all_approaches()[1];
    const auto figures = [&] { return workspace_json({reach_targets(approach, task)}, task)["techniques"].dump(); };
    const std::string once = figures();
    EXPECT_EQ(figures(), once);
    task.seed = 2;
    EXPECT_NE(figures(), once);
}

TEST(WorkspaceBench, EveryTechniqueButTheFixedWorkspaceReachesAllTargets) {
    for (const WorkspaceFigures& f : one_run()) {
        EXPECT_EQ(all_reached(f), f.approach.technique != haptics::WorkspaceTechnique::fixed) << f.approach.name;
        for (const Reach& r : f.reaches) {
            if (!r.reached) continue;
            EXPECT_GE(r.tool_path_m, r.distance_m - 0.01) << "no path is shorter than the straight line to the radius";
            EXPECT_LT(r.precision_m, 0.01) << f.approach.name;
        }
    }
}

TEST(WorkspaceBench, AFixedWorkspaceReachesWhatIsInIt) {
    const Vec3 near(0.05, -0.04, 0.02), far(0.3, 0.0, 0.0);
    const WorkspaceFigures figures = reach_targets(all_approaches()[0], few_targets(), {near, far, -near});
    EXPECT_TRUE(figures.reaches[0].reached);
    EXPECT_FALSE(figures.reaches[1].reached);
    EXPECT_TRUE(figures.reaches[2].reached);
}

TEST(WorkspaceBench, AmplifiedMotionIsTheFastestAndTheLeastPrecise) {
    for (const WorkspaceFigures& f : one_run()) {
        if (f.approach.name == "scaling" || f.approach.name == "fixed") continue;
        EXPECT_GT(mean_of(f, &Reach::time_s), mean_of(run_of("scaling"), &Reach::time_s)) << f.approach.name;
        // The hand's errors are amplified 19 times; elsewhere they are not.
        EXPECT_LT(mean_of(f, &Reach::precision_m), 0.7 * mean_of(run_of("scaling"), &Reach::precision_m))
            << f.approach.name;
    }
}

TEST(WorkspaceBench, PressesWhereTheTechniqueAsksForThemOnly) {
    for (const WorkspaceFigures& f : one_run()) {
        for (const Reach& r : f.reaches) {
            const double boxes = r.distance_m / 0.1626;  // workspaces side by side from the tool to the target
            if (f.approach.name == "moving, taps") {
                // A jump is half a workspace long in its longest axis at most, and half its diagonal, 0.108 m.
                EXPECT_GE(r.presses, std::floor((r.distance_m - 0.22) / 0.108));
                EXPECT_LE(r.presses, 2.0 * 0.1626 / 0.0711 * boxes + 5.0);
            } else if (f.approach.name == "moving, drag") {
                EXPECT_LE(r.presses, 3);
            } else if (f.approach.name == "clutching") {
                EXPECT_GE(r.presses, std::floor(r.distance_m / 0.216) - 1.0) << "a stroke is a diagonal at most";
            } else {
                EXPECT_EQ(r.presses, 0) << f.approach.name;
            }
        }
    }
}

TEST(WorkspaceBench, SaysItAllAsTableCsvJsonAndFigure) {
    const auto& run = one_run();
    const WorkspaceTask task = few_targets();
    const std::string table = workspace_table(run), csv = workspace_csv(run), svg = workspace_svg(run, task);
    const auto json = workspace_json(run, task);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 8);
    EXPECT_EQ(json["techniques"].size(), 7u);
    for (const Approach& approach : all_approaches()) {
        for (const std::string* text : {&table, &csv, &svg}) {
            EXPECT_NE(text->find(approach.name), std::string::npos) << approach.name;
        }
    }
    EXPECT_TRUE(json["techniques"][0]["time_median_s"].is_null()) << "no target, no time";
    EXPECT_EQ(json["techniques"][0]["failures"], 5);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(csv.find("nan"), std::string::npos);
    for (const Json& assumption : json["assumptions"]) {
        const auto line = assumption.get<std::string>();
        EXPECT_NE(svg.find(line), std::string::npos) << "the figure states its assumptions";
    }
}

TEST(WorkspaceBench, IsASubcommandThatRefusesWhatItCannotDo) {
    const std::string bench = std::string(kBurinCommand) + " bench workspace ";
    const Workplace place;
    EXPECT_EQ(place.run(bench + "--targets 0").status, 2);
    const auto refused = place.run(bench + "--targets 1 --svg missing/figure.svg");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.output.find("make the folder"), std::string::npos) << refused.output;
    EXPECT_EQ(place.files(), 0u);
    const auto done = place.run(bench + "--targets 1 --seed 5 --csv t.csv --svg f.svg --json r.json");
    ASSERT_EQ(done.status, 0) << done.output;
    EXPECT_NE(done.output.find("not people"), std::string::npos);
    EXPECT_EQ(Json::parse(place.read("r.json"))["task"]["seed"], 5);
    EXPECT_TRUE(place.read("f.svg").ends_with("</svg>\n"));
}

TEST(DotChart, LeavesOutWhatAnAxisCannotShowAndSaysSo) {
    const std::string svg = plot::dot_chart(
        "t <1>", {"a", "b", "c"}, {{"p", true, 1, {{2.0, 4.0}, {0.0, 0.0}, {std::nan(""), 0.0}}}}, {"note & more"});
    EXPECT_EQ(std::count(svg.begin(), svg.end(), '<'), std::count(svg.begin(), svg.end(), '>'));
    const auto count = [&](const std::string& what) {
        int n = 0;
        for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
        return n;
    };
    EXPECT_EQ(count("<circle"), 1);
    EXPECT_EQ(count(">never<"), 1);
    EXPECT_EQ(count("note &amp; more"), 1);
    EXPECT_EQ(count("t &lt;1&gt;"), 1);
}

}  // namespace burin::bench
