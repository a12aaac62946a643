// SPDX-License-Identifier: MIT
// A session's streams against a library that stands in for liblsl and is as strict as its header: what goes out, what
// comes in, and a library that is slow, refuses, or does not return.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "session/stream/stream_text.hpp"
#include "tests/session/stream/stand_in.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kMillisecond_ns = 1'000'000;

std::unique_ptr<LslStreams> opened_streams(StandInLsl& library, Clock& clock, StreamPlan plan) {
    plan.source = "burin-test";
    auto streams = LslStreams::open(library.api, std::move(plan), clock);
    EXPECT_TRUE(streams) << streams.error().line();
    return streams ? std::move(*streams) : nullptr;
}

StreamPlan plan_of(std::vector<StreamedPart> parts) {
    StreamPlan plan;
    plan.parts = std::move(parts);
    return plan;
}

// Returns all messages so far, and waits for one with these words.
std::string told_by(LslStreams& streams, const std::string& words) {
    std::string all;
    for (int i = 0; i < 6000 && !all.contains(words); ++i) {
        for (const std::string& message : streams.take_messages()) all += message + "\n";
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(all.contains(words)) << all;
    return all;
}

std::vector<EventMark> markers_of(LslStreams& streams, std::size_t count) {
    std::vector<EventMark> all;
    for (int i = 0; i < 6000 && all.size() < count; ++i) {
        std::ranges::move(streams.take_markers(), std::back_inserter(all));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(all.size(), count);
    return all;
}

// Returns the channels' labels of a stream, each with its unit and type.
std::vector<std::string> channels_of(const test::LslStream& stream) {
    std::vector<std::string> all;
    const test::LslNode* const channels = stream.description->child("channels");
    for (std::size_t i = 0; channels != nullptr && i < channels->children.size(); ++i) {
        const test::LslNode& channel = *channels->children[i];
        all.push_back(channel.text_of("label") + "|" + channel.text_of("unit") + "|" + channel.text_of("type"));
    }
    return all;
}

std::size_t channel_called(const test::LslStream& stream, const std::string& label) {
    const std::vector<std::string> all = channels_of(stream);
    const auto found = std::ranges::find_if(all, [&](const auto& one) { return one.starts_with(label + "|"); });
    EXPECT_NE(found, all.end()) << label;
    return static_cast<std::size_t>(found - all.begin());
}

}  // namespace

TEST(LslStreams, AStreamOfTicksSaysWhatItsChannelsAre) {
    StandInLsl library;
    MonotonicClock clock;
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right")}));
    const auto ticks = library.outlet("Burin ticks right"), events = library.outlet("Burin events");
    EXPECT_EQ(ticks->type, "Haptics");
    EXPECT_EQ(ticks->rate_Hz, 1000.0);
    EXPECT_EQ(ticks->format, 1);
    EXPECT_EQ(ticks->source_id, "burin-test ticks right");
    const std::vector<std::string> channels = channels_of(*ticks);
    EXPECT_EQ(channels.size(), static_cast<std::size_t>(ticks->channels));
    for (const char* channel :
         {"tick||Index", "position_device_x_m|m|Position", "orientation_device_qw||Orientation", "buttons||Button",
          "desired_force_device_y_N|N|Force", "commanded_force_device_y_N|N|Force",
          "commanded_torque_device_z_Nm|Nm|Torque", "penetration0_m|m|Contact", "object0||Contact", "flags||Flags"})
        EXPECT_EQ(std::ranges::count(channels, channel), 1) << channel;
    EXPECT_EQ(ticks->description->child("device")->text_of("model"), "a stylus");
    EXPECT_FALSE(ticks->description->child("synchronization")->text_of("clock_offset_within_s").empty());
    EXPECT_EQ(events->type, "Markers");
    EXPECT_EQ(events->rate_Hz, 0.0);
    EXPECT_EQ(events->format, 3);
    EXPECT_EQ(events->channels, 1);
}

TEST(LslStreams, EveryTickGoesOutInOrderWithItsOwnTimeOnTheLibrarysClock) {
    StandInLsl library;
    library.lsl.clock_offset_s = 5000.0;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right")}));
    constexpr std::size_t kTicks = 3000;
    for (std::size_t i = 1; i <= kTicks; ++i)
        streams->tick(0, made_tick(i, begun_ns + static_cast<Nanoseconds>(i) * kMillisecond_ns));
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.ticks, kTicks);
    EXPECT_EQ(figures.dropped_ticks + figures.refused_ticks + figures.unordered, 0u);
    const auto ticks = library.outlet("Burin ticks right");
    ASSERT_EQ(ticks->stamps_s.size(), kTicks);
    const std::size_t tick = channel_called(*ticks, "tick"), x = channel_called(*ticks, "position_device_x_m"),
                      asked = channel_called(*ticks, "desired_force_device_y_N"),
                      given = channel_called(*ticks, "commanded_force_device_y_N");
    const auto channels = static_cast<std::size_t>(ticks->channels);
    // Both clocks are the machine's: what the offset is off by is the time of a reading of them, told with it.
    const double within_s = std::stod(ticks->description->child("synchronization")->text_of("clock_offset_within_s"));
    EXPECT_NEAR(ticks->stamps_s[0], seconds(begun_ns + kMillisecond_ns) + 5000.0, within_s + 1e-6);
    for (std::size_t i = 0; i < kTicks; ++i) {
        ASSERT_EQ(ticks->values[i * channels + tick], static_cast<float>(i + 1));
        ASSERT_EQ(ticks->values[i * channels + x], static_cast<float>(0.001 * static_cast<double>(i + 1)));
        ASSERT_EQ(ticks->values[i * channels + asked], 5.0f);
        ASSERT_EQ(ticks->values[i * channels + given], 3.3f);
        if (i == 0) continue;
        ASSERT_NEAR(ticks->stamps_s[i] - ticks->stamps_s[i - 1], 0.001, 1e-8);
        ASSERT_GT(ticks->stamps_s[i], ticks->stamps_s[i - 1]);
    }
}

TEST(LslStreams, ATickThatIsNoLaterThanTheOneBeforeIsLeftOutAndCounted) {
    StandInLsl library;
    MonotonicClock clock;
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right")}));
    for (const Nanoseconds time_ns : {1, 2, 2, 1, 3}) streams->tick(0, made_tick(1, time_ns * kMillisecond_ns));
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.ticks, 3u);
    EXPECT_EQ(figures.unordered, 2u);
    const std::vector<double> stamps_s = library.outlet("Burin ticks right")->stamps_s;
    EXPECT_TRUE(std::ranges::is_sorted(stamps_s));
}

TEST(LslStreams, TwoHandsHaveAStreamEach) {
    StandInLsl library;
    MonotonicClock clock;
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right"), stylus_part("left index")}));
    for (Nanoseconds i = 1; i <= 10; ++i) streams->tick(0, made_tick(1, i * kMillisecond_ns));
    for (Nanoseconds i = 1; i <= 7; ++i) streams->tick(1, made_tick(1, i * kMillisecond_ns));
    static_cast<void>(streams->close());
    EXPECT_EQ(library.outlet("Burin ticks right")->stamps_s.size(), 10u);
    EXPECT_EQ(library.outlet("Burin ticks left index")->stamps_s.size(), 7u);
    EXPECT_NE(library.outlet("Burin ticks right")->source_id, library.outlet("Burin ticks left index")->source_id);
}

TEST(LslStreams, EventsAndTrialsAreMarkersWithTheirTimes) {
    StandInLsl library;
    MonotonicClock clock;
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right")}));
    streams->event({10 * kMillisecond_ns, "touches", "bolt"});
    streams->trial({20 * kMillisecond_ns, "3", ""});
    streams->trial({30 * kMillisecond_ns, "", "done"});
    streams->event({40 * kMillisecond_ns, "paused", ""});
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.events, 4u);
    EXPECT_EQ(figures.dropped_events, 0u);
    const auto events = library.outlet("Burin events");
    EXPECT_EQ(events->texts,
              (std::vector<std::string>{"touches: bolt", "trial begins: 3", "trial ends: done", "paused"}));
    for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(events->stamps_s[i] - events->stamps_s[i - 1], 0.01, 1e-7);
}

TEST(LslStreams, NamesWithOddCharactersAreTextOfXml) {
    StandInLsl library;
    MonotonicClock clock;
    StreamedPart odd = stylus_part("a<b>&\"c'\x01\xff \xc3\xa4");
    odd.device.name = "pen\n\x7f";
    const auto streams = opened_streams(library, clock, plan_of({odd}));
    streams->event({kMillisecond_ns, "touches", "bolt\t\"5\"\xc0"});
    static_cast<void>(streams->close());
    const auto ticks = library.outlet("Burin ticks a<b>&\"c'   \xc3\xa4");
    EXPECT_EQ(ticks->description->child("device")->text_of("model"), "pen  ");
    EXPECT_EQ(library.outlet("Burin events")->texts, std::vector<std::string>{"touches: bolt \"5\" "});
}

TEST(LslStreams, ALibraryThatDoesNotTakeTicksInTimeLosesThemCountedAndToldAndGoesOn) {
    StandInLsl library;
    MonotonicClock clock;
    library.set([&] { library.lsl.blocks_pushes = true; });
    StreamPlan plan = plan_of({stylus_part("right")});
    plan.rows = 64;
    const auto streams = opened_streams(library, clock, std::move(plan));
    streams->tick(0, made_tick(1, kMillisecond_ns));
    library.wait_until([&] { return library.lsl.blocked == 1; });
    for (Nanoseconds i = 2; i <= 200; ++i) streams->tick(0, made_tick(1, i * kMillisecond_ns));
    EXPECT_TRUE(told_by(*streams, "ticks were dropped").contains("streams: 135 ticks were dropped"));
    library.set([&] { library.lsl.blocks_pushes = false; });
    library.wait_until([&] { return library.lsl.outlets[0]->stamps_s.size() == 65; });
    streams->tick(0, made_tick(1, 300 * kMillisecond_ns));
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.ticks, 66u);
    EXPECT_EQ(figures.dropped_ticks, 135u);
    EXPECT_FALSE(figures.is_left_behind);
}

TEST(LslStreams, ALibraryThatNeverReturnsIsLeftBehindAndTheSessionEnds) {
    StandInLsl library;
    MonotonicClock clock;
    library.set([&] { library.lsl.blocks_pushes = true; });
    StreamPlan plan = plan_of({stylus_part("right")});
    plan.patience_ns = 20 * kMillisecond_ns;
    {
        const auto streams = opened_streams(library, clock, std::move(plan));
        streams->tick(0, made_tick(1, kMillisecond_ns));
        library.wait_until([&] { return library.lsl.blocked == 1; });
        for (Nanoseconds i = 2; i <= 50; ++i) streams->tick(0, made_tick(1, i * kMillisecond_ns));
        streams->event({kMillisecond_ns, "touches", "bolt"});
        const StreamFigures figures = streams->close();
        EXPECT_TRUE(figures.is_left_behind);
        EXPECT_EQ(figures.ticks, 0u);
        EXPECT_EQ(figures.dropped_ticks, 50u);
        EXPECT_EQ(figures.dropped_events, 1u);
        EXPECT_TRUE(figures.text().contains("does not return")) << figures.text();
    }
    // What it works on lives on without the session: it takes up its work where it is let go.
    library.set([&] { library.lsl.blocks_pushes = false; });
    library.wait_until(
        [&] { return std::ranges::none_of(library.lsl.outlets, [](const auto& one) { return one->is_open; }); });
    EXPECT_EQ(library.outlet("Burin ticks right")->stamps_s.size(), 50u);
}

TEST(LslStreams, AnOutletThatIsNotMadeIsAnErrorWithTheLibrarysReason) {
    StandInLsl library;
    MonotonicClock clock;
    library.set([&] { library.lsl.refuses_outlets = true; });
    const auto streams = LslStreams::open(library.api, plan_of({stylus_part("right")}), clock);
    ASSERT_FALSE(streams);
    EXPECT_TRUE(streams.error().line().contains("Burin ticks right")) << streams.error().line();
    EXPECT_TRUE(streams.error().line().contains("no port is free")) << streams.error().line();
}

TEST(LslStreams, APushThatIsRefusedIsCountedAndToldOnce) {
    StandInLsl library;
    MonotonicClock clock;
    library.set([&] { library.lsl.refuses_pushes = true; });
    const auto streams = opened_streams(library, clock, plan_of({stylus_part("right")}));
    for (Nanoseconds i = 1; i <= 20; ++i) streams->tick(0, made_tick(1, i * kMillisecond_ns));
    EXPECT_TRUE(told_by(*streams, "refuses ticks").contains("a push is refused"));
    streams->event({kMillisecond_ns, "touches", "bolt"});
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.ticks, 0u);
    EXPECT_EQ(figures.refused_ticks, 20u);
    EXPECT_EQ(figures.dropped_events, 1u);
}

TEST(LslStreams, MarkersComeInOnTheSessionsClockAndItsOwnEventsDoNot) {
    StandInLsl library;
    library.lsl.clock_offset_s = -1000.0;
    MonotonicClock clock;
    const auto keyboard = library.remote("Keyboard"), pair = library.remote("Pair", 2);
    StreamPlan plan = plan_of({stylus_part("right")});
    plan.markers = marker_predicate("").value();
    const Nanoseconds now_ns = clock.now_ns();
    library.set([&] {
        keyboard->correction_s = 500.0;  // its sender's clock is so much behind this machine's
        keyboard->waiting.push_back({seconds(now_ns) - 1000.0 - 500.0, {"go"}});
        keyboard->waiting.push_back({seconds(now_ns) - 1000.0 - 500.0 + 0.25, {"odd\x01 \xfftext"}});
        pair->waiting.push_back({seconds(now_ns) - 1000.0, {"left", "42"}});
    });
    const auto streams = opened_streams(library, clock, std::move(plan));
    streams->event({now_ns, "touches", "bolt"});
    std::vector<EventMark> markers = markers_of(*streams, 3);
    std::ranges::stable_sort(markers, {}, &EventMark::value);
    EXPECT_EQ(markers[0].value, "Keyboard: go");
    EXPECT_EQ(markers[1].value, "Keyboard: odd   text");
    EXPECT_EQ(markers[2].value, "Pair: left 42");
    for (const EventMark& marker : markers) EXPECT_EQ(marker.name, kMarkerEvent);
    EXPECT_NEAR(seconds(markers[0].time_ns - now_ns), 0.0, 1e-4);
    EXPECT_NEAR(seconds(markers[1].time_ns - markers[0].time_ns), 0.25, 1e-6);
    EXPECT_NEAR(seconds(markers[2].time_ns - now_ns), 0.0, 1e-4);
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.markers, 3u);
    EXPECT_EQ(figures.events, 1u);
    EXPECT_EQ(library.outlet("Burin events")->inlets, 0);
}

TEST(LslStreams, AMarkerWithoutASoundStampSaysSo) {
    StandInLsl library;
    MonotonicClock clock;
    const auto odd = library.remote("Odd");
    StreamPlan plan;
    plan.markers = marker_predicate("Odd").value();
    const Nanoseconds now_ns = clock.now_ns();
    library.set([&] {
        odd->has_correction = false;
        odd->waiting.push_back({seconds(now_ns), {"a"}});
        odd->waiting.push_back({1e9, {"b"}});
        odd->waiting.push_back({std::numeric_limits<double>::quiet_NaN(), {"c"}});
    });
    const auto streams = opened_streams(library, clock, std::move(plan));
    const std::vector<EventMark> markers = markers_of(*streams, 3);
    ASSERT_EQ(markers.size(), 3u);
    EXPECT_EQ(markers[0].value, "Odd: a (by its sender's clock)");
    EXPECT_EQ(markers[1].value, "Odd: b (stamped when it came)");
    EXPECT_EQ(markers[2].value, "Odd: c (stamped when it came)");
    for (const EventMark& marker : markers) EXPECT_GE(marker.time_ns, now_ns - kMillisecond_ns);
    static_cast<void>(streams->close());
}

TEST(LslStreams, AStreamOfMarkersThatIsLostIsToldAndOneWithTooManyValuesIsLeftOut) {
    StandInLsl library;
    MonotonicClock clock;
    const auto keyboard = library.remote("Keyboard"), wide = library.remote("Wide", 33);
    StreamPlan plan;
    plan.markers = marker_predicate("").value();
    const auto streams = opened_streams(library, clock, std::move(plan));
    library.set([&] { wide->waiting.push_back({1.0, {"x"}}); });
    const std::string told = told_by(*streams, "markers of Keyboard are heard");
    EXPECT_TRUE(told.contains("markers of Wide are not heard") ||
                told_by(*streams, "markers of Wide are not heard") != "");
    library.set([&] { keyboard->is_lost = true; });
    EXPECT_TRUE(told_by(*streams, "not heard any more").contains("the stream is gone"));
    static_cast<void>(streams->close());
}

TEST(LslStreams, MarkersThatNobodySendsAreToldOfByTheirPredicate) {
    StandInLsl library;
    MonotonicClock clock;
    StreamPlan plan;
    plan.markers = marker_predicate("Keybaord").value();
    const auto streams = opened_streams(library, clock, std::move(plan));
    EXPECT_TRUE(told_by(*streams, "no stream of markers is found").contains("Keybaord"));
    const StreamFigures figures = streams->close();
    EXPECT_EQ(figures.marker_streams, 0u);
    EXPECT_TRUE(figures.text().contains("0 markers heard since no stream of any was found")) << figures.text();
}

TEST(LslStreams, APredicateThatIsNoneIsRefused) {
    StandInLsl library;
    MonotonicClock clock;
    StreamPlan plan;
    plan.markers = marker_predicate("starts-with(name,'a'").value();
    const auto streams = LslStreams::open(library.api, std::move(plan), clock);
    ASSERT_FALSE(streams);
    EXPECT_TRUE(streams.error().line().contains("no XPath")) << streams.error().line();
}

}  // namespace burin::session
