// SPDX-License-Identifier: MIT
#include "activities/rehab/finger_measures.hpp"

#include <algorithm>

namespace burin::activities {

HandMeasures with_turn(HandMeasures measures, const FingersTurn& turn) {
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
        }
    }
    measures.begun = true;
    return measures;
}

}  // namespace burin::activities
