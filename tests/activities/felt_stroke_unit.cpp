// SPDX-License-Identifier: MIT
// Carving by feel: what the hand presses and what the material is made of set how deep the groove gets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "activities/carve/felt_stroke.hpp"
#include "haptics/forces/cutting.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

constexpr double kRadius_m = 0.003;
constexpr double kTop_m = 0.02;  // of the block, whose corner is the origin
constexpr double kMiddle_m = 0.02, kAside_m = 0.015;
constexpr double kPi = 3.14159265358979;

struct Felt {
    session::FeltFigures figures;
    double volume_removed_m3 = 0.0;
};

Felt felt_on(const std::string& block, int resolution, const toolbox::ToolOptions& tool, const sculpt::Stroke& stroke,
             const toolbox::FeelOptions& options) {
    Result<sculpt::MadeWorkpiece> made = sculpt::make_workpiece({block, resolution, false}, compute::on_processor, 2);
    const sculpt::Sculpture& carving = *made->carving;
    session::SessionSetup setup;
    setup.hands.tool = tool;
    setup.carve.feel = options;
    const auto opened = OpenedStroke::create(std::move(*made), stroke, setup);
    Felt felt;
    felt.figures = *(*opened)->run({});
    felt.volume_removed_m3 = carving.initial_volume_m3() - carving.surface().volume_m3();
    return felt;
}

toolbox::ToolOptions ball_tool(double radius_m) { return {.shape = "ball:" + std::to_string(radius_m)}; }

Felt felt_on_a_block(const sculpt::Stroke& stroke, const toolbox::FeelOptions& options,
                     compute::Operation operation = compute::Operation::cut) {
    toolbox::ToolOptions tool = ball_tool(kRadius_m);
    tool.operation = operation;
    return felt_on("block:0.04,0.03,0.02", 96, tool, stroke, options);
}

sculpt::StrokeRow row(double time_s, double x, double height_m, bool button) {
    return {time_s, {kMiddle_m + x, kAside_m, kTop_m + kRadius_m + height_m}, {1, 0, 0, 0}, button};
}

// Along the block's top at this speed, the tool just touching; pressed by the hand alone.
sculpt::Stroke along(double speed_m_per_s) {
    const double from = -0.012, to = 0.012;
    sculpt::Stroke stroke{row(0.0, from, 0.003, false), row(0.1, from, 0.0, false)};
    const int steps = 60;
    const double step_s = (to - from) / steps / speed_m_per_s;
    for (int i = 1; i <= steps; ++i) stroke.push_back(row(0.1 + step_s * i, from + (to - from) * i / steps, 0.0, true));
    stroke.push_back(row(stroke.back().time_s + 0.1, to, 0.004, false));
    return stroke;
}

// How deep the tool runs in the middle of its way, and the force along and across that it has there.
struct Running {
    double depth_m = 0.0, press_N = 0.0, drag_N = 0.0, speed_m_per_s = 0.0;
};
Running running(const session::FeltFigures& felt) {
    Running sum;
    int count = 0;
    const session::TracePoint *first = nullptr, *last = nullptr;
    for (const session::TracePoint& p : felt.trace) {
        if ((p.flags & haptics::kTickCutting) == 0 || p.cut_object_m.x < kMiddle_m - 0.002 ||
            p.cut_object_m.x > kMiddle_m + 0.006)
            continue;
        if (first == nullptr) first = &p;
        last = &p;
        sum.depth_m += kTop_m + kRadius_m - p.cut_object_m.z;
        sum.press_N += p.force_device_N.z;
        sum.drag_N -= p.force_device_N.x;
        ++count;
    }
    if (count < 10) return {};
    sum.speed_m_per_s = (last->cut_object_m.x - first->cut_object_m.x) / (last->time_s - first->time_s);
    sum.depth_m /= count, sum.press_N /= count, sum.drag_N /= count;
    return sum;
}

toolbox::FeelOptions feel(double hardness, double press_N) {
    toolbox::FeelOptions options;
    options.hardness = std::to_string(hardness);
    options.press_N = press_N;
    options.grip_N_per_m = 600.0;
    return options;
}

}  // namespace

TEST(Felt, TheGrooveIsDeeperTheMoreTheHandPressesAndTheSofterTheMaterial) {
    double last = 0.0, last_volume = 0.0;
    for (const double press_N : {0.6, 1.0, 1.6}) {
        const Felt felt = felt_on_a_block(along(0.04), feel(6.0, press_N));
        const Running at = running(felt.figures);
        EXPECT_GT(at.depth_m, 1.1 * last) << press_N;
        EXPECT_GT(felt.volume_removed_m3, 1.1 * last_volume) << press_N;
        last = at.depth_m, last_volume = felt.volume_removed_m3;
    }
    last = 1.0, last_volume = 1.0;
    for (const double hardness : {3.0, 6.0, 12.0, 24.0}) {
        const Felt felt = felt_on_a_block(along(0.04), feel(hardness, 1.0));
        const Running at = running(felt.figures);
        EXPECT_LT(at.depth_m, 0.95 * last) << hardness;
        EXPECT_LT(felt.volume_removed_m3, 0.95 * last_volume) << hardness;
        last = at.depth_m, last_volume = felt.volume_removed_m3;
    }
}

TEST(Felt, TheGrooveIsAsDeepAsTheClosedFormOfForceHardnessAndSpeedSays) {
    for (const auto& [hardness, press_N] : {std::pair{4.0, 1.0}, {8.0, 1.0}, {8.0, 1.6}}) {
        const Running at = running(felt_on_a_block(along(0.04), feel(hardness, press_N)).figures);
        ASSERT_GT(at.depth_m, 0.0002);
        // The lift of a tool that runs so deep bears the press: half a section at the yield, and H A_nt v. How deep it
        // lies is read from facets of a seventh of its radius and from a surface that is up to 10 ms old; a quarter of
        // the force is the tolerance.
        const double half_section_m2 = 0.5 * kPi * at.depth_m * (2.0 * kRadius_m - at.depth_m);
        const double lift_N =
            toolbox::parse_feel(feel(hardness, press_N))->material.cutting_yield_Pa * half_section_m2 +
            hardness * 1e6 * haptics::test::engaged_areas(kRadius_m, at.depth_m).lift_m2 * at.speed_m_per_s;
        EXPECT_NEAR(lift_N / at.press_N, 1.0, 0.25) << hardness << ' ' << press_N << ' ' << at.depth_m;
        EXPECT_GT(at.drag_N, 0.0);
        EXPECT_LT(at.drag_N, at.press_N);
    }
}

TEST(Felt, PressedOnTheSpotTheToolSinksAsTheClosedFormSays) {
    // The tool is set down, then pressed for 0.4 s without moving.
    sculpt::Stroke stroke{row(0.0, 0.0, 0.003, false), row(0.2, 0.0, -0.003, false), row(0.5, 0.0, -0.003, true),
                          row(0.9, 0.0, -0.003, false)};
    toolbox::FeelOptions options = feel(20.0, 0.0);
    options.yield_kPa = 0.0;
    const Felt felt = felt_on_a_block(stroke, options);
    // dF/dt: the depth's own closed form needs the force, which falls as the tool sinks; it is summed up from the
    // trace: H * integral of A_nn(D) dD = integral of F dt.
    double impulse_Ns = 0.0, depth_m = 0.0, last_s = -1.0;
    for (const session::TracePoint& p : felt.figures.trace) {
        if ((p.flags & haptics::kTickCutting) == 0) continue;
        if (last_s >= 0.0) impulse_Ns += p.force_device_N.z * (p.time_s - last_s);
        last_s = p.time_s;
        depth_m = kTop_m + kRadius_m - p.cut_object_m.z;
    }
    ASSERT_GT(depth_m, 0.0003);
    double resistance_Ns = 0.0;
    for (int i = 0; i < 1000; ++i)
        resistance_Ns +=
            20e6 * haptics::test::engaged_areas(kRadius_m, depth_m * (i + 0.5) / 1000).into_m2 * depth_m / 1000;
    EXPECT_NEAR(resistance_Ns / impulse_Ns, 1.0, 0.2) << depth_m;
}

TEST(Felt, PressedOnTheSpotTheToolComesToRestWhereItsSectionAtTheYieldBearsThePress) {
    // Craters of 5 to 7 cells across; harder, the surface's cells show (one of 4 cells bears 0.17 more than it should).
    for (const double yield_kPa : {40.0, 80.0}) {
        sculpt::Stroke stroke{row(0.0, 0.0, 0.003, false), row(0.2, 0.0, -0.002, false), row(0.3, 0.0, -0.002, true),
                              row(2.8, 0.0, -0.002, false)};
        toolbox::FeelOptions options = feel(8.0, 0.0);
        options.yield_kPa = yield_kPa;
        const Felt felt = felt_on_a_block(stroke, options);
        const session::TracePoint* last = nullptr;
        for (const session::TracePoint& p : felt.figures.trace) {
            if ((p.flags & haptics::kTickCutting) != 0) last = &p;
        }
        ASSERT_NE(last, nullptr);
        const double depth_m = kTop_m + kRadius_m - last->cut_object_m.z;
        const double held_N = yield_kPa * 1e3 * kPi * depth_m * (2.0 * kRadius_m - depth_m);
        EXPECT_NEAR(held_N / last->force_device_N.z, 1.0, 0.1) << yield_kPa << ' ' << depth_m;
    }
}

// A tool as wide as a third of the block: what touches is smaller than what cuts by the clearance, which grows with the
// tool, and the triangles near it are more than a tick can look at.
TEST(Felt, AToolIsHeldByTheMaterialHoweverLargeItIsAndHoweverFineTheBlock) {
    constexpr double kYield_Pa = 120e3, kGrip_N_per_m = 200.0, kDeep_m = 0.003;
    toolbox::FeelOptions options = feel(2.0, 0.0);
    options.yield_kPa = kYield_Pa / 1e3;
    options.grip_N_per_m = kGrip_N_per_m;
    const auto pulled = [&](const toolbox::ToolOptions& tool, double half_height_m, int resolution) {
        sculpt::Stroke stroke;
        const auto to = [&](double time_s, double x, double height_m, bool button) {
            stroke.push_back({time_s, {x, 0.025, 0.02 + half_height_m + height_m}, {1, 0, 0, 0}, button});
        };
        to(0.0, 0.02, 0.002, false);
        to(0.1, 0.02, 0.0005, true);
        to(0.5, 0.02, -kDeep_m, true);
        to(1.5, 0.04, -kDeep_m, true);
        to(1.6, 0.04, 0.002, false);
        return felt_on("block:0.06,0.05,0.02", resolution, tool, stroke, options);
    };
    for (const int resolution : {96, 288}) {
        for (const double radius_m : {0.004, 0.01, 0.018}) {
            const Felt felt = pulled(ball_tool(radius_m), radius_m, resolution);
            double depth_m = 0.0, force_N = 0.0, count = 0.0;
            for (const session::TracePoint& p : felt.figures.trace) {
                if ((p.flags & haptics::kTickCutting) == 0 || p.cut_object_m.x < 0.025 || p.cut_object_m.x > 0.032)
                    continue;
                depth_m = std::max(depth_m, 0.02 + radius_m - p.cut_object_m.z);
                force_N += p.force_device_N.z;
                ++count;
            }
            ASSERT_GT(count, 10.0);
            force_N /= count;
            EXPECT_GT(force_N, 0.6 * kGrip_N_per_m * kDeep_m) << radius_m << ' ' << resolution;
            // Where its section bears the press, and as deep again, since half of its bed lies behind it; the bed is
            // known to a hundredth of the radius.
            const double rest_m = force_N / (2.0 * kPi * radius_m * kYield_Pa);
            EXPECT_LT(depth_m, 2.0 * rest_m + 0.01 * radius_m) << radius_m << ' ' << resolution;
        }
        const Felt felt = pulled({.shape = "box:0.016,0.016,0.016"}, 0.008, resolution);
        EXPECT_GT(felt.figures.force_mean_cutting_N, 0.6 * kGrip_N_per_m * kDeep_m) << resolution;
        EXPECT_LT(felt.volume_removed_m3, 5e-9) << resolution;  // a hundredth of a millimetre of its way
    }
}

TEST(Felt, AToolThatCrossesItsOwnGroovesSettlesWithinATicksSteps) {
    // Rounds within rounds: walls of earlier ones stand across the way.
    sculpt::Stroke stroke{row(0.0, 0.0, 0.003, false)};
    for (int i = 0; i <= 240; ++i) {
        const double angle = 2.0 * kPi * i / 40.0;
        sculpt::StrokeRow at = row(0.1 + 0.0125 * i, 0.005 * std::cos(angle) + 0.00001 * i, 0.0, true);
        at.position_object_m.y += 0.003 * std::sin(1.5 * angle);
        stroke.push_back(at);
    }
    const Felt felt = felt_on_a_block(stroke, feel(4.0, 1.2));
    ASSERT_GT(felt.figures.ticks_cutting, 1500u);
    const auto& degraded = felt.figures.degraded;
    const auto used_up = degraded.find("the work of a tick was used up");
    EXPECT_LE(used_up == degraded.end() ? 0u : used_up->second.ticks, 3u);
}

TEST(Felt, TheForceIsSmoothWhileSurfacesArrive) {
    const Felt felt = felt_on_a_block(along(0.04), feel(6.0, 1.0));
    ASSERT_GT(felt.figures.closeup.size(), 500u);
    const std::vector<session::TracePoint>& trace = felt.figures.closeup;
    double largest_N = 0.0, force_N = 0.0;
    for (std::size_t i = 1; i < trace.size(); ++i) {
        if ((trace[i].flags & haptics::kTickCutting) == 0 || (trace[i - 1].flags & haptics::kTickCutting) == 0)
            continue;
        largest_N = std::max(largest_N, glm::length(trace[i].force_device_N - trace[i - 1].force_device_N));
        force_N = std::max(force_N, glm::length(trace[i].force_device_N));
    }
    EXPECT_GT(force_N, 0.4);
    // An encoder's step alone is 600 N/m * 0.055 mm = 0.033 N on each axis, and as much again by the damping of what
    // looks like 55 mm/s. What the proxy moves by when a surface arrives, some tenths of a millimetre, would be 0.2 N.
    EXPECT_LT(largest_N, 0.15);
    EXPECT_EQ(felt.figures.records_lost, 0u);
    EXPECT_TRUE(felt.figures.silent.empty());
}

TEST(Felt, WhatHasNoHardnessGivesWayWithoutForceAndWhatIsInfinitelyHardStaysWhole) {
    toolbox::FeelOptions options = feel(0.0, 1.0);
    const Felt air = felt_on_a_block(along(0.04), options);
    EXPECT_GT(air.volume_removed_m3, 1e-7);
    EXPECT_LT(air.figures.force_mean_cutting_N, 0.05);
    options.hardness = "inf";
    const Felt diamond = felt_on_a_block(along(0.04), options);
    EXPECT_EQ(diamond.volume_removed_m3, 0.0);
    EXPECT_EQ(diamond.figures.ticks_cutting, 0u);
    EXPECT_GT(diamond.figures.force_max_N, 0.4);
}

TEST(Felt, PaintingChangesNoShapeAndFillingAddsToIt) {
    EXPECT_EQ(felt_on_a_block(along(0.04), feel(4.0, 1.0), compute::Operation::paint).volume_removed_m3, 0.0);
    EXPECT_LT(felt_on_a_block(along(0.04), feel(4.0, 0.5), compute::Operation::fill).volume_removed_m3, 0.0);
}

TEST(Felt, EndsWithTheFirstTickThatIsNotBeforeItsEnd) {
    // 0.3 s of rest come before and after the stroke.
    for (const auto& [stroke_s, ticks] : {std::pair{0.4, 1000u}, {0.40001, 1001u}, {0.3999, 1000u}, {0.1004, 701u}}) {
        const Felt felt = felt_on_a_block({row(0.0, 0.0, 0.003, false), row(stroke_s, 0.0, 0.003, false)}, {});
        EXPECT_EQ(felt.figures.ticks, ticks) << stroke_s;
        EXPECT_EQ(felt.figures.tick_ns.size(), ticks);
        EXPECT_EQ(felt.figures.surfaces_published, 1 + ticks / 10) << "the surface at the start, and one each update";
        EXPECT_EQ(felt.figures.last_tool.tick, ticks);
    }
}

TEST(Felt, OptionsThatMakeNoSenseAreRefusedWithTheRemedy) {
    toolbox::FeelOptions options;
    for (const std::string bad : {"granite", "-1", "nan", "", "4kPa"}) {
        options.hardness = bad;
        const auto refused = toolbox::parse_feel(options);
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().line().find("soft, medium, hard"), std::string::npos);
    }
    options = {};
    options.friction = -0.1;
    EXPECT_FALSE(toolbox::parse_feel(options));
    options = {};
    options.grip_N_per_m = 0.0;
    EXPECT_FALSE(toolbox::parse_feel(options));
    options = {};
    options.press_N = NAN;
    EXPECT_FALSE(toolbox::parse_feel(options));
    options = {};
    options.stiffness_N_per_m = 123.0;
    options.friction = 0.4;
    const auto given = toolbox::parse_feel(options);
    ASSERT_TRUE(given);
    EXPECT_EQ(given->material.stiffness_N_per_m, 123.0);
    EXPECT_NEAR(given->material.static_friction, 0.5, 1e-12);
}

TEST(Felt, FigureAndTableHoldTheTraceAndLieBesideTheReport) {
    const Felt felt = felt_on_a_block(along(0.04), feel(6.0, 1.0));
    EXPECT_EQ(session::felt_figure_path("out/report.json"), "out/report-felt.svg");
    EXPECT_EQ(session::felt_table_path("r.json"), "r-felt.csv");
    EXPECT_EQ(session::felt_depth_path("r.json"), "r-depth.svg");
    const std::string table = session::felt_table(felt.figures), figure = session::felt_figure(felt.figures);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(table, '\n')), felt.figures.trace.size() + 1);
    EXPECT_EQ(figure.rfind("<svg", 0), 0u);
    EXPECT_NE(figure.find("</svg>"), std::string::npos);
    EXPECT_EQ(figure.find("nan"), std::string::npos);
    EXPECT_EQ(session::felt_figure(felt_on_a_block(along(0.04), feel(6.0, 1.0)).figures), figure);
    EXPECT_EQ(session::felt_figure({}).rfind("<svg", 0), 0u);  // nothing felt, nothing drawn, no fault
}

}  // namespace burin::activities
