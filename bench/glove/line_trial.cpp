// SPDX-License-Identifier: MIT
#include "bench/glove/line_trial.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/try.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "devices/gloves/glove_link.hpp"

namespace burin::bench {
namespace {

constexpr std::size_t kIndex = 1;
constexpr double kTrial_s = 1.5, kEnd_s = 0.5, kBack_m = 0.0002;
// Closures of the hand, as shares of a fist: when a trial begins, and when the finger meets the ball.
constexpr double kFrom = 0.25, kMeets = 0.3;
// The script's moment at which the emulated hand begins to close.
constexpr double kCloses_s = 2.0;

double piston_m(const devices::FingerAngles& angles) {
    return devices::place_of(devices::usual_hand()[kIndex], angles).piston_m;
}

double ball_m() { return piston_m(devices::bent_in(devices::GripShape::whole, kIndex, kMeets)); }

// The host's turns, each a millisecond.
void render(devices::GloveLink& link, MadeAt at, double stiffness_N_per_m) {
    MonotonicClock clock;
    const Nanoseconds from_ns = clock.now_ns();
    for (Nanoseconds due_ns = from_ns; due_ns - from_ns < nanoseconds(kTrial_s); due_ns += 1'000'000) {
        clock.sleep_until(due_ns);
        const double pressed_m = ball_m() - piston_m(link.newest().set.joints[kIndex]);
        devices::GloveForces forces_N{};
        devices::GloveLaws laws{};
        forces_N[kIndex] = std::clamp(stiffness_N_per_m * pressed_m, 0.0, devices::kMostPistonForce_N);
        if (at == MadeAt::controller && pressed_m > 0.0)
            laws[kIndex] = {.holds = true,
                            .spring_N_per_m = stiffness_N_per_m,
                            .start_m = ball_m(),
                            .most_N = devices::kMostPistonForce_N};
        link.command(forces_N, laws);
    }
}

// The ball's force at a moment.
double meant_N(const TrialMoment& moment, double stiffness_N_per_m) {
    return std::clamp(stiffness_N_per_m * (ball_m() - moment.piston_m), 0.0, devices::kMostPistonForce_N);
}

// By how many steps the piston's force is behind the ball's: where the difference of the two is least.
double lag_of(const std::vector<TrialMoment>& moments, double stiffness_N_per_m) {
    constexpr std::size_t kMostSteps = 60;
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t lag = 0; lag < kMostSteps; ++lag) {
        double sum = 0.0;
        for (std::size_t i = kMostSteps; i < moments.size(); ++i) {
            const double away = moments[i].given_N - meant_N(moments[i - lag], stiffness_N_per_m);
            sum += away * away;
        }
        if (sum < least) best = lag;
        least = std::min(least, sum);
    }
    return static_cast<double>(best) * devices::EmulatedGlove::kStep_s;
}

double error_of(const std::vector<TrialMoment>& moments, double stiffness_N_per_m) {
    double squares = 0.0, most = 0.0;
    for (const TrialMoment& moment : moments) {
        const double meant = meant_N(moment, stiffness_N_per_m);
        squares += (moment.given_N - meant) * (moment.given_N - meant);
        most = std::max(most, meant);
    }
    return most > 0.0 ? std::sqrt(squares / static_cast<double>(moments.size())) / most : 0.0;
}

}  // namespace

Result<std::vector<TrialMoment>> close_on_ball(MadeAt at, double stiffness_N_per_m) {
    BURIN_TRY(port, devices::GlovePort::create());
    std::vector<TrialMoment> moments;  // the glove's thread's, until it has ended
    std::atomic<bool> ends = false;
    devices::EmulatedGlove begins;
    begins.scripted_s = kCloses_s;
    begins.grip.closed.fill(kFrom);
    std::thread glove([&] {
        port.run(
            begins, [&] { return ends.load(); },
            [&](const devices::EmulatedGlove& now) {
                if (now.commanded) moments.push_back({now.time_s, now.pistons_m[kIndex], now.given_N[kIndex]});
            });
    });
    MonotonicClock clock;
    Result<void> done;
    if (auto link = devices::GloveLink::open(port.name(), clock))
        render(**link, at, stiffness_N_per_m);
    else
        done = std::unexpected(link.error());
    ends = true;
    glove.join();
    if (!done) return std::unexpected(done.error());
    return moments;
}

bool rests_at_end(const std::vector<TrialMoment>& moments) {
    if (moments.empty()) return false;
    double least_m = HUGE_VAL, back_m = 0.0;
    for (const TrialMoment& moment : moments) {
        if (moment.time_s < moments.back().time_s - kEnd_s) continue;
        least_m = std::min(least_m, moment.piston_m);
        back_m = std::max(back_m, moment.piston_m - least_m);
    }
    return back_m < kBack_m;
}

Result<TrialFigures> try_line(MadeAt at) {
    constexpr double kFrom_N_per_m = 60.0, kMost_N_per_m = 6000.0, kFactor = 1.4;
    TrialFigures figures{.at = at};
    for (double k = kFrom_N_per_m; k < kMost_N_per_m; k *= kFactor) {
        BURIN_TRY(moments, close_on_ball(at, k));
        if (!rests_at_end(moments)) break;
        figures.stiffest_N_per_m = k;
    }
    BURIN_TRY(soft, close_on_ball(at, kSoft_N_per_m));
    figures.lag_s = lag_of(soft, kSoft_N_per_m);
    figures.force_error = error_of(soft, kSoft_N_per_m);
    return figures;
}

}  // namespace burin::bench
