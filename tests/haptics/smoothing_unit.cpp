// SPDX-License-Identifier: MIT
#include "haptics/signals/filters.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace burin::haptics {
namespace {

double quantised(double x) { return kEncoderStep * std::floor(x / kEncoderStep + 0.5); }

SignalSettings by(VelocityMethod method, double alpha = 0.9) {
    SignalSettings settings;
    settings.velocity = method;
    settings.velocity_alpha = alpha;
    return settings;
}

struct Motion {
    std::function<double(double)> x, v;
};

Motion steady(double speed) {
    return {[speed](double t) { return speed * t; }, [speed](double) { return speed; }};
}

Motion sine(double hertz, double speed) {
    const double w = 2.0 * std::numbers::pi * hertz;
    return {[=](double t) { return speed / w * std::sin(w * t); }, [=](double t) { return speed * std::cos(w * t); }};
}

// Root mean square error in mm/s, encoder steps and all.
double rms_error_mm_per_s(const SignalSettings& settings, const Motion& motion) {
    VelocityWindow window;
    MovingAverage average;
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < 4000; ++i) {
        window = with_position(window, {quantised(motion.x(kDt * i)), 0.0, 0.0});
        const VelocityEstimate estimate = estimate_velocity(settings, window, average, kEncoderStep, kDt);
        average = estimate.average;
        if (i < 200) continue;
        const double error = 1e3 * (estimate.velocity_m_per_s.x - motion.v(kDt * i));
        sum += error * error;
        ++n;
    }
    return std::sqrt(sum / n);
}

}  // namespace

TEST(Smoothing, TakesTheFirstInputAsItIsAndHoldsAConstant) {
    MovingAverage average = with_input({}, {1.0, -2.0, 3.0}, 0.9);
    EXPECT_EQ(average.value, Vec3(1.0, -2.0, 3.0));
    for (int i = 0; i < 100; ++i) average = with_input(average, {1.0, -2.0, 3.0}, 0.9);
    EXPECT_NEAR(glm::length(average.value - Vec3(1.0, -2.0, 3.0)), 0.0, 1e-12);
}

TEST(Smoothing, AStepIsApproachedByPowersOfAlpha) {
    for (const double alpha : {0.0, 0.3, 0.9}) {
        MovingAverage average = with_input({}, Vec3(0.0), alpha);
        for (int i = 1; i <= 40; ++i) {
            average = with_input(average, {2.0, 0.0, 0.0}, alpha);
            EXPECT_NEAR(average.value.x, 2.0 * (1.0 - std::pow(alpha, i)), 1e-12);
        }
    }
}

TEST(Smoothing, LagsBehindARampByItsMeanLag) {
    for (const double alpha : {0.3, 0.5, 0.9, 0.95}) {
        MovingAverage average;
        const double slope = 7.0;  // a second
        double input = 0.0;
        for (int i = 0; i < 2000; ++i) average = with_input(average, {input = slope * kDt * i, 0.0, 0.0}, alpha);
        EXPECT_NEAR((input - average.value.x) / slope, mean_lag_s(alpha, kDt), 1e-9) << alpha;
    }
    EXPECT_NEAR(mean_lag_s(0.9, kDt), 0.009, 1e-12);
}

TEST(Smoothing, HalvesThePowerOfASineAtSeventeenHertz) {
    // |1 - a| / |1 - a e^(-i w T)| = 1 / sqrt 2
    const double a = 0.9, hertz = std::acos((4.0 * a - 1.0 - a * a) / (2.0 * a)) / (2.0 * std::numbers::pi * kDt);
    EXPECT_NEAR(hertz, 16.8, 0.05);
    MovingAverage average;
    double power = 0.0;
    int n = 0;
    for (int i = 0; i < 20000; ++i) {
        average = with_input(average, {std::sin(2.0 * std::numbers::pi * hertz * kDt * i), 0.0, 0.0}, a);
        if (i < 1000) continue;
        power += average.value.x * average.value.x;
        ++n;
    }
    EXPECT_NEAR(power / n, 0.25, 0.002);  // a sine's is a half
}

TEST(VelocityChoice, IsZeroUntilTwoPositionsAreKnownAndForgetsWithTheWindow) {
    for (const auto method :
         {VelocityMethod::adaptive_window, VelocityMethod::moving_average, VelocityMethod::difference}) {
        VelocityWindow window;
        const MovingAverage stale{Vec3(5.0), true};
        EXPECT_EQ(estimate_velocity(by(method), window, stale, kEncoderStep, kDt).velocity_m_per_s, Vec3(0.0));
        window = with_position(window, {0.1, 0.2, 0.3});
        const VelocityEstimate one = estimate_velocity(by(method), window, stale, kEncoderStep, kDt);
        EXPECT_EQ(one.velocity_m_per_s, Vec3(0.0));
        EXPECT_FALSE(one.average.begun);
    }
}

TEST(VelocityChoice, TheDifferenceIsTheLastStepOfEachAxisAlsoWhenTheRingHasTurned) {
    VelocityWindow window;
    for (int i = 0; i < 100; ++i) {
        window = with_position(window, Vec3(1.0, -2.0, 0.5) * (1e-4 * i * i));
        if (i == 0) continue;
        const Vec3 v =
            estimate_velocity(by(VelocityMethod::difference), window, {}, kEncoderStep, kDt).velocity_m_per_s;
        EXPECT_NEAR(glm::length(v - Vec3(1.0, -2.0, 0.5) * (0.1 * (2 * i - 1))), 0.0, 1e-9);
    }
}

TEST(VelocityChoice, AChangeOfMethodFindsTheAverageInStep) {
    VelocityWindow window;
    MovingAverage always, sometimes;
    for (int i = 0; i < 300; ++i) {
        window = with_position(window, {quantised(0.002 * std::sin(0.05 * i)), 0.0, 0.0});
        const auto a = estimate_velocity(by(VelocityMethod::moving_average), window, always, kEncoderStep, kDt);
        const auto method = i < 250 ? VelocityMethod::adaptive_window : VelocityMethod::moving_average;
        const auto b = estimate_velocity(by(method), window, sometimes, kEncoderStep, kDt);
        always = a.average;
        sometimes = b.average;
        if (i < 250) continue;
        EXPECT_EQ(a.velocity_m_per_s, b.velocity_m_per_s);
    }
}

TEST(VelocityChoice, ErrsAsMuchAsASeparateSimulationFound) {
    // Root mean square errors in mm/s at 1 kHz with steps of 0.055 mm, from a simulation that shares no code with this
    // one: at a constant 50 mm/s, on a sine of 100 mm/s at 2 Hz, and at 10 Hz. A quarter either way is for phases.
    const Motion motions[] = {steady(0.05), sine(2.0, 0.1), sine(10.0, 0.1)};
    const struct {
        SignalSettings settings;
        double error[3];
    } rows[] = {{by(VelocityMethod::difference), {15.8, 23.8, 23.5}},
                {by(VelocityMethod::moving_average, 0.5), {8.2, 9.9, 10.3}},
                {by(VelocityMethod::moving_average, 0.9), {1.65, 8.2, 34.4}},
                {by(VelocityMethod::adaptive_window), {1.71, 5.7, 14.1}}};
    for (const auto& row : rows)
        for (int i = 0; i < 3; ++i) {
            const double ours = rms_error_mm_per_s(row.settings, motions[i]);
            EXPECT_NEAR(ours / row.error[i], 1.0, 0.25) << ours << " for " << row.error[i];
        }
}

}  // namespace burin::haptics
