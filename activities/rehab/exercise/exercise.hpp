// SPDX-License-Identifier: MIT
// An exercise, as the session's activity runs it (activities/rehab/rehab.hpp): the body that the hand works on, what a
// turn of the loop makes of it, and how it went. Its rules are a pure step beside it
// (activities/rehab/ball/ball_exercise.hpp).
//
//   turn of the loop -> turn() -> messages, trials -> course(): counts, score, events -> report, panel, results
// Frame: the scene's. One thread, the frame's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise/exercise_settings.hpp"
#include "activities/rehab/measures/hand_measures.hpp"
#include "activities/rehab/measures/start_check.hpp"
#include "base/clock.hpp"
#include "base/json.hpp"
#include "bodies/soft_part.hpp"
#include "haptics/tick_parameters.hpp"
#include "session/activity/activity.hpp"

namespace burin::activities {

// A turn of the haptic loop, as exercises see it.
struct ExerciseTurn {
    Nanoseconds time_ns = 0;  // of the loop's clock
    bool grasped = false;     // the body, by any gesture of grasping
    FingersTurn fingers;
    Similarity scene_from_hand = {};  // of the hand that the joints tell
    double closure = 0.0;             // the mean of the fingers', as a share of the person's way (PersonRange)
    std::optional<Vec3> lies_in_palm_m = std::nullopt;  // of a held body's middle, by its newest shape
    // Each fingertip, the middle of its points, in the frame in which ticks touch.
    std::array<Vec3, devices::kGloveFingers> tips_object_m = {};
    Nanoseconds away_ns = 0;  // for how long its clock has stood still: the loop's is time_ns + away_ns
};

enum class ExerciseEnd : std::uint8_t { not_yet, done, time_over };
[[nodiscard]] std::string_view text_of(ExerciseEnd end);  // "broken off" where it has not ended

struct ExerciseEvent {
    std::string_view what;  // a literal: "force reached"
    Nanoseconds time_ns = 0;
    double force_N = 0.0;  // the sum of the fingers' then
    bool operator==(const ExerciseEvent&) const = default;
};

// The course of an exercise until now.
struct ExerciseCourse {
    struct Count {
        const char* key = "";             // in a report: "held_too_short"
        const char* name = "";            // for people: "Held too short"
        unsigned number = 0, wanted = 0;  // wanted 0: it was not asked for
    };
    ExerciseEnd end = ExerciseEnd::not_yet;
    Nanoseconds begun_ns = 0;  // of the loop's clock
    double time_s = 0.0;       // since then
    double score = 0.0;        // 0 to 100
    std::vector<Count> counts;
    std::vector<ExerciseEvent> events;
    std::vector<std::string> notes = {};  // what did not count and why, a sentence each
};

// Tells the screen what the person is to do next, and how far that is done.
struct ExerciseGoal {
    double together_N = 0.0, now_N = 0.0;  // of all fingers: asked, and as the rules see it; 0: none is asked
    double of_each_N = 0.0;                // asked of each finger that presses; 0: none
    double hold_s = 0.0, held_s = 0.0;
    std::string next;      // "Squeeze"
    std::string progress;  // "2 of 5"
};

class Exercise {
public:
    Exercise() = default;
    virtual ~Exercise() = default;
    Exercise(const Exercise&) = delete;
    Exercise& operator=(const Exercise&) = delete;

    [[nodiscard]] virtual const char* name() const = 0;  // "ball", as its kind has it
    [[nodiscard]] virtual const SettingValues& settings() const = 0;

    // Returns whether it has a body at all; then what follows of one is not asked.
    [[nodiscard]] virtual bool has_body() const { return true; }
    // The body that takes the place of the world's object of that number, and its colour.
    [[nodiscard]] virtual bodies::SoftPartSetup body() const = 0;
    [[nodiscard]] virtual std::array<double, 3> srgb() const = 0;
    // Returns whether a hand that grasps the body carries it, and the body falls when it is let go of. Otherwise it
    // stays at its place.
    [[nodiscard]] virtual bool is_carried() const { return false; }
    // Returns the fingers that press in it, which its start asks for.
    [[nodiscard]] virtual WhichFingers pressing_fingers() const { return {true, true, true, true}; }
    // Returns the force that they are to reach together; 0: none is asked.
    [[nodiscard]] virtual double target_N() const { return 0.0; }
    // Returns how a desk leads the hand of a glove, where that is not as usual.
    [[nodiscard]] virtual std::optional<session::LedHand> led_hand() const { return std::nullopt; }
    // Called once, when the body has taken the place of the world's object. An exercise that moves its body by itself
    // keeps it, and orders what becomes of it by orders.on_scene alone: the body is the scene's thread's.
    virtual void begin(bodies::SoftPart& /*body*/, session::ActivityOrders& /*orders*/) {}

    // Changes the parameters of a fingertip's next ticks. Asked again after a turn that orders so.
    virtual void adjust(std::size_t /*finger*/, haptics::TickParameters& /*parameters*/) const {}

    // Goes on by a turn; whatever comes after the end changes nothing.
    virtual void turn(const ExerciseTurn& turn, session::ActivityOrders& orders) = 0;
    // Breaks off what is under way, such as a squeeze, since the person pauses: it counts for nothing. What has been
    // counted stays. time_ns: as turns have it.
    virtual void interrupt(Nanoseconds /*time_ns*/, session::ActivityOrders& /*orders*/) {}
    [[nodiscard]] virtual ExerciseGoal goal() const { return {}; }
    [[nodiscard]] virtual ExerciseEnd end() const = 0;
    [[nodiscard]] virtual ExerciseCourse course() const = 0;
    [[nodiscard]] virtual std::string task() const = 0;  // for the person: a sentence or two
    // Returns what it has found besides, for the report, under its name; null: nothing.
    [[nodiscard]] virtual Json findings() const { return {}; }
    // Returns the person's range (person_range.hpp) where the exercise measures it by itself.
    [[nodiscard]] virtual std::optional<Json> person_range() const { return std::nullopt; }
    // Returns what it is for, what counts, and what does not: a paragraph each.
    [[nodiscard]] virtual std::vector<std::string> help() const { return {}; }
};

}  // namespace burin::activities
