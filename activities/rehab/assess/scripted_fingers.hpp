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

// How far it closes (1: a grasp of the whole hand), how far the other fingers go with one that moves alone, how long
// one opening or closing takes where it is to be fast, and with what force each finger presses.
struct AssessedHand {
    double closes = 1.0, others_follow = 0.1, stroke_s = 0.25;
    std::array<double, devices::kGloveFingers> holds_N{2.5, 2.0, 2.0, 1.5};
};
[[nodiscard]] AssessedHand assessed_hand(SimulatedPerson person);
[[nodiscard]] devices::FingerCourse assess_course_of(const AssessedHand& hand);

// As exercise_kinds.hpp has them: the course, and the session's script, which ends it and takes pictures of its parts.
[[nodiscard]] std::string assess_course(SimulatedPerson person);
[[nodiscard]] std::string scripted_assess(const SettingValues& values, std::uint64_t seed, std::string_view script);

}  // namespace burin::activities
