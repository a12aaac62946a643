// SPDX-License-Identifier: MIT
#include "activities/rehab/ball_exercise.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.hpp"

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

}  // namespace

std::array<BallKind, 4> ball_kinds() { return kBallKinds; }

const BallKind& kind_of(BallColour colour) { return kBallKinds[static_cast<std::size_t>(colour)]; }

std::optional<BallColour> ball_named(std::string_view name) {
    const auto kind = std::ranges::find(kBallKinds, name, &BallKind::name);
    return kind != kBallKinds.end() ? std::optional(kind->colour) : std::nullopt;
}

std::vector<Error> problems(const BallSettings& settings) {
    std::vector<Error> found;
    if (settings.level < 1 || settings.level > BallSettings::kTargets_N.size())
        found.push_back({formatted("is %u", settings.level), "level", "there are levels 1, 2 and 3"});
    if (settings.repetitions < 1 || settings.repetitions > BallSettings::kMostRepetitions)
        found.push_back({formatted("is %u", settings.repetitions), "repetitions", "ask for 1 to 1000 squeezes"});
    if (!(settings.hold_s >= 0.0 && settings.hold_s <= BallSettings::kMostHold_s))
        found.push_back({formatted("is %g", settings.hold_s), "hold_s", "ask for 0 to 60 seconds"});
    if (!(settings.time_limit_s > 0.0 && settings.time_limit_s <= BallSettings::kMostTime_s))
        found.push_back(
            {formatted("is %g", settings.time_limit_s), "time_limit_s", "give more than 0 and at most 3600 seconds"});
    return found;
}

std::string_view text_of(BallEvent::What what) {
    switch (what) {
        case BallEvent::What::begun: return "begun";
        case BallEvent::What::grasped: return "grasped";
        case BallEvent::What::reached: return "force reached";
        case BallEvent::What::counted: return "counted";
        case BallEvent::What::too_short: return "held too short";
        case BallEvent::What::let_go: return "let go";
        case BallEvent::What::done: return "done";
        case BallEvent::What::time_over: return "time over";
    }
    return "";
}

BallStep step_ball(BallState state, const BallSettings& settings, const BallTurn& turn) {
    BallStep step{state, {}};
    BallState& next = step.state;
    if (state.phase == BallPhase::ended) return step;
    const double force_N = sum_of(turn.fingers.forces_N), target_N = settings.target_N();
    const auto tell = [&](BallEvent::What what) { step.events.push_back({what, turn.time_ns, force_N}); };
    if (state.phase == BallPhase::begins) {
        next.begun_ns = turn.time_ns;
        next.phase = BallPhase::waits;
        tell(BallEvent::What::begun);
    }
    next.last_ns = turn.time_ns;
    next.measures = with_turn(state.measures, turn.fingers);
    if (turn.grasped != state.grasped) {
        next.grasped = turn.grasped;
        next.grasps += turn.grasped ? 1 : 0;
        tell(turn.grasped ? BallEvent::What::grasped : BallEvent::What::let_go);
    }
    const bool kept = turn.grasped && force_N >= BallState::kKept * target_N;
    if (next.phase == BallPhase::relaxes && (!turn.grasped || force_N <= BallState::kRelaxed * target_N))
        next.phase = BallPhase::waits;
    if (next.phase == BallPhase::waits && turn.grasped && force_N >= target_N) {
        next.phase = BallPhase::holds;
        next.held_since_ns = turn.time_ns;
        tell(BallEvent::What::reached);
    }
    if (next.phase == BallPhase::holds && !kept) {
        next.phase = BallPhase::waits;
        ++next.too_short;
        tell(BallEvent::What::too_short);
    }
    if (next.phase == BallPhase::holds && seconds(turn.time_ns - next.held_since_ns) >= settings.hold_s) {
        next.phase = BallPhase::relaxes;
        ++next.repetitions;
        tell(BallEvent::What::counted);
    }
    const bool done = next.repetitions >= settings.repetitions;
    if (!done && next.time_s() < settings.time_limit_s) return step;
    next.phase = BallPhase::ended;
    next.end = done ? BallEnd::done : BallEnd::time_over;
    tell(done ? BallEvent::What::done : BallEvent::What::time_over);
    return step;
}

double score_of(const BallState& state, const BallSettings& settings) {
    const double counted = state.repetitions - 0.1 * state.too_short;
    return 100.0 * std::clamp(counted / settings.repetitions, 0.0, 1.0);
}

}  // namespace burin::activities
