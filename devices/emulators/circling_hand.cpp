// SPDX-License-Identifier: MIT
#include "devices/emulators/circling_hand.hpp"

#include <cmath>
#include <numbers>

namespace burin::devices {

std::vector<HandPose> circling_hand() {
    constexpr double kRest_s = 2.0, kDown_s = 1.0, kCircle_s = 8.0, kUp_s = 1.0, kStep_s = 0.25;
    constexpr double kRadius_m = 0.02, kAbove_m = 0.03;
    const Quat upright(1.0, 0.0, 0.0, 0.0);
    std::vector<HandPose> script;
    for (double begin_s = 0.0; begin_s < kCirclingScript_s; begin_s += kRest_s + kDown_s + kCircle_s + kUp_s) {
        const Vec3 first(kRadius_m, 0.0, 0.0), above(kRadius_m, 0.0, kAbove_m);
        script.push_back({begin_s, above, upright, 0});
        script.push_back({begin_s + kRest_s, above, upright, 0});
        for (double t = 0.0; t < kCircle_s; t += kStep_s) {
            const double angle = 2.0 * std::numbers::pi * t / kCircle_s;
            script.push_back(
                {begin_s + kRest_s + kDown_s + t, kRadius_m * Vec3(std::cos(angle), std::sin(angle), 0.0), upright, 1});
        }
        script.push_back({begin_s + kRest_s + kDown_s + kCircle_s, first, upright, 0});
    }
    return script;
}

}  // namespace burin::devices
