// SPDX-License-Identifier: MIT
// The exercises that there are. One more is a line in exercise_kinds.cpp: its command, its settings' table, its place
// in recordings and in reports follow.
// Pure; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "activities/rehab/exercise/exercise.hpp"
#include "activities/rehab/exercise/simulated_person.hpp"

namespace burin::activities {

struct ExerciseKind {
    const char* name = "";  // "ball"
    const char* help = "";
    const char* world = "";   // a file among the assets (base/assets.hpp), named by its room and its name
    const char* script = "";  // how a simulated hand does it, likewise
    std::span<const SettingKind> settings;
    // Requires sound values.
    std::unique_ptr<Exercise> (*make)(const SettingValues& values) = nullptr;
    // Returns the script as a scripted participant follows it, drawn from a seed.
    std::string (*scripted)(const SettingValues& values, std::uint64_t seed, std::string_view script) = nullptr;
    // Returns what cannot be met together, of values that are sound each by itself. Recordings that there are may have
    // it; new runs are refused.
    std::optional<Error> (*conflict)(const SettingValues& values) = nullptr;
    // Returns how a simulated glove has to close for it (devices/gloves/grip_shape.hpp); null: as it usually does.
    std::string_view (*grip)(const SettingValues& values) = nullptr;
    // Returns how a simulated glove leads each finger of a person (devices/gloves/finger_course.hpp), as the text of a
    // file; null: a button closes the hand.
    std::string (*course)(SimulatedPerson person) = nullptr;
};
[[nodiscard]] std::span<const ExerciseKind> exercise_kinds();
// Returns null where there is none of that name.
[[nodiscard]] const ExerciseKind* exercise_named(std::string_view name);
// Returns how many levels of difficulty an exercise has; 0 where there is none of that name.
[[nodiscard]] unsigned levels_of(std::string_view exercise);

// Reads what Rehab::settings() has written, "rehab ball --level 2 ...". Fails on anything else.
[[nodiscard]] Result<std::unique_ptr<Exercise>> exercise_of(std::string_view settings);

// Reads the settings of one exercise in a therapist's file, whose name stands in messages. All its tables are checked.
struct ReadSettings {
    SettingValues values;
    std::vector<Error> errors;  // empty: all is sound
};
[[nodiscard]] ReadSettings read_settings(std::string_view text, const std::string& name, const ExerciseKind& of);

}  // namespace burin::activities
