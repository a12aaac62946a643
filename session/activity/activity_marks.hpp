// SPDX-License-Identifier: MIT
// What an activity and a session write into the recording: trials and events, as rows in words. Plain data.
#pragma once

#include <string>
#include <vector>

#include "base/clock.hpp"

namespace burin::session {

// A trial for the recording's table of trials, of which one is under way at a time.
struct TrialMark {
    Nanoseconds time_ns = 0;  // on the loop's clock
    std::string name;         // of one that begins; empty: the one under way ends
    std::string state = {};   // how it ended, in a word or two: "done", "given up"
};

// A row of the recording's table of events, in words: what happened, and of what.
struct EventMark {
    Nanoseconds time_ns = 0;  // on the loop's clock
    std::string name, value;
    bool operator==(const EventMark&) const = default;
};
// What an activity writes into the recording of its session besides its trials, in order.
struct ActivityRecord {
    std::vector<EventMark> events;
};

}  // namespace burin::session
