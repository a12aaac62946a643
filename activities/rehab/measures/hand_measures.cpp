// SPDX-License-Identifier: MIT
#include "activities/rehab/measures/hand_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin::activities {
namespace {

// Ends a window of `window_s` in which each finger's flexion came from `from_rad` to `to_rad`.
void end_window(HandMeasures& measures, const std::array<double, devices::kGloveFingers>& to_rad) {
    std::array<double, devices::kGloveFingers> ways_rad{};
    for (std::size_t i = 0; i < ways_rad.size(); ++i) {
        FingerMeasures& finger = measures.fingers[i];
        ways_rad[i] = std::abs(to_rad[i] - measures.window_from_rad[i]);
        finger.peak_rad_per_s = std::max(finger.peak_rad_per_s, ways_rad[i] / measures.window_s);
        if (ways_rad[i] <= FingerMeasures::kMoved_rad) continue;
        finger.moved_rad += ways_rad[i];
        finger.moved_s += measures.window_s;
    }
    const auto farthest = static_cast<std::size_t>(std::ranges::max_element(ways_rad) - ways_rad.begin());
    if (ways_rad[farthest] > FingerMeasures::kMoved_rad) {
        const double all_rad = std::accumulate(ways_rad.begin(), ways_rad.end(), 0.0);
        measures.fingers[farthest].led_rad += ways_rad[farthest];
        measures.fingers[farthest].followed_rad += (all_rad - ways_rad[farthest]) / (ways_rad.size() - 1.0);
    }
    measures.window_s = 0.0;
    measures.window_from_rad = to_rad;
}

}  // namespace

HandMeasures with_turn(HandMeasures measures, const FingersTurn& turn) {
    std::array<double, devices::kGloveFingers> flexions_rad{};
    for (std::size_t i = 0; i < measures.fingers.size(); ++i) {
        FingerMeasures& finger = measures.fingers[i];
        const double force_N = turn.forces_N[i];
        finger.peak_N = std::max(finger.peak_N, force_N);
        if (force_N > FingerMeasures::kPushed_N) {
            finger.pushed_s += turn.dt_s;
            finger.impulse_Ns += turn.dt_s * force_N;
        }
        for (std::size_t joint = 0; joint < finger.least_rad.size(); ++joint) {
            const double angle_rad = turn.joints_rad[i][joint];
            double &least = finger.least_rad[joint], &most = finger.most_rad[joint];
            least = measures.begun ? std::min(least, angle_rad) : angle_rad;
            most = measures.begun ? std::max(most, angle_rad) : angle_rad;
            if (joint > 0) flexions_rad[i] += angle_rad;
        }
    }
    if (!measures.begun) measures.window_from_rad = flexions_rad;
    measures.window_s += measures.begun ? turn.dt_s : 0.0;
    measures.begun = true;
    if (measures.window_s >= FingerMeasures::kWindow_s) end_window(measures, flexions_rad);
    return measures;
}

}  // namespace burin::activities
