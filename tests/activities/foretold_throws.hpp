// SPDX-License-Identifier: MIT
// What becomes of a throw at the wall by itself: a ball that is moved on in steps of 20 us, in a room whose figures
// stand here anew. Nothing of the program's flight or rules is used.
#pragma once

#include <algorithm>
#include <cmath>

#include "activities/rehab/game/scripted_throws.hpp"

namespace burin::activities {

struct ForetoldThrow {
    bool above_line = false, catches = false;
    double nearest_m = 1e9;  // to where the hand waits, from the wall until the second bounce off the floor
};

inline ForetoldThrow foretold_of(const ScriptedThrow& thrown, const GameSettings& settings) {
    constexpr double kStep_s = 20e-6, kRadius_m = 0.035, kWall_z_m = -0.3, kBack = 0.75, kAlong = 0.9, kReach_m = 0.03;
    const double line_m = 0.12 + 0.04 * settings.level;
    const double falls = 9.81 * (settings.speed == GameSpeed::slow ? 0.05 : 0.125);
    ForetoldThrow foretold;
    double y = thrown.from_m.y, z = thrown.from_m.z, up = thrown.velocity_m_per_s.y, out = thrown.velocity_m_per_s.z;
    bool at_wall = false;
    for (int floors = 0; floors < 2;) {
        y += kStep_s * (up - 0.5 * kStep_s * falls);
        z += kStep_s * out;
        up -= kStep_s * falls;
        if (!at_wall && z <= kWall_z_m + kRadius_m) {
            foretold.above_line = y > line_m;
            if (!foretold.above_line) return foretold;
            at_wall = true;
            out *= -kBack;
            up *= kAlong;
        }
        if (y <= kRadius_m && up < 0.0) {
            ++floors;
            up *= -kBack;
            out *= kAlong;
        }
        if (at_wall && floors < 2)
            foretold.nearest_m = std::min(foretold.nearest_m, std::hypot(y - thrown.waits_m.y, z - thrown.waits_m.z));
    }
    foretold.catches = thrown.caught != ScriptedCatch::with_open_hand && foretold.nearest_m <= kReach_m;
    return foretold;
}

}  // namespace burin::activities
