// SPDX-License-Identifier: MIT
// The putty (G13): it is kneaded again and again, a ball between thumb and index, an ellipsoid in the whole hand. A
// pure step from the turns of the haptic loop to what is counted.
//
//   waits -> pressed with kTried of the target -> presses -> with the target or more for kGrips_s, in the grip that is
//   asked for: a knead -> relaxes to kRelaxed of the target -> waits
// Who relaxes before that has pressed too weakly, or, where the target was reached, in a wrong grip: each is counted.
// The grip is seen by the fingers that press with kTakesPart_N or more: thumb and index alone, or all four.
// It ends with the last knead, or with the time limit.
// Units: newtons, seconds; times of the loop's clock in nanoseconds. No heap but for the events; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise/exercise.hpp"
#include "activities/rehab/exercise/person_range.hpp"
#include "base/clock.hpp"

namespace burin::activities {

enum class PuttyShape : std::uint8_t { ball, ellipsoid };
enum class PuttyHardness : std::uint8_t { soft, medium, firm };

// Hardnesses of putty. No figures of therapists' putty are published, so these are ours: each is twice the one before.
struct PuttyKind {
    double young_Pa = 0.0, yield_Pa = 0.0;
    std::array<double, 3> srgb{};  // 0 to 1
};
[[nodiscard]] const PuttyKind& kind_of(PuttyHardness hardness);

struct PuttySettings {
    // By level: the sum of the forces of the fingers that the grip takes.
    static constexpr std::array<double, 3> kPinch_N{1.5, 2.5, 3.5}, kWhole_N{3.0, 5.0, 7.0};
    static constexpr std::array<double, 3> kOfMost{0.25, 0.5, 0.75};  // or of the person's most force in that grip

    PuttyShape shape = PuttyShape::ball;
    PuttyHardness hardness = PuttyHardness::medium;
    unsigned level = 1;  // of difficulty; 1 to 3
    unsigned kneads = 5;
    double time_limit_s = 60.0;

    [[nodiscard]] bool is_pinch() const { return shape == PuttyShape::ball; }
    double most_N = 0.0;  // that the person presses with in that grip; 0: not known

    [[nodiscard]] double target_N() const {
        return fitted_target_N((is_pinch() ? kPinch_N : kWhole_N)[level - 1], kOfMost[level - 1], most_N);
    }
    bool operator==(const PuttySettings&) const = default;
};

enum class PuttyPhase : std::uint8_t { begins, waits, presses, relaxes, ended };

struct PuttyState {
    static constexpr double kTried = 0.5, kRelaxed = 0.25, kTakesPart_N = 0.15, kGrips_s = 0.2;

    PuttyPhase phase = PuttyPhase::begins;
    ExerciseEnd end = ExerciseEnd::not_yet;
    Nanoseconds begun_ns = 0, last_ns = 0;
    unsigned kneads = 0, too_weak = 0, wrong_grip = 0;
    bool reached = false;  // the target, since it was pressed
    double right_s = 0.0;  // for how long it has been reached in the right grip
    double force_N = 0.0;  // of all fingers, in the last turn

    [[nodiscard]] double time_s() const { return seconds(last_ns - begun_ns); }
    bool operator==(const PuttyState&) const = default;
};

namespace putty_event {
inline constexpr std::string_view kBegun = "begun", kPressed = "pressed", kKneaded = "kneaded",
                                  kWrongGrip = "wrong grip", kTooWeak = "too weak", kDone = "done",
                                  kTimeOver = "time over", kInterrupted = "interrupted";
}

struct PuttyStep {
    PuttyState state;
    std::vector<ExerciseEvent> events;
};
// Goes on by a turn. Requires sound settings and a time that rises; an exercise that has ended stays as it is.
[[nodiscard]] PuttyStep step_putty(PuttyState state, const PuttySettings& settings, const ExerciseTurn& turn);

// Breaks off a knead that is under way, which counts for nothing.
[[nodiscard]] PuttyStep interrupted(PuttyState state, Nanoseconds time_ns);

// From 0 to 100: the share of the kneads that were done, less a tenth of one for each too weak or in a wrong grip.
[[nodiscard]] double score_of(const PuttyState& state, const PuttySettings& settings);

}  // namespace burin::activities
