// SPDX-License-Identifier: MIT
#include "activities/rehab/measures/hand_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin::activities {
namespace {

// Longer between two turns is a gap.
constexpr double kGap_s = 0.05;
constexpr double kPart_s = FingerMeasures::kHeld_s / static_cast<double>(FingerMeasures::kHeldParts);
constexpr double kRounding_s = 1e-9;

// Takes a joint's angles of a turn without a gap before it, and ends a part of kHeld_s where it is over.
void follow_range(FingerMeasures& finger, const devices::FingerAngles& angles_rad, bool is_free, double dt_s) {
    FingerMeasures::Part& now = finger.parts.back();
    if (finger.parts_begun == 0) {
        finger.parts_begun = 1;
        finger.part_s = 0.0;
        now = {angles_rad, angles_rad, is_free};
        return;
    }
    for (std::size_t joint = 0; joint < angles_rad.size(); ++joint) {
        now.least_rad[joint] = std::min(now.least_rad[joint], angles_rad[joint]);
        now.most_rad[joint] = std::max(now.most_rad[joint], angles_rad[joint]);
    }
    now.is_free = now.is_free && is_free;
    finger.part_s += dt_s;
    if (finger.part_s < kPart_s - kRounding_s) return;
    const bool all_free = std::ranges::all_of(finger.parts, &FingerMeasures::Part::is_free);
    if (finger.parts_begun == finger.parts.size())
        for (std::size_t joint = 0; joint < angles_rad.size(); ++joint) {
            double stayed_above_rad = HUGE_VAL, stayed_below_rad = -HUGE_VAL;
            for (const FingerMeasures::Part& part : finger.parts) {
                stayed_above_rad = std::min(stayed_above_rad, part.least_rad[joint]);
                stayed_below_rad = std::max(stayed_below_rad, part.most_rad[joint]);
            }
            finger.most_rad[joint] = std::max(finger.most_rad[joint], stayed_above_rad);
            finger.least_rad[joint] = std::min(finger.least_rad[joint], stayed_below_rad);
            double& most_rad = (all_free ? finger.free_most_rad : finger.pushed_most_rad)[joint];
            most_rad = std::max(most_rad, stayed_above_rad);
            if (all_free) finger.free_least_rad[joint] = std::min(finger.free_least_rad[joint], stayed_below_rad);
        }
    std::ranges::rotate(finger.parts, finger.parts.begin() + 1);
    finger.parts.back() = {angles_rad, angles_rad, is_free};
    finger.parts_begun = std::min(finger.parts_begun + 1, finger.parts.size());
    finger.part_s = 0.0;
}

void follow_forces(FingerMeasures& finger, double told_N, const std::optional<double>& measured_N, double dt_s) {
    finger.peak_N = std::max(finger.peak_N, told_N);
    if (measured_N) finger.measured_peak_N = std::max(finger.measured_peak_N, *measured_N);
    if (told_N <= FingerMeasures::kPushed_N) return;
    finger.pushed_s += dt_s;
    finger.impulse_Ns += dt_s * told_N;
    if (!measured_N) return;
    finger.measured_s += dt_s;
    finger.measured_impulse_Ns += dt_s * *measured_N;
}

void begin_window(HandMeasures& measures, const FingersTurn& turn, const FingerForces& flexions_rad) {
    measures.window_s = 0.0;
    measures.window_from_rad = flexions_rad;
    for (std::size_t i = 0; i < measures.window_is_sound.size(); ++i) measures.window_is_sound[i] = !turn.has_fault[i];
}

// Ends a window of `window_s` in which each finger's flexion came from `from_rad` to `to_rad`. Who led is known only
// where all were read.
void end_window(HandMeasures& measures, const std::array<double, devices::kGloveFingers>& to_rad) {
    std::array<double, devices::kGloveFingers> ways_rad{};
    for (std::size_t i = 0; i < ways_rad.size(); ++i) {
        if (!measures.window_is_sound[i]) continue;
        FingerMeasures& finger = measures.fingers[i];
        ways_rad[i] = std::abs(to_rad[i] - measures.window_from_rad[i]);
        finger.peak_rad_per_s = std::max(finger.peak_rad_per_s, ways_rad[i] / measures.window_s);
        if (ways_rad[i] <= FingerMeasures::kMoved_rad) continue;
        finger.moved_rad += ways_rad[i];
        finger.moved_s += measures.window_s;
    }
    if (std::ranges::find(measures.window_is_sound, false) != measures.window_is_sound.end()) return;
    const auto farthest = static_cast<std::size_t>(std::ranges::max_element(ways_rad) - ways_rad.begin());
    if (ways_rad[farthest] <= FingerMeasures::kMoved_rad) return;
    const double all_rad = std::accumulate(ways_rad.begin(), ways_rad.end(), 0.0);
    measures.fingers[farthest].led_rad += ways_rad[farthest];
    measures.fingers[farthest].followed_rad += (all_rad - ways_rad[farthest]) / (ways_rad.size() - 1.0);
}

// A body that gives is pressed a little farther than where it is touched first: what is closer is stopped by it.
constexpr double kBeyond = 0.02;

}  // namespace

bool FingerMeasures::was_free() const {
    return std::ranges::equal(free_least_rad, free_most_rad, std::ranges::less_equal());
}

double FingerMeasures::open_closure(geometry::Finger finger) const {
    return geometry::closure_of(finger, free_least_rad);
}

double FingerMeasures::closed_closure(geometry::Finger finger) const {
    return geometry::closure_of(finger, free_most_rad);
}

bool FingerMeasures::closed_freely(geometry::Finger finger) const {
    return !std::isfinite(pushed_most_rad[1]) ||
           closed_closure(finger) >= geometry::closure_of(finger, pushed_most_rad) + kBeyond;
}

HandMeasures with_turn(HandMeasures measures, const FingersTurn& turn) {
    const bool goes_on = measures.begun && turn.dt_s <= kGap_s;
    std::array<double, devices::kGloveFingers> flexions_rad{};
    for (std::size_t i = 0; i < measures.fingers.size(); ++i) {
        FingerMeasures& finger = measures.fingers[i];
        for (std::size_t joint = 1; joint < devices::kFingerJoints; ++joint)
            flexions_rad[i] += turn.joints_rad[i][joint];
        if (!goes_on || turn.has_fault[i]) finger.parts_begun = 0;
        if (turn.has_fault[i]) {
            measures.window_is_sound[i] = false;
            continue;
        }
        finger.elsewhere_peak_N = std::max(finger.elsewhere_peak_N, turn.elsewhere_N[i]);
        follow_forces(finger, turn.forces_N[i], turn.measured_N[i], turn.dt_s);
        const bool is_free = turn.forces_N[i] + turn.elsewhere_N[i] <= FingerMeasures::kPushed_N &&
                             turn.measured_N[i].value_or(0.0) <= FingerMeasures::kStopped_N;
        follow_range(finger, turn.joints_rad[i], is_free, turn.dt_s);
    }
    measures.begun = true;
    if (!goes_on) {
        begin_window(measures, turn, flexions_rad);
        return measures;
    }
    measures.window_s += turn.dt_s;
    if (measures.window_s < FingerMeasures::kWindow_s) return measures;
    end_window(measures, flexions_rad);
    begin_window(measures, turn, flexions_rad);
    return measures;
}

}  // namespace burin::activities
