// SPDX-License-Identifier: MIT
// The assessment: what a hand can do, measured one thing after the other, each as it is instructed. A pure step from
// the turns of the haptic loop to a baseline.
//
//   range          open and close the whole hand, 12 s: how far each joint goes, by angles that were held for 50 ms
//   strength       three presses of 5 s with all fingers: each tip is drawn to where it was when the press began, by a
//                  spring up to a bound; a finger's strength is the most that its force stayed above for 0.25 s
//   speed          open and close as fast as possible, 8 s: of the sum of the bending joints, over 50 ms each
//   fractionation  bend one finger alone, 8 s, thumb to ring one by one
// Before each part the person has kReads_s to read what comes; with four fingers it takes 94 s.
// Fractionation is the individuation index of an instructed finger j, over the time of its part: 1 - mean over the
// other fingers i of |S_ij|, S_ij the slope of the least-squares line of i's flexion over j's (Schieber 1991,
// "Individuated finger movements of rhesus monkeys", J Neurophysiol 65(6), 1381-1391; there of one movement's samples).
// 1: the others are still; 0: they go as far. It is below 0 where they go farther than the instructed one. Nothing is
// told of a finger that has moved by less than kMoved_rad when it was asked to.
// Strength is of measured forces where the device measures, else of those that it was told to give.
// Units: newtons, radians, seconds; times of the loop's clock in nanoseconds. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise/exercise.hpp"

namespace burin::activities {

enum class AssessTask : std::uint8_t { range, press, speed, alone };

struct AssessPart {
    AssessTask task = AssessTask::range;
    std::size_t finger = 0;   // of `alone`
    double lasts_s = 0.0;     // after kReads_s
    std::string_view begins;  // the event of its measured time's beginning, a literal
};
inline constexpr std::size_t kAssessParts = 9;
inline constexpr double kReads_s = 3.0;
[[nodiscard]] const std::array<AssessPart, kAssessParts>& assess_parts();
// Returns when a part's measured time begins, since the assessment did; of kAssessParts, when all is over and kReads_s.
[[nodiscard]] double assess_begins_s(std::size_t part);

// The most that a force stayed above for kFor_s, in steps of a fifth of that.
struct HeldForce {
    static constexpr double kFor_s = 0.25;
    static constexpr std::size_t kSteps = 5;
    std::array<double, kSteps> least_N{};  // of each step; the last is under way
    std::size_t begun = 0;
    double step_s = 0.0, most_N = 0.0;
    bool was_held = false;  // for kFor_s at all, by whatever force
    bool operator==(const HeldForce&) const = default;
};
[[nodiscard]] HeldForce with_force(HeldForce held, double force_N, double dt_s);
// Begins anew after a gap, and keeps the most.
[[nodiscard]] HeldForce after_gap(HeldForce held);

// Sums for the slopes over the instructed finger's flexion, each turn by its time.
struct AloneSums {
    double time_s = 0.0, least_rad = 0.0, most_rad = 0.0;                      // of the instructed finger
    std::array<double, devices::kGloveFingers> mean_rad{}, with_instructed{};  // with_instructed: sum of products
    bool operator==(const AloneSums&) const = default;
};

struct AssessState {
    static constexpr double kMoved_rad = 0.1;
    static constexpr double kGap_s = 0.05;

    std::size_t part = 0;  // kAssessParts: it has ended
    bool measures = false;
    ExerciseEnd end = ExerciseEnd::not_yet;
    bool begun = false;
    Nanoseconds begun_ns = 0, last_ns = 0;
    Nanoseconds again_ns = 0;  // that parts took which a break has put back
    HandMeasures range, speed;
    std::array<HeldForce, devices::kGloveFingers> strength{};
    HeldForce together;
    std::array<HeldForce, devices::kGloveFingers> strength_before{};  // this part, which may be put back
    HeldForce together_before;
    std::array<AloneSums, devices::kGloveFingers> alone{};

    [[nodiscard]] double time_s() const { return seconds(last_ns - begun_ns); }
    // Returns how far it has come in the order of its parts.
    [[nodiscard]] double course_s() const { return seconds(last_ns - begun_ns - again_ns); }
    bool operator==(const AssessState&) const = default;
};

struct AssessStep {
    AssessState state;
    std::vector<ExerciseEvent> events;
};
// Goes on by a turn. Requires a time that rises; an assessment that has ended stays as it is.
[[nodiscard]] AssessStep step_assessment(AssessState state, const ExerciseTurn& turn);

inline constexpr std::string_view kPartInterrupted = "interrupted";
// Puts back the part that is under way, since the person pauses: it begins anew with the time to read, and what it has
// measured is forgotten. What other parts have measured stays.
[[nodiscard]] AssessStep interrupted(AssessState state, Nanoseconds time_ns);

// Holds the measures of one finger; a measure that could not be taken is empty.
struct AssessedFinger {
    std::array<std::optional<double>, devices::kFingerJoints> range_rad{};
    std::optional<double> open, closed;  // closures
    std::optional<double> strength_N, peak_rad_per_s, mean_rad_per_s, fractionation;
};
struct Assessed {
    std::array<AssessedFinger, devices::kGloveFingers> fingers{};
    std::optional<double> together_N;    // all fingers' strength at once
    std::optional<double> open, closed;  // the mean of the fingers' closures
    // Returns how many of its nine parts have given a measure of each finger that they are of.
    [[nodiscard]] unsigned measured_parts() const;
};
[[nodiscard]] Assessed assessed(const AssessState& state);

// Returns a part's instruction, for the person.
[[nodiscard]] std::string instruction_of(const AssessPart& part);

}  // namespace burin::activities
