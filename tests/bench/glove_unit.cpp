// SPDX-License-Identifier: MIT
// The glove's bench against what has closed forms: a fingertip that is a cylinder, and the delays of a line.
#include <gtest/gtest.h>

#include <numbers>

#include "bench/glove/fingertip_press.hpp"
#include "bench/glove/line_rendering.hpp"

namespace burin::bench {
namespace {

constexpr double kFinger_m = 0.008;

// Points of a cylinder along y around the origin, evenly over an angle to either side of the pad's middle.
std::vector<geometry::PatchPoint> of_cylinder(std::size_t count, double half_rad) {
    std::vector<geometry::PatchPoint> patch;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = count == 1 ? 0.0 : 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
        const double angle = part * half_rad;
        const Vec3 out(std::sin(angle), 0.0, -std::cos(angle));
        patch.push_back({kFinger_m * out, out, 0.0, 1.0 / static_cast<double>(count)});
    }
    return patch;
}

Quat rolled(double angle) { return glm::angleAxis(angle, Vec3(0.0, 1.0, 0.0)); }

}  // namespace

TEST(GloveBench, G4OnePointOfACylinderLeavesThePlateAsItsCosineSays) {
    const auto pad = of_cylinder(3601, std::numbers::pi), one = of_cylinder(1, 0.0);
    const PressTask task;
    for (const double angle : {0.0, 0.2, 0.4, 0.6, -0.5}) {
        const double expected = std::max(0.0, kFinger_m * std::cos(angle) - (kFinger_m - task.depth_m));
        EXPECT_NEAR(force_of(one, pad, rolled(angle), PressedOn::plate, task), expected, 1e-8) << angle;
    }
}

TEST(GloveBench, G4ACylinderFeelsTheSameHoweverItIsRolled) {
    const auto pad = of_cylinder(3601, std::numbers::pi);
    const PressTask task;
    for (const PressedOn on : {PressedOn::plate, PressedOn::ball}) {
        const double flat = force_of(pad, pad, rolled(0.0), on, task);
        EXPECT_GT(flat, 0.0);
        for (const double angle : {0.3, -0.6})
            EXPECT_NEAR(force_of(pad, pad, rolled(angle), on, task), flat, 2e-3 * flat);
    }
}

// The deepest is 2 mm deep in a ball of 30 mm, wherever it is: a point there is pushed by that.
TEST(GloveBench, G4TheDeepestPlaceIsAsDeepAsAskedInAPlateAndInABall) {
    const auto one = of_cylinder(1, 0.0);
    for (const PressedOn on : {PressedOn::plate, PressedOn::ball})
        EXPECT_NEAR(force_of(one, one, rolled(0.3), on, PressTask{}), PressTask{}.depth_m, 1e-9);
}

TEST(GloveBench, G3TwentyPointsFeelAFingertipNearlyAsItsWholePadDoes) {
    auto hand = geometry::read_hand_model("assets/hands/right.glb");
    ASSERT_TRUE(hand) << hand.error().line();
    PressTask task;
    task.points = {1, 20};
    task.extents_m = {0.009};
    task.angles = 21;
    const auto figures = press_fingertip(geometry::with_finer_skin(*hand), geometry::Finger::index, task);
    ASSERT_TRUE(figures) << figures.error().line();
    ASSERT_EQ(figures->patches.size(), 2u);
    const PatchFigures &one = figures->patches[0], &twenty = figures->patches[1];
    for (std::size_t surface = 0; surface < 2; ++surface) {
        EXPECT_LE(twenty.departures[surface][0].rms, 0.10);
        EXPECT_LE(twenty.departures[surface][1].rms, 0.35);
        EXPECT_GT(one.departures[surface][0].rms, 0.3);
        EXPECT_GT(one.departures[surface][1].rms, 0.5);
    }
}

// A set waits for half a set's time on average before it is taken, goes over in one, and half a tick later the command
// goes back; the piston is behind by its time constant.
TEST(GloveBench, G2ForceIsBehindByWhatTheLineAndThePistonTake) {
    constexpr double kPiston_Hz = 30.0, piston_s = 1.0 / (2.0 * std::numbers::pi * kPiston_Hz);
    for (const double bits_per_s : {9'600.0, 38'400.0, 115'200.0}) {
        const double set_s = 320.0 / bits_per_s, command_s = 80.0 / bits_per_s;
        const double expected_s = 1.5 * set_s + 0.0005 + command_s + piston_s;
        EXPECT_NEAR(measure_line(MadeAt::host, bits_per_s, kPiston_Hz).lag_s, expected_s, 0.05 * expected_s + 1e-4);
    }
    EXPECT_NEAR(measure_line(MadeAt::controller, 38'400, kPiston_Hz).lag_s, 0.001 + piston_s, 3e-4);
}

TEST(GloveBench, G2TheControllersBallIsStifferThanAnyThatComesOverTheLine) {
    const double local = measure_line(MadeAt::controller, 38'400).stiffest_N_per_m;
    double before = 0.0;
    for (const double bits_per_s : {9'600.0, 38'400.0, 115'200.0}) {
        const double stiffest = measure_line(MadeAt::host, bits_per_s).stiffest_N_per_m;
        EXPECT_GT(stiffest, before);
        EXPECT_LT(stiffest, local);
        before = stiffest;
    }
}

}  // namespace burin::bench
