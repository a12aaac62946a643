// SPDX-License-Identifier: MIT
// Predicted heads against motions with closed forms, and trackers that misbehave.
#include "wall/head_prediction.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/wall/wall_samples.hpp"

namespace burin::wall {
namespace {

constexpr Nanoseconds kMs = 1'000'000;
using Motion = std::function<Pose(double time_s)>;

HeadTrack followed(const HeadSettings& settings, const Motion& motion, Nanoseconds from_ns, Nanoseconds to_ns,
                   Nanoseconds every_ns) {
    HeadTrack track;
    for (Nanoseconds t = from_ns; t <= to_ns; t += every_ns) track = take(settings, track, {t, motion(seconds(t))});
    return track;
}

double apart_m(const Pose& a, const Pose& b) { return glm::length(a.position_m - b.position_m); }

double apart_rad(const Pose& a, const Pose& b) {
    const Quat d = a.orientation * glm::conjugate(b.orientation);
    return 2.0 * std::atan2(glm::length(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}

Pose uniform(double t) {
    return {Vec3{0.1, 1.6, 2.0} + t * Vec3{0.2, -0.1, 0.2},
            glm::angleAxis(0.9 * t, glm::normalize(Vec3{1, 2, -1})) * turned(0.4, 0.2, 0.1)};
}

}  // namespace

TEST(HeadPrediction, IsExactForUniformMotionAndTurning) {
    const HeadSettings settings;
    for (const Nanoseconds every : {4 * kMs, 8'333'333L, 16'666'667L, 40 * kMs}) {
        const HeadTrack track = followed(settings, uniform, 0, 1000 * kMs, every);
        const Nanoseconds newest = track.samples[static_cast<std::size_t>(track.count - 1)].time_ns;
        for (const Nanoseconds ahead : {0 * kMs, 10 * kMs, 33 * kMs, 50 * kMs}) {
            const Pose p = predicted(settings, track, newest + ahead);
            const Pose truth = uniform(seconds(newest + ahead));
            EXPECT_LT(apart_m(p, truth), 1e-12) << every << ' ' << ahead;
            EXPECT_LT(apart_rad(p, truth), 1e-9) << every << ' ' << ahead;
        }
    }
}

// |x'' | <= A w^2, so the error is at most A w^2 T (T + W) / 2 (wall/head_prediction.hpp); the bound is also nearly
// reached.
TEST(HeadPrediction, KeepsItsErrorBoundForASwayingHead) {
    const HeadSettings settings;
    constexpr double A = 0.1;
    for (const double f : {0.5, 1.0, 2.0}) {
        const double w = 2.0 * std::numbers::pi * f;
        const Motion sway = [&](double t) {
            return Pose{{A * std::sin(w * t), 1.6, 2.0}, glm::angleAxis(0.5 * A * std::sin(w * t), Vec3{0, 1, 0})};
        };
        for (const double ahead_s : {0.01, 0.03, 0.05}) {
            // 4 ms samples: the window of 25 ms holds the last 24 ms.
            const double bound_m = A * w * w * ahead_s * (ahead_s + 0.024) / 2.0;
            double worst_m = 0.0, worst_rad = 0.0;
            HeadTrack track;
            for (Nanoseconds t = 0; t < 2000 * kMs; t += 4 * kMs) {
                track = take(settings, track, {t, sway(seconds(t))});
                if (t < 30 * kMs) continue;
                const Nanoseconds at = t + nanoseconds(ahead_s);
                worst_m = std::max(worst_m, apart_m(predicted(settings, track, at), sway(seconds(at))));
                worst_rad = std::max(worst_rad, apart_rad(predicted(settings, track, at), sway(seconds(at))));
            }
            EXPECT_LT(worst_m, bound_m) << f << " Hz, " << ahead_s;
            EXPECT_GT(worst_m, 0.7 * bound_m);
            EXPECT_LT(worst_rad, 0.5 * bound_m);
        }
    }
}

TEST(HeadPrediction, NeverRunsFartherThan75Milliseconds) {
    const HeadSettings settings;
    const Motion run = [](double t) { return Pose{{0.0, 1.6, 2.0 - t}, Quat{1, 0, 0, 0}}; };
    const HeadTrack track = followed(settings, run, 0, 400 * kMs, 8 * kMs);
    const Pose newest = predicted(settings, track, 400 * kMs);
    double before_m = 0.0;
    for (Nanoseconds ahead = 0; ahead < 3000 * kMs; ahead += kMs) {
        const double m = apart_m(predicted(settings, track, 400 * kMs + ahead), newest);
        EXPECT_GE(m, before_m - 1e-12) << "it turned back";
        EXPECT_LE(m - before_m, 0.001 + 1e-12) << "it ran faster than the head";
        before_m = m;
    }
    EXPECT_NEAR(before_m, 0.075, 1e-9);
}

// The display shows the right eye a field later; a picture made for the left eye's time is wrong by speed times field.
TEST(HeadPrediction, GivesEachEyeItsOwnTime) {
    const DisplayTiming timing{120.0, EyeOrder::left_first};
    const EyeTimes times = eye_times(timing, 1000 * kMs);
    EXPECT_EQ(times.left_ns, 1000 * kMs);
    EXPECT_EQ(times.right_ns, 1000 * kMs + 8'333'333);
    EXPECT_EQ(eye_times({120.0, EyeOrder::right_first}, 0).left_ns, 8'333'333);
    EXPECT_EQ(eye_times({120.0, EyeOrder::simultaneous}, 7).right_ns, 7);

    const HeadSettings settings;
    const Motion walk = [](double t) { return Pose{{-0.3 + 0.3 * t, 1.6, 2.0}, Quat{1, 0, 0, 0}}; };
    const HeadTrack track = followed(settings, walk, 0, 980 * kMs, 10 * kMs);
    const HeadPoses poses = draw(settings, track, times).poses;
    const Pose left = walk(seconds(times.left_ns)), right = walk(seconds(times.right_ns));
    EXPECT_NEAR(apart_m(left, right), 0.0025, 1e-6) << "what one pose for both eyes would be wrong by";
    EXPECT_LT(apart_m(poses.left_tracker, left), 5e-5);
    EXPECT_LT(apart_m(poses.right_tracker, right), 5e-5);
}

TEST(TrackerWatch, DoesNotBelieveASingleJumpAndSaysSo) {
    const HeadSettings settings;
    HeadTrack track = followed(settings, uniform, 0, 500 * kMs, 10 * kMs);
    Pose far = uniform(0.51);
    far.position_m.x += 0.5;
    track = take(settings, track, {510 * kMs, far});
    const TrackerReport said = report(settings, track, 515 * kMs);
    EXPECT_EQ(said.state, TrackerState::jumped);
    EXPECT_NE(said.cause.find("50.2 m/s"), std::string::npos) << said.cause;
    EXPECT_LT(apart_m(predicted(settings, track, 520 * kMs), uniform(0.52)), 1e-12);
    track = take(settings, track, {520 * kMs, uniform(0.52)});
    EXPECT_EQ(report(settings, track, 520 * kMs).state, TrackerState::ok);
    EXPECT_EQ(track.refused, 1u);
    Pose spun = uniform(0.53);
    spun.orientation = turned(2, 0, 0) * spun.orientation;
    EXPECT_NE(report(settings, take(settings, track, {530 * kMs, spun}), 530 * kMs).cause.find("turned"),
              std::string::npos);
}

// It once put the head two kilometres away, from where the picture glided back at half a metre a second.
TEST(TrackerWatch, KnowsATrackerThatBeginsInMillimetresAndTakesItUpWhenItIsMended) {
    const HeadSettings settings;
    HeadTrack track;
    const auto draw_at = [&](Nanoseconds t) {
        DrawnHead drawn = draw(settings, track, {t, t});
        track = drawn.track;
        return drawn.poses.left_tracker;
    };
    for (int i = 0; i < 50; ++i) {
        Pose millimetres = uniform(0.01 * i);
        millimetres.position_m *= 1000.0;
        track = take(settings, track, {10 * i * kMs, millimetres});
        EXPECT_LT(apart_m(draw_at((10 * i + 5) * kMs), settings.fallback_tracker), 1e-12) << "the usual place is drawn";
    }
    const TrackerReport said = report(settings, track, 500 * kMs);
    EXPECT_EQ(said.state, TrackerState::jumped);
    EXPECT_NE(said.cause.find("millimetres"), std::string::npos) << said.cause;
    EXPECT_NE(said.cause.find("reported_units"), std::string::npos) << said.cause;
    for (int i = 50; i < 700; ++i) {
        track = take(settings, track, {10 * i * kMs, uniform(0.01 * i)});
        static_cast<void>(draw_at((10 * i + 5) * kMs));
    }
    EXPECT_EQ(report(settings, track, 7000 * kMs).state, TrackerState::ok);
    EXPECT_LT(apart_m(draw_at(7000 * kMs), uniform(7.0)), 0.02) << "and the picture has come back";
}

TEST(TrackerWatch, RefusesWhatIsNotANumberAndTimeThatGoesBack) {
    const HeadSettings settings;
    const HeadTrack good = followed(settings, uniform, 0, 500 * kMs, 10 * kMs);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Pose& bad : {Pose{{nan, 1, 2}, Quat{1, 0, 0, 0}}, Pose{{0, 1, 2}, Quat{0, 0, 0, 0}},
                            Pose{{0, 1, 2}, Quat{nan, 0, 0, 0}}, Pose{{0, HUGE_VAL, 2}, Quat{1, 0, 0, 0}}}) {
        const HeadTrack track = take(settings, good, {510 * kMs, bad});
        EXPECT_NE(report(settings, track, 511 * kMs).cause.find("not a number"), std::string::npos);
        EXPECT_EQ(apart_m(predicted(settings, track, 520 * kMs), predicted(settings, good, 520 * kMs)), 0.0);
    }
    const HeadTrack back = take(settings, good, {400 * kMs, uniform(0.4)});
    EXPECT_NE(report(settings, back, 511 * kMs).cause.find("0.100 s"), std::string::npos);
    EXPECT_EQ(report(settings, take(settings, good, {500 * kMs, uniform(0.5)}), 501 * kMs).state, TrackerState::ok)
        << "the same sample again is no fault";
}

TEST(TrackerWatch, BelievesARestartedTrackerAfterFiveSamplesThatAgree) {
    const HeadSettings settings;
    HeadTrack track = followed(settings, uniform, 0, 500 * kMs, 10 * kMs);
    const Motion elsewhere = [](double t) {
        Pose p = uniform(t);
        p.position_m.x -= 1.0;
        return p;
    };
    for (int i = 1; i <= kSamplesToTrust; ++i) {
        EXPECT_LT(apart_m(predicted(settings, track, 560 * kMs), uniform(0.56)), 0.01) << i;
        track = take(settings, track, {(500 + 10 * i) * kMs, elsewhere(0.5 + 0.01 * i)});
    }
    EXPECT_EQ(report(settings, track, 550 * kMs).state, TrackerState::ok);
    EXPECT_LT(apart_m(predicted(settings, track, 550 * kMs), elsewhere(0.55)), 1e-9);
    EXPECT_LT(apart_m(predicted(settings, track, 570 * kMs), elsewhere(0.55)), 1e-9)
        << "the way from the old place to the new one is no velocity";
    // A clock that was set back: the same.
    for (int i = 0; i < kSamplesToTrust; ++i) track = take(settings, track, {i * 10 * kMs, uniform(0.0)});
    EXPECT_EQ(report(settings, track, 40 * kMs).state, TrackerState::ok);
    EXPECT_LT(apart_m(predicted(settings, track, 60 * kMs), uniform(0.0)), 1e-9);
}

TEST(TrackerWatch, ASilentTrackerIsLostAndTheHeadGlidesToTheFallbackAndBack) {
    HeadSettings settings;
    settings.fallback_tracker = {{0.0, 1.6, 2.5}, Quat{1, 0, 0, 0}};
    const DisplayTiming timing{120.0, EyeOrder::left_first};
    HeadTrack track;
    EXPECT_EQ(report(settings, track, 0).state, TrackerState::waiting);
    Pose last;
    for (Nanoseconds t = 0; t < 8000 * kMs; t += 16'666'667) {
        const bool silent = t > 1000 * kMs && t < 5000 * kMs;
        if (!silent) track = take(settings, track, {t, uniform(seconds(t))});
        const DrawnHead drawn = draw(settings, track, eye_times(timing, t + 20 * kMs));
        track = drawn.track;
        if (t > 16'666'667) {
            EXPECT_LT(apart_m(drawn.poses.left_tracker, last), (0.3 + settings.glide_m_per_s) * 8.4e-3);
            EXPECT_LT(apart_rad(drawn.poses.left_tracker, last), (0.9 + settings.glide_rad_per_s) * 8.4e-3);
        }
        if (t > 1200 * kMs && t < 4900 * kMs) {
            const TrackerReport said = report(settings, track, t + 20 * kMs);
            EXPECT_EQ(said.state, TrackerState::lost);
            EXPECT_NE(said.cause.find("no sample for"), std::string::npos);
        }
        if (t > 4500 * kMs && t < 4900 * kMs) {
            EXPECT_LT(apart_m(drawn.poses.left_tracker, settings.fallback_tracker), 1e-9);
            EXPECT_FALSE(report(settings, track, t).gliding);
        }
        if (t > 7900 * kMs) {
            EXPECT_LT(apart_m(drawn.poses.right_tracker, uniform(seconds(t + 20 * kMs) + 1.0 / 120)), 1e-9);
        }
        last = drawn.poses.right_tracker;
    }
}

// Whatever the tracker says, consecutive pictures are never farther apart than the limits allow.
TEST(TrackerWatch, NothingDrawnEverJumps) {
    const HeadSettings settings;
    const DisplayTiming timing{120.0, EyeOrder::left_first};
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> chance(0, 99);
        HeadTrack track;
        Pose last;
        Nanoseconds last_ns = 0;
        bool silent = false;
        Vec3 shift(0.0);
        int drawn_frames = 0;
        for (Nanoseconds t = 0; t < 4000 * kMs; t += 4 * kMs) {
            const int what = chance(random);
            if (what == 0) silent = !silent;
            if (what == 1) shift = random_vector(random, 2.0);
            TrackerSample sample{t, uniform(seconds(t))};
            sample.sensor_tracker.position_m += shift;
            if (what == 2) sample.sensor_tracker.position_m.x = std::nan("");
            if (what == 3) sample.time_ns -= 700 * kMs;
            if (what < 8 && what > 3) sample.sensor_tracker = {random_vector(random, 3.0), random_rotation(random)};
            if (!silent) track = take(settings, track, sample);
            if (t % (16 * kMs) != 0) continue;
            const EyeTimes times = eye_times(timing, t + 20 * kMs);
            const DrawnHead drawn = draw(settings, track, times);
            track = drawn.track;
            const double limit_m_per_s = settings.max_speed_m_per_s + settings.glide_m_per_s;
            const double limit_rad_per_s = settings.max_turn_rad_per_s + settings.glide_rad_per_s;
            const auto follows = [&](const Pose& p, Nanoseconds at) {
                if (drawn_frames > 0) {
                    EXPECT_LE(apart_m(p, last), limit_m_per_s * seconds(at - last_ns) + 1e-9) << seed << ' ' << t;
                    EXPECT_LE(apart_rad(p, last), limit_rad_per_s * seconds(at - last_ns) + 1e-7) << seed << ' ' << t;
                }
                EXPECT_NEAR(glm::length(p.orientation), 1.0, 1e-9);
                last = p, last_ns = at, ++drawn_frames;
            };
            follows(drawn.poses.left_tracker, times.left_ns);
            follows(drawn.poses.right_tracker, times.right_ns);
        }
        EXPECT_GT(track.refused, 20u);
    }
}

}  // namespace burin::wall
