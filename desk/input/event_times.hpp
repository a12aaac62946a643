// SPDX-License-Identifier: MIT
// Times of a window's events. Window systems tell them without one that the session's clock knows, and in batches: what
// has happened while a frame was drawn comes when the frame is done. A hand that is steered by the mouse needs to know
// when the mouse was where (devices/hand/steered_hand.hpp).
//
// Events that end a wait have just happened. A batch that lay ready has happened since events were asked for before: it
// is spread evenly over that time, but no farther apart than a moving mouse's reports are, back from now.
// A mouse that moves after a rest was where it rested until one report before: a motion to there is added, since the
// curve through its positions would begin where the rest began.
// Times are the session's. Thread: one.
//
// Samples of trackers have times of their own: in_order_of_time() puts them among a window's events, since
// InputSource::push() moves an event that comes after a later one to the time of that.
#pragma once

#include <optional>
#include <vector>

#include "session/input/input_event.hpp"

namespace burin::session {

class EventTimes {
public:
    // The longest time between two reports of a mouse that moves, and the shortest rest.
    static constexpr Nanoseconds kReport_ns = 16'000'000, kRest_ns = 50'000'000;
    // A wait that was shorter found events that lay ready.
    static constexpr Nanoseconds kAtOnce_ns = 1'000'000;

    // Returns the events of one look with their times. asked_ns: when the wait for them began; now_ns: when it ended.
    [[nodiscard]] std::vector<InputEvent> timed(std::vector<Input> told, Nanoseconds asked_ns, Nanoseconds now_ns);

private:
    Nanoseconds looked_ns_ = 0;        // when the look before ended
    std::optional<InputEvent> mouse_;  // its last motion
};

// Returns the events of both, in the order of their times; those of one time as they stand, the window's first.
[[nodiscard]] std::vector<InputEvent> in_order_of_time(std::vector<InputEvent> of_window,
                                                       std::vector<InputEvent> of_trackers);

}  // namespace burin::session
