// SPDX-License-Identifier: MIT
// A simulated person's hand in the assessment: how each finger is led through its parts, so that what is to be measured
// follows from the course by a formula. Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "activities/rehab/exercise/exercise_settings.hpp"
#include "activities/rehab/exercise/simulated_person.hpp"
#include "devices/gloves/finger_course.hpp"

namespace burin::activities {

// Describes a simulated hand: how far it closes (1: a grasp of the whole hand), how far the other fingers follow one
// that moves alone, how long a fast opening or closing takes, and with what force each finger presses.
struct AssessedHand {
    double closes = 1.0, others_follow = 0.1, stroke_s = 0.25;
    std::array<double, devices::kGloveFingers> holds_N{2.5, 2.0, 2.0, 1.5};
};
[[nodiscard]] AssessedHand assessed_hand(SimulatedPerson person);
[[nodiscard]] devices::FingerCourse assess_course_of(const AssessedHand& hand);

// Make the fingers' course, and the script that ends the session and takes pictures of its parts (exercise_kinds.hpp).
[[nodiscard]] std::string assess_course(SimulatedPerson person);
[[nodiscard]] std::string scripted_assess(const SettingValues& values, std::uint64_t seed, std::string_view script);

}  // namespace burin::activities
