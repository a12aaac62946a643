// SPDX-License-Identifier: MIT
#include "activities/rehab/putty/putty_exercise.hpp"

#include <algorithm>
#include <numeric>

namespace burin::activities {
namespace {

constexpr std::array kPuttyKinds{
    PuttyKind{60e3, 3e3, {0.91, 0.8, 0.42}},
    PuttyKind{120e3, 6e3, {0.45, 0.68, 0.42}},
    PuttyKind{240e3, 12e3, {0.36, 0.5, 0.74}},
};

// Thumb and index, and nobody else; or all.
bool is_the_grip(const FingerForces& forces_N, bool pinch) {
    for (std::size_t i = 0; i < forces_N.size(); ++i)
        if ((forces_N[i] >= PuttyState::kTakesPart_N) != (!pinch || i < 2)) return false;
    return true;
}

}  // namespace

const PuttyKind& kind_of(PuttyHardness hardness) { return kPuttyKinds[static_cast<std::size_t>(hardness)]; }

PuttyStep step_putty(PuttyState state, const PuttySettings& settings, const ExerciseTurn& turn) {
    PuttyStep step{state, {}};
    PuttyState& next = step.state;
    if (state.phase == PuttyPhase::ended) return step;
    const FingerForces& forces_N = turn.fingers.forces_N;
    const double force_N = std::accumulate(forces_N.begin(), forces_N.end(), 0.0), target_N = settings.target_N();
    const auto tell = [&](std::string_view what) { step.events.push_back({what, turn.time_ns, force_N}); };
    if (state.phase == PuttyPhase::begins) {
        next.begun_ns = turn.time_ns;
        next.phase = PuttyPhase::waits;
        tell(putty_event::kBegun);
    }
    next.last_ns = turn.time_ns;
    next.force_N = force_N;
    const bool relaxed = force_N <= PuttyState::kRelaxed * target_N;
    if (next.phase == PuttyPhase::relaxes && relaxed) next.phase = PuttyPhase::waits;
    if (next.phase == PuttyPhase::waits && force_N >= PuttyState::kTried * target_N) {
        next.phase = PuttyPhase::presses;
        tell(putty_event::kPressed);
    }
    if (next.phase == PuttyPhase::presses && relaxed) {
        next.phase = PuttyPhase::waits;
        ++(next.reached ? next.wrong_grip : next.too_weak);
        tell(next.reached ? putty_event::kWrongGrip : putty_event::kTooWeak);
    }
    const bool reaches = next.phase == PuttyPhase::presses && force_N >= target_N;
    next.reached = next.phase == PuttyPhase::presses && (state.reached || reaches);
    next.right_s = reaches && is_the_grip(forces_N, settings.is_pinch()) ? state.right_s + turn.fingers.dt_s : 0.0;
    if (next.right_s >= PuttyState::kGrips_s) {
        next.phase = PuttyPhase::relaxes;
        ++next.kneads;
        tell(putty_event::kKneaded);
    }
    const bool done = next.kneads >= settings.kneads;
    if (!done && next.time_s() < settings.time_limit_s) return step;
    next.phase = PuttyPhase::ended;
    next.end = done ? ExerciseEnd::done : ExerciseEnd::time_over;
    tell(done ? putty_event::kDone : putty_event::kTimeOver);
    return step;
}

PuttyStep interrupted(PuttyState state, Nanoseconds time_ns) {
    PuttyStep step{state, {}};
    if (state.phase == PuttyPhase::begins || state.phase == PuttyPhase::ended) return step;
    if (state.phase == PuttyPhase::presses) step.events.push_back({putty_event::kInterrupted, time_ns, state.force_N});
    step.state.phase = PuttyPhase::waits;
    step.state.reached = false;
    step.state.right_s = step.state.force_N = 0.0;
    return step;
}

double score_of(const PuttyState& state, const PuttySettings& settings) {
    const double counted = state.kneads - 0.1 * (state.too_weak + state.wrong_grip);
    return 100.0 * std::clamp(counted / settings.kneads, 0.0, 1.0);
}

}  // namespace burin::activities
