// SPDX-License-Identifier: MIT
#include "activities/rehab/ball/ball_exercise.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin::activities {
namespace {

// Colours as trainers of the hand have them; Young's moduli are ours, from soft foam's to rubber's.
constexpr std::array kBallKinds{
    BallKind{BallColour::yellow, "yellow", {0.93, 0.78, 0.2}, 50e3},
    BallKind{BallColour::red, "red", {0.78, 0.25, 0.18}, 100e3},
    BallKind{BallColour::green, "green", {0.27, 0.58, 0.3}, 200e3},
    BallKind{BallColour::blue, "blue", {0.2, 0.38, 0.7}, 400e3},
};

double sum_of(const FingerForces& forces_N) { return std::accumulate(forces_N.begin(), forces_N.end(), 0.0); }

void adapt(BallState& state, bool succeeded) {
    if (state.staircase) state.staircase = after_trial(*state.staircase, succeeded);
}

}  // namespace

double target_N_of(const BallState& state, const BallSettings& settings) {
    if (state.staircase) return state.staircase->target_N;
    return settings.adapts ? settings.adapts->target_N : settings.target_N();
}

std::array<BallKind, 4> ball_kinds() { return kBallKinds; }

std::size_t BallState::weakest_finger() const {
    return static_cast<std::size_t>(std::ranges::min_element(smooth_each_N) - smooth_each_N.begin());
}

const BallKind& kind_of(BallColour colour) { return kBallKinds[static_cast<std::size_t>(colour)]; }

std::optional<BallColour> ball_named(std::string_view name) {
    const auto kind = std::ranges::find(kBallKinds, name, &BallKind::name);
    return kind != kBallKinds.end() ? std::optional(kind->colour) : std::nullopt;
}

BallStep step_ball(BallState state, const BallSettings& settings, const ExerciseTurn& turn) {
    BallStep step{state, {}};
    BallState& next = step.state;
    if (state.phase == BallPhase::ended) return step;
    const double sum_N = sum_of(turn.fingers.forces_N), target_N = target_N_of(state, settings),
                 of_each_N = settings.share * target_N;
    const double follows = 1.0 - std::exp(-turn.fingers.dt_s / BallState::kSmooths_s);
    next.smooth_N += (sum_N - state.smooth_N) * follows;
    for (std::size_t i = 0; i < next.smooth_each_N.size(); ++i)
        next.smooth_each_N[i] += (turn.fingers.forces_N[i] - state.smooth_each_N[i]) * follows;
    const double least_N = next.smooth_each_N[next.weakest_finger()];
    const double force_N = next.smooth_N;
    const auto tell = [&](std::string_view what) { step.events.push_back({what, turn.time_ns, force_N}); };
    if (state.phase == BallPhase::begins) {
        next.begun_ns = turn.time_ns;
        next.phase = BallPhase::waits;
        next.staircase = settings.adapts;
        tell(ball_event::kBegun);
    }
    next.last_ns = turn.time_ns;
    if (turn.grasped != state.grasped) {
        next.grasped = turn.grasped;
        next.grasps += turn.grasped ? 1 : 0;
        tell(turn.grasped ? ball_event::kGrasped : ball_event::kLetGo);
    }
    const bool kept = turn.grasped && force_N >= BallState::kKept * target_N && least_N >= BallState::kKept * of_each_N;
    if (force_N > BallState::kRelaxed * target_N) next.pressed_ns = turn.time_ns;
    const bool relaxed = seconds(turn.time_ns - next.pressed_ns) >= BallState::kRelaxes_s;
    if (next.phase == BallPhase::relaxes && (!turn.grasped || relaxed)) next.phase = BallPhase::waits;
    const bool reaches = next.phase == BallPhase::waits && turn.grasped && force_N >= target_N;
    const bool uneven = reaches && least_N < of_each_N;
    if (!uneven)
        next.uneven_since_ns = 0;
    else if (state.uneven_since_ns == 0)
        next.uneven_since_ns = turn.time_ns;
    else if (!state.told_uneven && seconds(turn.time_ns - state.uneven_since_ns) >= BallState::kUneven_s) {
        next.told_uneven = true;
        tell(ball_event::kUneven);
    }
    if (relaxed || !turn.grasped) next.told_uneven = false;
    if (reaches && !uneven) {
        next.phase = BallPhase::holds;
        next.held_since_ns = turn.time_ns;
        tell(ball_event::kReached);
    }
    if (next.phase == BallPhase::holds && !kept) {
        next.phase = BallPhase::waits;
        ++next.too_short;
        next.spent = true;
        adapt(next, false);
        tell(ball_event::kTooShort);
    }
    if (next.phase == BallPhase::holds && seconds(turn.time_ns - next.held_since_ns) >= settings.hold_s) {
        next.phase = BallPhase::relaxes;
        ++next.repetitions;
        adapt(next, true);
        tell(ball_event::kCounted);
    }
    if (next.staircase) {
        const bool lets_off = relaxed || !turn.grasped;
        if (next.phase != BallPhase::waits)
            next.tried = false;
        else if (turn.grasped && !next.spent && force_N > BallState::kRelaxed * target_N)
            next.tried = true;
        if (next.tried && lets_off) {
            next.tried = false;
            ++next.too_weak;
            adapt(next, false);
            tell(ball_event::kTooWeak);
        }
        if (lets_off) next.spent = false;
    }
    const bool done = next.repetitions >= settings.repetitions;
    if (!done && next.time_s() < settings.time_limit_s) return step;
    next.phase = BallPhase::ended;
    next.end = done ? ExerciseEnd::done : ExerciseEnd::time_over;
    tell(done ? ball_event::kDone : ball_event::kTimeOver);
    return step;
}

BallStep interrupted(BallState state, Nanoseconds time_ns) {
    BallStep step{state, {}};
    if (state.phase == BallPhase::begins || state.phase == BallPhase::ended) return step;
    BallState& next = step.state;
    if (state.phase == BallPhase::holds) step.events.push_back({ball_event::kInterrupted, time_ns, state.smooth_N});
    next.phase = BallPhase::waits;
    next.smooth_N = 0.0;
    next.smooth_each_N = {};
    next.uneven_since_ns = 0;
    next.told_uneven = false;
    next.tried = next.spent = false;  // a force that adapts stays as it is
    return step;
}

double score_of(const BallState& state, const BallSettings& settings) {
    const double counted = state.repetitions - 0.1 * state.too_short;
    return 100.0 * std::clamp(counted / settings.repetitions, 0.0, 1.0);
}

}  // namespace burin::activities
