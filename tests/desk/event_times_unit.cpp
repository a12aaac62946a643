// SPDX-License-Identifier: MIT
#include "desk/input/event_times.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

namespace burin::session {
namespace {

std::vector<Input> moves(int count, double from_px = 0.0) {
    std::vector<Input> told;
    for (int i = 0; i < count; ++i) told.emplace_back(MouseMove{{from_px + i, 0.0}});
    return told;
}

std::vector<Nanoseconds> times_of(const std::vector<InputEvent>& events) {
    std::vector<Nanoseconds> times;
    for (const InputEvent& event : events) times.push_back(event.time_ns);
    return times;
}

}  // namespace

TEST(EventTimes, SpreadsWhatLayReadyOverTheTimeSinceTheLookBefore) {
    EventTimes times;
    EXPECT_TRUE(times.timed({}, 900 * kMs, 1000 * kMs).empty());
    // While a frame was drawn for 40 ms, four motions happened.
    EXPECT_EQ(times_of(times.timed(moves(4), 1040 * kMs, 1040 * kMs)),
              (std::vector<Nanoseconds>{1010 * kMs, 1020 * kMs, 1030 * kMs, 1040 * kMs}));
}

TEST(EventTimes, LetsAMovingMouseReportAtLeastEvery16Milliseconds) {
    EventTimes times;
    static_cast<void>(times.timed({}, 0, 1000 * kMs));
    EXPECT_EQ(times_of(times.timed(moves(3), 1400 * kMs, 1400 * kMs)),
              (std::vector<Nanoseconds>{1368 * kMs, 1384 * kMs, 1400 * kMs}));
}

TEST(EventTimes, WhatEndsAWaitHasJustHappened) {
    EventTimes times;
    static_cast<void>(times.timed({}, 0, 1000 * kMs));
    EXPECT_EQ(times_of(times.timed(moves(2), 1001 * kMs, 1009 * kMs)),
              (std::vector<Nanoseconds>{1009 * kMs, 1009 * kMs}));
}

TEST(EventTimes, SaysWhereAMouseRestedBeforeItMovesOn) {
    EventTimes times;
    static_cast<void>(times.timed(moves(1, 7.0), 990 * kMs, 1000 * kMs));
    const std::vector<InputEvent> soon = times.timed(moves(1, 8.0), 1020 * kMs, 1040 * kMs);
    ASSERT_EQ(soon.size(), 1u);
    const std::vector<InputEvent> later = times.timed(moves(1, 9.0), 1050 * kMs, 1300 * kMs);
    ASSERT_EQ(later.size(), 2u);
    EXPECT_EQ(later[0], (InputEvent{1284 * kMs, MouseMove{{8.0, 0.0}}}));
    EXPECT_EQ(later[1], (InputEvent{1300 * kMs, MouseMove{{9.0, 0.0}}}));
}

TEST(EventTimes, KeepsTheOrderOfAllKindsOfEvents) {
    EventTimes times;
    static_cast<void>(times.timed({}, 0, 1000 * kMs));
    std::vector<Input> told = moves(1);
    told.emplace_back(MouseClick{});
    told.emplace_back(MouseMove{{5.0, 0.0}});
    const std::vector<InputEvent> events = times.timed(std::move(told), 1030 * kMs, 1030 * kMs);
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(times_of(events), (std::vector<Nanoseconds>{1010 * kMs, 1020 * kMs, 1030 * kMs}));
    EXPECT_TRUE(std::holds_alternative<MouseClick>(events[1].input));
}

// A window tells in one batch what has happened since the last; samples of trackers come between.
TEST(EventTimes, OfTrackersLieAmongThoseOfTheWindow) {
    const std::vector<InputEvent> of_window{{1000 * kMs, MouseMove{}}, {1016 * kMs, MouseClick{}}};
    const std::vector<InputEvent> of_trackers{{1008 * kMs, HeadInput{}}, {1016 * kMs, HeadInput{}}};
    const std::vector<InputEvent> all{of_window[0], of_trackers[0], of_window[1], of_trackers[1]};
    EXPECT_EQ(in_order_of_time(of_window, of_trackers), all);
    EXPECT_EQ(in_order_of_time({}, of_trackers), of_trackers);
    EXPECT_EQ(in_order_of_time(of_window, {}), of_window);
}

}  // namespace burin::session
