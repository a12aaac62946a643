// SPDX-License-Identifier: MIT
// Start, pause, rest and stop of an exercise: whether its clock goes on in a turn of the haptic loop, and for how long
// it has stood still.
//
//   ready --start--> runs --pause, rest--> paused, rests --start--> settles --all have let go--> runs
//   any of them --stop--> stopped
// While it is anything but `runs` and `settles` no force is given: what there was fades out. A force comes back from
// zero, and what the fingers press with counts from when they have let go of it. The clock that the exercise sees,
// exercise_ns(), stands still for as long as it does not run.
// Units: nanoseconds of the loop's clock, seconds. Pure; any thread.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/clock.hpp"
#include "base/error.hpp"

namespace burin::activities {

// The order of a person at the exercise; kRunOrders has their names.
enum class RunOrder : std::uint8_t { start, pause, rest, stop };
enum class RunPhase : std::uint8_t { ready, runs, paused, rests, settles, stopped };

struct RunControl {
    // After a break, before it is looked whether all have let go: longer than a force takes to fade in
    // (haptics::GateLimits: ramp_s and contact_ramp_s).
    static constexpr double kFadesIn_s = 0.3;

    RunPhase phase = RunPhase::runs;
    Nanoseconds last_ns = 0, away_ns = 0;  // the last turn, and how long it has stood still until then
    unsigned pauses = 0, rests = 0;
    double paused_s = 0.0, rested_s = 0.0, settles_s = 0.0;
    bool was_told = false;  // by any order, ever

    [[nodiscard]] bool runs() const { return phase == RunPhase::runs; }
    [[nodiscard]] bool gives_force() const { return phase == RunPhase::runs || phase == RunPhase::settles; }
    // Returns whether the order changes anything.
    [[nodiscard]] bool takes(RunOrder order) const;
    // Returns the time of a turn as the exercise sees it, and back.
    [[nodiscard]] Nanoseconds exercise_ns(Nanoseconds loop_ns) const { return loop_ns - away_ns; }
    [[nodiscard]] Nanoseconds loop_ns(Nanoseconds exercise_ns) const { return exercise_ns + away_ns; }
    bool operator==(const RunControl&) const = default;
};

// Fails where the order has no sense now; the Error says what has.
[[nodiscard]] Result<RunControl> with_order(RunControl control, RunOrder order);
// Goes on by a turn. let_go: no finger is pushed any more.
[[nodiscard]] RunControl with_turn(RunControl control, Nanoseconds now_ns, bool let_go);
[[nodiscard]] std::string_view name_of(RunOrder order);  // "pause", as a script has it

}  // namespace burin::activities
