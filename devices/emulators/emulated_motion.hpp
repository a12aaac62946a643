// SPDX-License-Identifier: MIT
// What emulated tracking systems see: a viewer who sways before a wall and swings a wand, as a function of time alone.
// Frame: world, metres (the maker's axes are the world's). Pure.
#pragma once

#include "base/space.hpp"

namespace burin::devices {

struct EmulatedMotion {
    Pose head_world, wand_world;
    bool is_pressed = false;  // the wand's first button
    Vec2 stick{0.0};          // of the wand, -1 to 1
};

// time_s: since the emulator began. The head sways by 0.2 m at eye level, 2 m before the wall; the wand circles in
// front of it and nods. Its first button is down in the fourth and fifth of every ten seconds; its stick is pushed to
// the side in the eighth.
[[nodiscard]] EmulatedMotion emulated_motion(double time_s);

// A drill: an emulator falls silent from so many seconds on, for so many seconds; from 0: never, for 0: for good.
struct SilenceDrill {
    double from_s = 0.0, for_s = 0.0;
    [[nodiscard]] bool is_silent(double time_s) const {
        return from_s > 0.0 && time_s >= from_s && (for_s == 0.0 || time_s < from_s + for_s);
    }
};

}  // namespace burin::devices
