// SPDX-License-Identifier: MIT
#include "haptics/signals/filters.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace burin::haptics {
namespace {

double measured_by_encoder(double x) { return kEncoderStep * std::floor(x / kEncoderStep + 0.5); }

// Root mean square error of the estimate (m/s) for a motion along x, sampled in encoder steps.
double rms_error(const std::function<double(double)>& x, const std::function<double(double)>& v) {
    VelocityWindow window;
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < 2000; ++i) {
        const double t = kDt * i;
        window = with_position(window, {measured_by_encoder(x(t)), 0.0, 0.0});
        if (i < 50) continue;
        const double error = velocity_m_per_s(window, kEncoderStep, kDt).x - v(t);
        sum += error * error;
        ++n;
    }
    return std::sqrt(sum / n);
}

}  // namespace

TEST(Velocity, IsZeroUntilTwoPositionsAreKnown) {
    VelocityWindow window;
    EXPECT_EQ(velocity_m_per_s(window, kEncoderStep, kDt), Vec3(0.0));
    window = with_position(window, {1, 2, 3});
    EXPECT_EQ(velocity_m_per_s(window, kEncoderStep, kDt), Vec3(0.0));
}

TEST(Velocity, OfASteadyMotionWithoutNoiseIsExact) {
    VelocityWindow window;
    for (int i = 0; i < 40; ++i) window = with_position(window, Vec3(0.001, -0.002, 0.0005) * double(i));
    const Vec3 v = velocity_m_per_s(window, 1e-12, kDt);
    EXPECT_NEAR(v.x, 1.0, 1e-9);
    EXPECT_NEAR(v.y, -2.0, 1e-9);
    EXPECT_NEAR(v.z, 0.5, 1e-9);
}

TEST(Velocity, ABoundaryFlickerOfOneEncoderStepIsTakenAsAlmostRest) {
    VelocityWindow window;
    for (int i = 0; i < 40; ++i) {
        window = with_position(window, {i % 2 == 0 ? 0.0 : kEncoderStep, 0.0, 0.0});
        if (i < 20) continue;
        // One step over the whole window at most, where a plain difference says 55 mm/s.
        EXPECT_LE(std::abs(velocity_m_per_s(window, kEncoderStep, kDt).x), kEncoderStep / (16 * kDt) * 1.0001);
    }
}

TEST(Velocity, ASuddenStartIsSeenAtOnce) {
    VelocityWindow window;
    for (int i = 0; i < 40; ++i) window = with_position(window, Vec3(0.0));
    window = with_position(window, {0.5e-3, 0.0, 0.0});
    EXPECT_NEAR(velocity_m_per_s(window, kEncoderStep, kDt).x, 0.5, 0.06);
    window = with_position(window, {1.0e-3, 0.0, 0.0});
    EXPECT_NEAR(velocity_m_per_s(window, kEncoderStep, kDt).x, 0.5, 0.06);
}

TEST(Velocity, ReproducesThePublishedComparisonWithAPlainDifference) {
    // Measured elsewhere for this encoder, window and rate, mm/s: 1.71 at a constant 50, 5.7 on a 2 Hz sine of 100,
    // 14.1 on a 10 Hz one; a plain difference 15.8, 23.8, 23.5. Half as much again is allowed for phases and edges.
    const auto sine = [](double hertz) {
        const double w = 2.0 * std::numbers::pi * hertz;
        return std::pair{std::function<double(double)>([w](double t) { return 0.1 / w * std::sin(w * t); }),
                         std::function<double(double)>([w](double t) { return 0.1 * std::cos(w * t); })};
    };
    EXPECT_LT(rms_error([](double t) { return 0.05 * t; }, [](double) { return 0.05; }), 1.5 * 1.71e-3);
    const auto slow = sine(2.0), fast = sine(10.0);
    EXPECT_LT(rms_error(slow.first, slow.second), 1.5 * 5.7e-3);
    EXPECT_LT(rms_error(fast.first, fast.second), 1.5 * 14.1e-3);
}

TEST(Velocity, AxesDoNotInfluenceOneAnother) {
    VelocityWindow one, both;
    for (int i = 0; i < 60; ++i) {
        const double x = measured_by_encoder(0.03 * kDt * i), y = measured_by_encoder(0.002 * std::sin(0.2 * i));
        one = with_position(one, {x, 0.0, 0.0});
        both = with_position(both, {x, y, -y});
        EXPECT_EQ(velocity_m_per_s(one, kEncoderStep, kDt).x, velocity_m_per_s(both, kEncoderStep, kDt).x);
    }
}

TEST(Velocity, AFlickerOfOneStepIsAlmostRestWhereverOnTheEncoderItHappens) {
    // Multiples of the step are rounded: two that lie one step apart differ by a little more than it, or a little less.
    int apart_by_more = 0;
    for (int at = 0; at < 1500; at += 7) {
        const double here = kEncoderStep * at, beside = kEncoderStep * (at + 1);
        apart_by_more += beside - here > kEncoderStep ? 1 : 0;
        VelocityWindow window;
        for (int i = 0; i < 40; ++i) {
            window = with_position(window, {i % 2 == 0 ? here : beside, 0.0, 0.0});
            if (i < 20) continue;
            // One step over the whole window at most.
            ASSERT_LE(std::abs(velocity_m_per_s(window, kEncoderStep, kDt).x), kEncoderStep / (16 * kDt) * 1.0001)
                << at << ' ' << i;
        }
    }
    EXPECT_GT(apart_by_more, 20) << "else rounding was not tried";
}

}  // namespace burin::haptics
