// SPDX-License-Identifier: MIT
// Trackers: what a queue that nobody empties keeps, and the registry. What comes over the network is tested with the
// lines of the input log (tests/desk/session_tracker_unit.cpp).
#include "devices/trackers/tracker.hpp"

#include <gtest/gtest.h>

#include <set>

namespace burin::devices {
namespace {

TrackerSample head_at(Nanoseconds time_ns) {
    return {time_ns, HeadInput{{{static_cast<double>(time_ns), 0.0, 0.0}, Quat{1, 0, 0, 0}}, true}};
}
TrackerSample click_at(Nanoseconds time_ns, bool pressed) { return {time_ns, WandClick{0, 0, pressed}}; }

}  // namespace

TEST(TrackerQueue, GivesSamplesInTheOrderOfTheirArrivalOnce) {
    TrackerQueue queue;
    for (Nanoseconds t = 0; t < 3; ++t) EXPECT_TRUE(queue.push(head_at(t)));
    const auto taken = queue.take();
    ASSERT_EQ(taken.size(), 3u);
    for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i].time_ns, static_cast<Nanoseconds>(i));
    EXPECT_TRUE(queue.take().empty());
}

TEST(TrackerQueue, KeepsTheNewestPosesWhenItIsFull) {
    TrackerQueue queue;
    constexpr Nanoseconds kPushed = 3 * static_cast<Nanoseconds>(TrackerQueue::kMost);
    std::uint64_t dropped = 0;
    for (Nanoseconds t = 0; t < kPushed; ++t) dropped += queue.push(head_at(t)) ? 0 : 1;
    const auto kept = queue.take();
    ASSERT_EQ(kept.size(), TrackerQueue::kMost);
    EXPECT_EQ(kept.back().time_ns, kPushed - 1);
    EXPECT_EQ(kept.front().time_ns, kPushed - static_cast<Nanoseconds>(TrackerQueue::kMost));
    EXPECT_EQ(dropped, static_cast<std::uint64_t>(kPushed) - TrackerQueue::kMost);
    EXPECT_TRUE(queue.push(head_at(0))) << "there is room again";
}

// A release that is lost would leave a stroke going.
TEST(TrackerQueue, DropsNoButtonForAPose) {
    TrackerQueue queue;
    EXPECT_TRUE(queue.push(click_at(0, true)));
    for (Nanoseconds t = 1; t <= 10'000; ++t) static_cast<void>(queue.push(head_at(t)));
    static_cast<void>(queue.push(click_at(10'001, false)));
    for (Nanoseconds t = 10'002; t <= 20'000; ++t) static_cast<void>(queue.push(head_at(t)));
    const auto kept = queue.take();
    ASSERT_EQ(kept.size(), TrackerQueue::kMost);
    EXPECT_EQ(kept[0].input, TrackerInput(WandClick{0, 0, true}));
    EXPECT_EQ(kept[1].input, TrackerInput(WandClick{0, 0, false}));
    EXPECT_EQ(kept.back().time_ns, 20'000);
}

TEST(TrackerQueue, IsBoundedByButtonsAloneToo) {
    TrackerQueue queue;
    for (Nanoseconds t = 0; t < 5000; ++t) static_cast<void>(queue.push(click_at(t, t % 2 == 0)));
    const auto kept = queue.take();
    ASSERT_EQ(kept.size(), TrackerQueue::kMost);
    EXPECT_EQ(kept.back().time_ns, 4999);
}

TEST(TrackerRegistry, NamesEachKindOnceAndInItsUsage) {
    std::set<std::string_view> schemes;
    ASSERT_FALSE(tracker_kinds().empty());
    for (const TrackerKind& kind : tracker_kinds()) {
        EXPECT_TRUE(schemes.insert(kind.scheme).second) << kind.scheme;
        EXPECT_TRUE(kind.usage.starts_with(std::string(kind.scheme) + ":")) << kind.usage;
        EXPECT_TRUE(tracker_usage().contains(kind.usage));
        EXPECT_NE(kind.open, nullptr);
    }
}

TEST(TrackerRegistry, RefusesWhatItDoesNotKnowAndNamesWhatThereIs) {
    MonotonicClock clock;
    for (const char* where : {"", ":", "udp", "opentrack:4242", "UDP:5005"}) {
        const auto opened = open_tracker(where, {clock, {}, {}});
        ASSERT_FALSE(opened) << where;
        EXPECT_TRUE(opened.error().line().contains(tracker_usage())) << opened.error().line();
    }
}

}  // namespace burin::devices
