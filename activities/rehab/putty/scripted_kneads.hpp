// SPDX-License-Identifier: MIT
// A scripted participant of the putty exercise: when it closes and opens its hand, drawn from a seed, as lines of a
// session's input. In some kneads it does not close far enough to touch. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/putty/putty_exercise.hpp"

namespace burin::activities {

struct ScriptedKnead {
    double closes_s = 0.0, opens_s = 0.0;  // since the session's beginning
    bool misses = false;                   // it opens before it touches
};

// Returns kneads until as many touch as the exercise asks for. The first begins at first_s.
[[nodiscard]] std::vector<ScriptedKnead> drawn_kneads(const PuttySettings& settings, std::uint64_t seed,
                                                      double first_s);
// Returns the script as the participant of that seed follows it.
[[nodiscard]] std::string scripted_putty(const SettingValues& values, std::uint64_t seed, std::string_view script);

}  // namespace burin::activities
