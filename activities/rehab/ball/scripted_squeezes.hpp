// SPDX-License-Identifier: MIT
// A scripted participant of the ball exercise: when it closes and opens its hand, drawn from a seed, as lines of a
// session's input. Some squeezes are let go of too early. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/ball/ball_exercise.hpp"

namespace burin::activities {

struct ScriptedSqueeze {
    double closes_s = 0.0, opens_s = 0.0;  // since the session's beginning
    bool too_short = false;                // it opens before the force has been held for long enough
};

// Returns squeezes until as many are long enough as the exercise asks for. The first begins at first_s.
[[nodiscard]] std::vector<ScriptedSqueeze> drawn_squeezes(const BallSettings& settings, std::uint64_t seed,
                                                          double first_s);

// Returns the script with its squeezes, from the first line that presses a button on, exchanged for these, and an end.
[[nodiscard]] std::string with_squeezes(std::string_view script, const std::vector<ScriptedSqueeze>& squeezes);

// Returns the script as the participant of that seed follows it.
[[nodiscard]] std::string scripted_ball(const SettingValues& values, std::uint64_t seed, std::string_view script);

}  // namespace burin::activities
