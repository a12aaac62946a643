// SPDX-License-Identifier: MIT
#include "activities/rehab/assess/assessment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/hand/hand_joints.hpp"

namespace burin::activities {
namespace {

constexpr std::array<AssessPart, kAssessParts> kParts{{
    {AssessTask::range, 0, 12.0, "range begins"},
    {AssessTask::press, 0, 5.0, "first press begins"},
    {AssessTask::press, 0, 5.0, "second press begins"},
    {AssessTask::press, 0, 5.0, "third press begins"},
    {AssessTask::speed, 0, 8.0, "speed begins"},
    {AssessTask::alone, 0, 8.0, "thumb alone begins"},
    {AssessTask::alone, 1, 8.0, "index alone begins"},
    {AssessTask::alone, 2, 8.0, "middle alone begins"},
    {AssessTask::alone, 3, 8.0, "ring alone begins"},
}};
constexpr double kHeldStep_s = HeldForce::kFor_s / static_cast<double>(HeldForce::kSteps);
constexpr double kAnyForce_N = 0.05;
constexpr double kRoundingOfStep_s = 1e-9;

double flexion_of(const devices::FingerAngles& joints_rad) {
    return std::accumulate(joints_rad.begin() + 1, joints_rad.end(), 0.0);
}

double force_of(const FingersTurn& turn, std::size_t finger) {
    return turn.drive_N[finger].value_or(turn.forces_N[finger] + turn.elsewhere_N[finger]);
}

void follow_strength(AssessState& state, const FingersTurn& turn) {
    double sum_N = 0.0;
    bool all = true;
    for (std::size_t i = 0; i < state.strength.size(); ++i) {
        const bool is_sound = !turn.has_fault[i] && turn.dt_s <= AssessState::kGap_s;
        all = all && is_sound;
        sum_N += force_of(turn, i);
        state.strength[i] =
            is_sound ? with_force(state.strength[i], force_of(turn, i), turn.dt_s) : after_gap(state.strength[i]);
    }
    state.together = all ? with_force(state.together, sum_N, turn.dt_s) : after_gap(state.together);
}

// Takes a turn's flexions into the means and into the sums of products of their deviations (Welford).
AloneSums with_flexions(AloneSums sums, std::size_t instructed, const FingersTurn& turn) {
    if (std::ranges::find(turn.has_fault, true) != turn.has_fault.end() || turn.dt_s > AssessState::kGap_s ||
        turn.dt_s <= 0.0)
        return sums;
    const double now_rad = flexion_of(turn.joints_rad[instructed]);
    sums.least_rad = sums.time_s > 0.0 ? std::min(sums.least_rad, now_rad) : now_rad;
    sums.most_rad = sums.time_s > 0.0 ? std::max(sums.most_rad, now_rad) : now_rad;
    sums.time_s += turn.dt_s;
    const double share = turn.dt_s / sums.time_s, off_rad = now_rad - sums.mean_rad[instructed];
    for (std::size_t i = 0; i < sums.mean_rad.size(); ++i) {
        const double other_rad = flexion_of(turn.joints_rad[i]);
        const double before_rad = other_rad - sums.mean_rad[i];
        sums.with_instructed[i] += turn.dt_s * (1.0 - share) * off_rad * before_rad;
        sums.mean_rad[i] += share * before_rad;
    }
    return sums;
}

std::optional<double> fractionation_of(const AloneSums& sums, std::size_t instructed) {
    if (sums.most_rad - sums.least_rad < AssessState::kMoved_rad) return std::nullopt;
    double slopes = 0.0;
    for (std::size_t i = 0; i < sums.with_instructed.size(); ++i)
        if (i != instructed) slopes += std::abs(sums.with_instructed[i] / sums.with_instructed[instructed]);
    return 1.0 - slopes / static_cast<double>(sums.with_instructed.size() - 1);
}

void take_measure(AssessState& state, const AssessPart& part, const FingersTurn& turn) {
    switch (part.task) {
        case AssessTask::range: state.range = with_turn(state.range, turn); return;
        case AssessTask::press: follow_strength(state, turn); return;
        case AssessTask::speed: state.speed = with_turn(state.speed, turn); return;
        case AssessTask::alone:
            state.alone[part.finger] = with_flexions(state.alone[part.finger], part.finger, turn);
            return;
    }
}

}  // namespace

const std::array<AssessPart, kAssessParts>& assess_parts() { return kParts; }

double assess_begins_s(std::size_t part) {
    double at_s = kReads_s;
    for (std::size_t i = 0; i < part; ++i) at_s += kParts[i].lasts_s + kReads_s;
    return at_s;
}

HeldForce with_force(HeldForce held, double force_N, double dt_s) {
    if (held.begun == 0) {
        held.begun = 1;
        held.step_s = 0.0;
        held.least_N.back() = force_N;
        return held;
    }
    held.least_N.back() = std::min(held.least_N.back(), force_N);
    held.step_s += dt_s;
    if (held.step_s < kHeldStep_s - kRoundingOfStep_s) return held;
    if (held.begun == held.least_N.size()) {
        held.was_held = true;
        held.most_N = std::max(held.most_N, *std::ranges::min_element(held.least_N));
    }
    std::ranges::rotate(held.least_N, held.least_N.begin() + 1);
    held.least_N.back() = force_N;
    held.begun = std::min(held.begun + 1, held.least_N.size());
    held.step_s = 0.0;
    return held;
}

HeldForce after_gap(HeldForce held) {
    held.begun = 0;
    return held;
}

AssessStep step_assessment(AssessState state, const ExerciseTurn& turn) {
    AssessStep step{state, {}};
    AssessState& next = step.state;
    if (state.end != ExerciseEnd::not_yet) return step;
    const auto tell = [&](std::string_view what) {
        double sum_N = 0.0;
        for (std::size_t i = 0; i < devices::kGloveFingers; ++i) sum_N += force_of(turn.fingers, i);
        step.events.push_back({what, turn.time_ns, sum_N});
    };
    if (!state.begun) {
        next.begun = true;
        next.begun_ns = turn.time_ns;
        tell("begun");
    }
    next.last_ns = turn.time_ns;
    const double at_s = next.course_s();
    if (next.measures && at_s >= assess_begins_s(next.part) + kParts[next.part].lasts_s) {
        next.measures = false;
        ++next.part;
        if (next.part == kAssessParts) {
            next.end = ExerciseEnd::done;
            tell("done");
            return step;
        }
        tell("let go");
    }
    if (!next.measures && at_s >= assess_begins_s(next.part)) {
        next.measures = true;
        for (HeldForce& held : next.strength) held = after_gap(held);
        next.together = after_gap(next.together);
        next.strength_before = next.strength;
        next.together_before = next.together;
        tell(kParts[next.part].begins);
    }
    if (next.measures) take_measure(next, kParts[next.part], turn.fingers);
    return step;
}

AssessStep interrupted(AssessState state, Nanoseconds time_ns) {
    AssessStep step{state, {}};
    if (!state.begun || state.end != ExerciseEnd::not_yet) return step;
    AssessState& next = step.state;
    const double to_read_s = assess_begins_s(state.part) - kReads_s;
    next.again_ns = state.last_ns - state.begun_ns - nanoseconds(to_read_s);
    if (!std::exchange(next.measures, false)) return step;
    step.events.push_back({kPartInterrupted, time_ns, 0.0});
    const AssessPart& part = kParts[state.part];
    switch (part.task) {
        case AssessTask::range: next.range = {}; break;
        case AssessTask::press:
            next.strength = state.strength_before;
            next.together = state.together_before;
            break;
        case AssessTask::speed: next.speed = {}; break;
        case AssessTask::alone: next.alone[part.finger] = {}; break;
    }
    return step;
}

Assessed assessed(const AssessState& state) {
    Assessed found;
    double open = 0.0, closed = 0.0;
    bool all = true;
    for (std::size_t i = 0; i < found.fingers.size(); ++i) {
        AssessedFinger& finger = found.fingers[i];
        const FingerMeasures &range = state.range.fingers[i], &speed = state.speed.fingers[i];
        for (std::size_t joint = 0; joint < finger.range_rad.size(); ++joint)
            if (range.most_rad[joint] >= range.least_rad[joint]) finger.range_rad[joint] = range.range_rad(joint);
        if (range.was_free()) {
            const auto of = static_cast<geometry::Finger>(i);
            finger.open = range.open_closure(of);
            finger.closed = range.closed_closure(of);
            open += *finger.open / static_cast<double>(found.fingers.size());
            closed += *finger.closed / static_cast<double>(found.fingers.size());
        } else {
            all = false;
        }
        if (state.strength[i].was_held) finger.strength_N = state.strength[i].most_N;
        if (speed.moved_s > 0.0) {
            finger.peak_rad_per_s = speed.peak_rad_per_s;
            finger.mean_rad_per_s = speed.mean_rad_per_s();
        }
        finger.fractionation = fractionation_of(state.alone[i], i);
    }
    if (all) {
        found.open = open;
        found.closed = closed;
    }
    // Where no finger has given anything, nobody knows whether a piston would have: the force may be switched off.
    if (state.together.was_held && state.together.most_N < kAnyForce_N)
        for (AssessedFinger& finger : found.fingers) finger.strength_N.reset();
    else if (state.together.was_held)
        found.together_N = state.together.most_N;
    return found;
}

unsigned Assessed::measured_parts() const {
    const auto all = [&](auto has) { return std::ranges::all_of(fingers, has) ? 1u : 0u; };
    unsigned parts = all([](const AssessedFinger& finger) { return finger.closed.has_value(); }) +
                     3 * all([](const AssessedFinger& finger) { return finger.strength_N.has_value(); }) +
                     all([](const AssessedFinger& finger) { return finger.peak_rad_per_s.has_value(); });
    for (const AssessedFinger& finger : fingers) parts += finger.fractionation ? 1u : 0u;
    return parts;
}

std::string instruction_of(const AssessPart& part) {
    switch (part.task) {
        case AssessTask::range:
            return "Open the hand as far as it goes, then close it as far as it goes, again and again.";
        case AssessTask::press:
            return "Hold the fingers half closed. When it begins, press with all fingers as hard as you can.";
        case AssessTask::speed: return "Open and close the hand as fast as you can.";
        case AssessTask::alone:
            return "Bend and straighten the " + std::string(kFingerNames[part.finger]) +
                   " alone, again and again; keep the other fingers still.";
    }
    return "";
}

}  // namespace burin::activities
