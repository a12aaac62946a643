// SPDX-License-Identifier: MIT
// Figures of a motion do not depend on the rate at which it was read: the same motion at 250 to 2000 Hz, evenly and
// unevenly, exact and through an encoder; and the low-pass against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "study/felt/repeated_stage.hpp"
#include "study/metrics/even_motion.hpp"
#include "study/metrics/trial_metrics.hpp"
#include "study/people/recorded_trial.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// How a motion is read.
struct Reading {
    int rate_Hz = 1000;
    bool unevenly = false;
    double quantum_m = 0.0;  // of the encoder; 0: exact
};

std::string text_of(const Reading& reading) {
    return std::to_string(reading.rate_Hz) + " Hz" + (reading.unevenly ? ", unevenly" : "") +
           (reading.quantum_m > 0.0 ? ", by an encoder" : "");
}

// Times from 0 to the end; unevenly: up to three tenths of a period early or late.
std::vector<Nanoseconds> times_read(const Reading& reading, double duration_s) {
    std::mt19937_64 random(11);
    std::vector<Nanoseconds> times_ns;
    const auto ticks = static_cast<int>(duration_s * reading.rate_Hz);
    const Nanoseconds period_ns = 1'000'000'000 / reading.rate_Hz;
    for (int i = 0; i <= ticks; ++i) {
        const auto off_ns = static_cast<Nanoseconds>(random() % 601) * period_ns / 1000 - 3 * period_ns / 10;
        times_ns.push_back(i * period_ns + (reading.unevenly && i > 0 && i < ticks ? off_ns : 0));
    }
    return times_ns;
}

Vec3 as_read(Vec3 place_m, const Reading& reading) {
    if (reading.quantum_m > 0.0) {
        for (int axis = 0; axis < 3; ++axis)
            place_m[axis] = reading.quantum_m * std::round(place_m[axis] / reading.quantum_m);
    }
    return place_m;
}

// ---- A whole trial through the haptic model

Protocol protocol_of_the_path() { return parse_protocol(*known_protocol("kinesthetic-path")).protocol; }

// Through the tube, whose axis this is as a formula, and out of its wall again and again. As smooth as a hand, which
// wavers: a slow device would cut the corners of a polyline, and of a machine's motion only the encoder is jerky.
Vec3 middle_at(double share) {
    const double turn = kTwoPi * share, calm = std::sin(std::numbers::pi * share);
    const Vec3 axis{-0.165 + 0.33 * share, 0.165 + 0.045 * (1.0 - std::cos(turn)), -0.01 + 0.12 * std::cos(turn)};
    const Vec3 side{0.45 * std::sin(turn) * calm, 0.0, 0.5 * calm};
    const double waver_m = 0.002 * std::sin(6.0 * turn);  // at 2 Hz
    return axis + Vec3(0.0, 0.03 * calm * std::sin(9.0 * share) + waver_m, 0.0) + 0.09 * std::cos(7.0 * share) * side;
}

Json trial_as_read(const Protocol& protocol, const FeltWorld& world, const Reading& reading) {
    constexpr double kDuration_s = 3.0;
    const Stage& stage = *protocol.stage("test");
    const StageTouch touch(protocol, stage, protocol.groups[1], world);
    std::vector<AttemptTick> attempt;
    for (const Nanoseconds time_ns : times_read(reading, kDuration_s)) {
        devices::DeviceSample sample;
        sample.time_ns = kNanosecondsPerSecond + time_ns;
        sample.position_device_m = as_read(touch.place_at_device(middle_at(seconds(time_ns) / kDuration_s)), reading);
        attempt.push_back({sample.time_ns, sample.time_ns, sample.position_device_m, sample.orientation_device,
                           touch.points_m(sample)});
    }
    StageState end;
    end.result = StageResult::valid_exit;
    end.clock_stopped_s = kDuration_s;
    return trial_record(world.world(), end, {}, touch_by_model(protocol, stage, world, attempt));
}

TEST(EvenMotion, ATrialHasTheSameFiguresAtEveryRateOfItsDevice) {
    const Protocol protocol = protocol_of_the_path();
    const auto world = FeltWorld::create(protocol.worlds.at(0));
    ASSERT_TRUE(world);
    const Json usual = trial_as_read(protocol, **world, {});
    ASSERT_GT(usual.at("contact_s").get<double>(), 0.5);
    ASSERT_TRUE(usual.at("ldlj").is_number());
    for (const double quantum_m : {0.0, 5e-5}) {
        for (const int rate_Hz : {250, 500, 1000, 2000}) {
            for (const bool unevenly : {false, true}) {
                const Reading reading{rate_Hz, unevenly, quantum_m};
                const Json record = trial_as_read(protocol, **world, reading);
                for (const auto& [name, value] : usual.items()) {
                    const double wanted = value.get<double>(), found = record.at(name).get<double>();
                    EXPECT_NEAR(found, wanted, 0.01 * std::abs(wanted)) << name << " at " << text_of(reading);
                }
            }
        }
    }
}

TEST(EvenMotion, WhatAStageFeelsIsCountedByTheTimesOfItsTicks) {
    // In contact from 1.0 to 3.34 s with 2 N, and limited for the last 0.5 s of it, whatever the rate.
    for (const int rate_Hz : {250, 500, 1000, 2000}) {
        for (const bool unevenly : {false, true}) {
            FeltForces forces;
            for (const Nanoseconds time_ns : times_read({rate_Hz, unevenly, 0.0}, 4.0)) {
                haptics::TickRecord tick;
                tick.time_ns = kNanosecondsPerSecond + time_ns;
                const double time_s = seconds(time_ns);
                const bool contact = time_s > 1.0 && time_s < 3.34;
                if (contact) tick.flags = haptics::kTickInContact;
                tick.gate.given.force_device_N = {contact ? 2.0 : 0.5, 0.0, 0.0};
                tick.gate.saturated = contact && time_s > 2.84;
                forces.add(tick);
            }
            const Json record = forces_record(forces);
            EXPECT_NEAR(record.at("contact_s").get<double>(), 2.34, 0.0045) << rate_Hz;
            EXPECT_NEAR(record.at("limited_s").get<double>(), 0.5, 0.0045) << rate_Hz;
            EXPECT_NEAR(record.at("force_mean_N").get<double>(), 2.0, 1e-12) << rate_Hz;
            EXPECT_EQ(record.at("contacts").get<int>(), 1) << rate_Hz;
        }
    }
}

// ---- Closed forms

// Along a line with the speed 0.1 (1 + sin(2 pi t) / 2) m/s.
struct ReadMotion {
    std::vector<Vec3> points_m;
    std::vector<Nanoseconds> times_ns;
};

ReadMotion pulsing(const Reading& reading, double duration_s) {
    ReadMotion motion;
    motion.times_ns = times_read(reading, duration_s);
    for (const Nanoseconds time_ns : motion.times_ns) {
        const double t = seconds(time_ns);
        const double along_m = 0.1 * (t + 0.5 * (1.0 - std::cos(kTwoPi * t)) / kTwoPi);
        motion.points_m.push_back(as_read(along_m * glm::normalize(Vec3(1.0, 2.0, -0.5)), reading));
    }
    return motion;
}

TEST(EvenMotion, HasTheJerkOfItsClosedFormAtEveryRate) {
    // Between the leads lie 4 s: T^3 / v^2 times the integral of (0.05 (2 pi)^2 sin)^2, with v = 0.15.
    const double jerk = -64.0 / (0.15 * 0.15) * std::pow(0.05 * kTwoPi * kTwoPi, 2) * 2.0;
    for (const double quantum_m : {0.0, 5e-5}) {
        for (const int rate_Hz : {250, 500, 1000, 2000}) {
            for (const bool unevenly : {false, true}) {
                const Reading reading{rate_Hz, unevenly, quantum_m};
                const ReadMotion motion = pulsing(reading, 4.2);
                const MotionFigures figures = motion_figures(motion.points_m, motion.times_ns);
                EXPECT_NEAR(figures.log_dimensionless_jerk, -std::log(-jerk), 0.05) << text_of(reading);
                EXPECT_NEAR(figures.path_length_m, 0.1 * (4.2 + 0.5 * (1.0 - std::cos(kTwoPi * 4.2)) / kTwoPi), 5e-4)
                    << text_of(reading);
            }
        }
    }
}

TEST(EvenMotion, LowPassHasItsCutoffAndNoDelay) {
    const auto wave = [](double frequency_Hz) {
        std::vector<Vec3> points;
        for (int i = 0; i < 4000; ++i) points.emplace_back(std::sin(kTwoPi * frequency_Hz * i / 1000.0), 0.0, 0.0);
        return points;
    };
    for (const auto& [frequency_Hz, gain] : {std::pair(0.5, 1.0), std::pair(6.0, std::numbers::sqrt2 / 2.0),
                                             std::pair(60.0, 0.0), std::pair(200.0, 0.0)}) {
        const std::vector<Vec3> points = wave(frequency_Hz), filtered = low_passed(points, 1000.0, 6.0);
        ASSERT_EQ(filtered.size(), points.size());
        for (std::size_t i = 1000; i < 3000; ++i) EXPECT_NEAR(filtered[i].x, gain * points[i].x, 0.002) << frequency_Hz;
    }
    // A straight, even motion stays what it is, ends included.
    std::vector<Vec3> straight;
    for (int i = 0; i < 700; ++i) straight.push_back(0.001 * i * Vec3(1.0, -2.0, 0.5));
    const std::vector<Vec3> same = low_passed(straight, 1000.0, 6.0);
    for (std::size_t i = 0; i < straight.size(); ++i) EXPECT_LT(glm::distance(same[i], straight[i]), 1e-8) << i;
}

TEST(EvenMotion, IsSampledStraightBetweenUnevenTimes) {
    const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}, {9, 0, 0}};
    const std::vector<Nanoseconds> times_ns{0, 4'000'000, 4'000'000, 5'000'000, 6'500'000};
    const std::vector<Vec3> even = evenly_sampled(points, times_ns);
    ASSERT_EQ(even.size(), 7u);  // 0 to 6 ms
    const double wanted[] = {0, 1, 2, 3, 5, 6, 8};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(even[i].x, wanted[i], 1e-12) << i;
    const std::vector<double> stand_for = tick_seconds(times_ns);
    EXPECT_NEAR(stand_for[0], 0.002, 1e-15);
    EXPECT_NEAR(stand_for[3], 0.00125, 1e-15);
    EXPECT_NEAR(weighted_mean(std::vector{1.0, 2.0}, std::vector{3.0, 1.0}), 1.25, 1e-15);
    EXPECT_EQ(weighted_mean(std::vector{1.0, 2.0}, std::vector{0.0, 0.0}), 1.5);
    EXPECT_TRUE(std::isnan(weighted_mean({}, {})));
}

TEST(EvenMotion, IsUndefinedWhereItIsTooShortTooLongOrNoMotion) {
    const auto undefined = [](const std::vector<Vec3>& points, const std::vector<Nanoseconds>& times_ns) {
        return std::isnan(motion_figures(points, times_ns).log_dimensionless_jerk);
    };
    EXPECT_TRUE(undefined({}, {}));
    EXPECT_TRUE(undefined({{1, 0, 0}}, {5}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {2, 0, 0}}, {5, 5}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {2, 0, 0}}, {5, 4}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {2, 0, 0}}, {0, 300'000'000}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {2, 0, 0}}, {0, 3'600'000'000'000}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {std::nan(""), 0, 0}}, {0, 2'000'000'000}));
    EXPECT_TRUE(undefined({{1, 0, 0}, {1, 0, 0}}, {0, 2'000'000'000}));
    EXPECT_FALSE(
        std::isnan(motion_figures(std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}}, std::vector<Nanoseconds>{0, 300'000'000})
                       .path_length_m));
}

}  // namespace
}  // namespace burin::study
