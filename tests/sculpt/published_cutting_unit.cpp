// SPDX-License-Identifier: MIT
// Materials of published figures, cut by a tool that a hand presses, against the forces that were published for them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/plot/figures.hpp"
#include "haptics/forces/cutting.hpp"
#include "tests/haptics/surfaces.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::sculpt {
namespace {

constexpr double kDt_s = 1e-3, kStiffness_N_per_m = 600.0;
// The cutter that the presets are for (feel_options.cpp): the chip of a tool that sinks at v is v s / v_c thick, and a
// thrust pressure p is the cutting force p s / r per width of an edge.
constexpr double kCutter_m_per_s = 3.14, kSpacing_m = 9.42e-3, kThrustRatio = 0.3;

// The published force per width of an edge, F_e + K_c h: slopes in N/mm2, intercepts in N/mm, chips in mm. Lime along
// the grain from K_c = 0.026 rho and F_e = 0.0055 rho with 585.7 kg/m3 (Curti et al. 2021), the others as printed by
// Goli et al. 2018.
struct Published {
    const char* preset;
    double slope, intercept, thinnest_mm, thickest_mm;
};
constexpr std::array kPublished{
    Published{"mdf", 31.44, 3.36, 0.041, 0.091}, Published{"lime", 0.026 * 585.7, 0.0055 * 585.7, 0.04, 0.10},
    Published{"beech-lvl", 11.73, 3.70, 0.041, 0.091}, Published{"ptfe", 20.33, 2.71, 0.041, 0.091}};

haptics::TouchMaterial material_of(const std::string& name) {
    return toolbox::touch_material(*toolbox::parse_feel_settings({.hardness = name}));
}

// A tool on the plane y = 0 and a hand above it that presses along -y.
class PressedTool {
public:
    PressedTool(const compute::ToolShape& shape, double height_m, const haptics::TouchMaterial& material)
        : tool_(toolbox::felt_tool(shape).surface), height_m_(height_m), material_(material) {}

    void press(double hand_depth_m) {
        haptics::CuttingInput in;
        in.proxy_object_m = {0.0, height_m_, 0.0};
        in.hip_object_m = {0.0, height_m_ - hand_depth_m, 0.0};
        in.cutting = true;
        in.stiffness_N_per_m = kStiffness_N_per_m;
        in.dt_s = kDt_s;
        static const haptics::test::Surface plane = haptics::test::plane(0.05, 200);
        state_.known = haptics::look_at(state_, in, tool_, *plane, {1'000'000, 1'000'000}).known;
        const haptics::CuttingStep step = haptics::cut(state_, in, tool_, material_);
        state_ = step.next;
        depth_m = height_m_ - step.bearing_object_m.y;
        force_N = kStiffness_N_per_m * (hand_depth_m - depth_m);
    }
    // What the tool has cut away is gone from the surface: the same as that it is where it was and the hand less deep.
    // Returns how much.
    double publish() {
        const double cut_away_m = depth_m;
        state_.point_object_m.y += cut_away_m;
        depth_m = 0.0;
        return cut_away_m;
    }
    double depth_m = 0.0, force_N = 0.0;

private:
    haptics::ToolSurface tool_;
    double height_m_;
    haptics::TouchMaterial material_;
    haptics::CuttingState state_;
};

// The force on a face of 4 mm by 4 mm that sinks so fast that its chips are this thick, as force per width of an edge.
double force_per_width_N_per_mm(const std::string& preset, double chip_mm) {
    constexpr double kSide_m = 0.004;
    const double speed_m_per_s = 1e-3 * chip_mm * kCutter_m_per_s / kSpacing_m;
    PressedTool tool(compute::BoxTool{Vec3(0.5 * kSide_m)}, 0.5 * kSide_m, material_of(preset));
    double cut_away_m = 0.0;
    for (int i = 1; i <= 500; ++i) {
        tool.press(i * speed_m_per_s * kDt_s - cut_away_m);
        cut_away_m += tool.publish();
    }
    return 1e-3 * tool.force_N / (kSide_m * kSide_m) * kSpacing_m / kThrustRatio;
}

// A ball of 3 mm whose hand presses up to 1.5 N deep into a spring of 600 N/m, holds, and lets half of it go.
struct Press {
    std::vector<plot::PlotPoint> depth_mm, force_N;
};
Press pressed_ball(const std::string& preset) {
    PressedTool tool(compute::BallTool{0.003}, 0.003, material_of(preset));
    Press press;
    double hand_m = 0.0;
    for (int i = 0; i <= 3000; ++i) {
        if (i <= 1000) hand_m = 2.5e-6 * i;
        if (i == 2000) hand_m = tool.depth_m + 0.5 * (hand_m - tool.depth_m);
        tool.press(hand_m);
        if (i % 20 != 0) continue;
        press.depth_mm.push_back({1e-3 * i, 1e3 * tool.depth_m, {}});
        press.force_N.push_back({1e-3 * i, tool.force_N, {}});
    }
    return press;
}

// The force of a ball of 3 mm as it passes half a millimetre of depth at this speed.
double force_at_half_a_millimetre_N(const std::string& preset, double mm_per_s) {
    PressedTool tool(compute::BallTool{0.003}, 0.003, material_of(preset));
    for (double hand_m = 0.0; tool.depth_m < 0.0005 && hand_m < 0.05; hand_m += 1e-3 * mm_per_s * kDt_s)
        tool.press(hand_m);
    return tool.force_N;
}

}  // namespace

TEST(PublishedCutting, AFaceIsHeldBackByTheForcesPrintedForItsMaterial) {
    for (const Published& p : kPublished)
        for (const double chip_mm : {p.thinnest_mm, 0.066, p.thickest_mm}) {
            const double printed = p.intercept + p.slope * chip_mm;
            EXPECT_NEAR(force_per_width_N_per_mm(p.preset, chip_mm), printed, 0.03 * printed)
                << p.preset << ' ' << chip_mm;
        }
}

TEST(PublishedCutting, InHardWoodTwiceTheSpeedIsFarFromTwiceTheForce) {
    const double slow_N = force_at_half_a_millimetre_N("oak", 10.0), fast_N = force_at_half_a_millimetre_N("oak", 20.0);
    EXPECT_GT(fast_N, slow_N);
    EXPECT_LT(fast_N, 1.3 * slow_N);
}

TEST(PublishedCutting, HalfThePressHoldsStillInEveryPreset) {
    for (const char* preset : {"soft", "medium", "hard", "lime", "maple", "oak", "mdf", "beech-lvl", "ptfe"}) {
        const Press press = pressed_ball(preset);
        const auto depth_at = [&](std::size_t i) { return press.depth_mm[i].y; };
        EXPECT_GT(depth_at(99), 0.05) << preset;
        EXPECT_NEAR(depth_at(150), depth_at(101), 1e-3) << preset;
    }
}

// docs/pictures/cutting.svg is this file.
TEST(PublishedCutting, IsSeenInAPicture) {
    plot::Plot printed{
        "a face of 16 mm2: as printed, and as felt", "thickness of the chip, mm", "cutting force per width, N/mm", {}};
    printed.x_linear = printed.y_linear = true;
    for (const Published& p : kPublished) {
        plot::PlotSeries line{"as printed", {}, 1.0}, felt{"as felt", {}};
        for (int i = 0; i <= 4; ++i) {
            const double chip_mm = p.thinnest_mm + 0.25 * i * (p.thickest_mm - p.thinnest_mm);
            line.points.push_back({chip_mm, p.intercept + p.slope * chip_mm, {}});
            felt.points.push_back({chip_mm, force_per_width_N_per_mm(p.preset, chip_mm), {}});
        }
        line.points.back().label = p.preset;
        printed.series.push_back(std::move(line));
        printed.series.push_back(std::move(felt));
    }
    // Another laboratory's oak: 243.6 N h^0.4761 on 30 mm (Durkovic and Danon 2017, Wood Research 62:293-306).
    plot::PlotSeries oak{"as felt", {}}, other{"another laboratory's oak", {}, 1.0};
    for (int i = 0; i <= 4; ++i) {
        const double chip_mm = 0.04 + 0.015 * i;
        oak.points.push_back({chip_mm, force_per_width_N_per_mm("oak", chip_mm), {}});
        other.points.push_back({chip_mm, 243.6 * std::pow(chip_mm, 0.4761) / 30.0, {}});
    }
    oak.points.back().label = "oak";
    printed.series.push_back(std::move(oak));
    printed.series.push_back(std::move(other));
    plot::Plot depths{"a ball of 3 mm: depth", "time, s", "mm", {}},
        forces{"a ball of 3 mm: force", "time, s", "N", {}};
    for (const char* preset : {"soft", "medium", "hard", "oak"}) {
        Press press = pressed_ball(preset);
        depths.series.push_back({preset, std::move(press.depth_mm)});
        forces.series.push_back({preset, std::move(press.force_N)});
    }
    plot::Plot speeds{"a ball of 3 mm, 0.5 mm deep", "speed, mm/s", "force, N", {}};
    for (const char* preset : {"soft", "medium", "hard", "oak"}) {
        plot::PlotSeries line{preset, {}};
        for (const double speed : {2.0, 5.0, 10.0, 20.0, 30.0, 40.0})
            line.points.push_back({speed, force_at_half_a_millimetre_N(preset, speed), {}});
        speeds.series.push_back(std::move(line));
    }
    for (plot::Plot* one : {&depths, &forces, &speeds}) one->x_linear = one->y_linear = true;
    depths.markers = forces.markers = false;
    const std::string text =
        plot::svg_figure("What materials give back to a tool that cuts", {printed, speeds, depths, forces}, 2);
    EXPECT_NE(text.find("another laboratory"), std::string::npos);
    std::ofstream file(testing::TempDir() + "cutting.svg");
    file << text;
    EXPECT_TRUE(file.good());
}

}  // namespace burin::sculpt
