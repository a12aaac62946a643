// SPDX-License-Identifier: MIT
// The therapist's settings of the exercises: one TOML file with a table for each ([ball]), every key of which has a
// default. docs/rehab.md lists them.
// Failure: all mistakes of a file are reported together, each with its line and the remedy; an unknown key with the
// nearest that there is. Pure but for reading the file; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/ball_exercise.hpp"

namespace burin::activities {

struct RehabSettings {
    BallSettings ball;
    bool operator==(const RehabSettings&) const = default;
};

struct ReadSettings {
    RehabSettings settings;
    std::vector<Error> errors;  // empty: all is sound
};
// Reads a text; `name` stands for the file in messages.
[[nodiscard]] ReadSettings parse_rehab_settings(std::string_view text, const std::string& name);
// Writes them as such a file.
[[nodiscard]] std::string settings_text(const RehabSettings& settings);

}  // namespace burin::activities
