// SPDX-License-Identifier: MIT
// The rubber ball (G11): it is grasped, squeezed to a force, held so for a time and let go, again and again. A pure
// step from the turns of the haptic loop to what is counted.
//
//   waiting -> grasped -> squeezing, the fingers' forces add up to the target, and each finger gives its share of it
//           -> held so for hold_s: a repetition
//           -> relaxed to kRelaxed of the target for kRelaxes_s, or let go -> the next
// Who lets the force, or a finger's share, sink below kKept of that before hold_s has passed has held too short: that
// is counted too, and the time begins anew. Where a finger has kept the target from counting for kUneven_s, that is
// told once a squeeze. It ends with the last repetition, or with the time limit.
// A force may adapt (activities/rehab/adapt/staircase.hpp): a repetition is a trial that has succeeded, one held too
// short has failed, and so has who presses with more than kRelaxed of the target and relaxes without having reached it.
// Units: newtons, seconds; times of the loop's clock in nanoseconds. No heap but for the events; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "activities/rehab/adapt/staircase.hpp"
#include "activities/rehab/exercise/exercise.hpp"
#include "activities/rehab/exercise/person_range.hpp"
#include "base/clock.hpp"

namespace burin::activities {

// The ball's colour says how stiff it is; from soft to hard.
enum class BallColour : std::uint8_t { yellow, red, green, blue };
struct BallKind {
    BallColour colour = BallColour::yellow;
    std::string_view name;
    std::array<double, 3> srgb{};  // 0 to 1
    double young_Pa = 0.0;
};
[[nodiscard]] std::array<BallKind, 4> ball_kinds();
[[nodiscard]] const BallKind& kind_of(BallColour colour);
[[nodiscard]] std::optional<BallColour> ball_named(std::string_view name);

struct BallSettings {
    static constexpr std::array<double, 3> kTargets_N{2.0, 4.0, 6.0};  // by level: the sum of the fingers' forces
    static constexpr std::array<double, 3> kOfMost{0.25, 0.5, 0.75};   // or of the person's most force

    BallColour colour = BallColour::red;
    unsigned level = 1;  // of difficulty; 1 to 3
    unsigned repetitions = 5;
    double hold_s = 1.0, time_limit_s = 60.0;
    double share = 0.1;  // of the target, that each finger gives at least; 0: the fingers reach it together

    double most_N = 0.0;  // that the person presses with; 0: not known

    std::optional<Staircase> adapts = std::nullopt;  // as it begins; none: the force stays

    [[nodiscard]] double target_N() const { return fitted_target_N(kTargets_N[level - 1], kOfMost[level - 1], most_N); }
    [[nodiscard]] double of_each_N() const { return share * target_N(); }
    bool operator==(const BallSettings&) const = default;
};

enum class BallPhase : std::uint8_t { begins, waits, holds, relaxes, ended };

struct BallState {
    static constexpr double kKept = 0.8, kRelaxed = 0.5;
    static constexpr double kUneven_s = 0.5;
    static constexpr double kRelaxes_s = 0.25;  // for so long, at least, or until it is let go of
    static constexpr double kSmooths_s = 0.03;  // a stiff ball that is let go of may push by fits of some milliseconds

    BallPhase phase = BallPhase::begins;
    ExerciseEnd end = ExerciseEnd::not_yet;
    Nanoseconds begun_ns = 0, last_ns = 0, held_since_ns = 0, pressed_ns = 0;
    unsigned repetitions = 0, too_short = 0, grasps = 0;
    bool grasped = false;
    double smooth_N = 0.0;            // the sum of the fingers' forces, over kSmooths_s
    FingerForces smooth_each_N{};     // each finger's, likewise
    Nanoseconds uneven_since_ns = 0;  // the sum has reached the target, and a finger its share not; 0: it is not so
    bool told_uneven = false;         // in this squeeze
    std::optional<Staircase> staircase = std::nullopt;  // of a force that adapts
    bool tried = false, spent = false;  // in this squeeze: pressed with kRelaxed of the target; has failed already
    unsigned too_weak = 0;              // where it adapts

    [[nodiscard]] double time_s() const { return seconds(last_ns - begun_ns); }
    [[nodiscard]] std::size_t weakest_finger() const;
    bool operator==(const BallState&) const = default;
};

// Names of the events of a ball exercise (ExerciseEvent::what).
namespace ball_event {
inline constexpr std::string_view kBegun = "begun", kGrasped = "grasped", kReached = "force reached",
                                  kCounted = "counted", kTooShort = "held too short", kTooWeak = "too weak",
                                  kUneven = "a finger gives too little", kLetGo = "let go", kDone = "done",
                                  kTimeOver = "time over", kInterrupted = "interrupted";
}  // namespace ball_event

// Returns the force that is asked of all fingers together: the level's, or where it has adapted to.
[[nodiscard]] double target_N_of(const BallState& state, const BallSettings& settings);

struct BallStep {
    BallState state;
    std::vector<ExerciseEvent> events;
};
// Goes on by a turn. Requires sound settings and a time that rises; an exercise that has ended stays as it is.
[[nodiscard]] BallStep step_ball(BallState state, const BallSettings& settings, const ExerciseTurn& turn);

// Breaks off a squeeze that is under way, which counts for nothing; the next begins from no force.
[[nodiscard]] BallStep interrupted(BallState state, Nanoseconds time_ns);

// From 0 to 100: the share of the repetitions that were done, less a tenth of one for each that was held too short.
[[nodiscard]] double score_of(const BallState& state, const BallSettings& settings);

}  // namespace burin::activities
