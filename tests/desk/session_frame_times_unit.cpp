// SPDX-License-Identifier: MIT
#include "desk/timing/frame_times.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace burin::session {
namespace {

Nanoseconds value(const FrameAges& ages, FrameFigure figure, std::size_t eye) {
    return ages[static_cast<std::size_t>(figure)][eye].value();
}

bool report_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Frames seen every 16 ms with a head and a tool of the ages given.
FrameHistory history(Nanoseconds head_age_ns, Nanoseconds tool_age_ns, const LatencySettings& settings = {},
                     int frames = 100) {
    FrameHistory h(settings);
    for (int i = 0; i < frames; ++i) {
        const Nanoseconds seen_ns = 1000 * kMs + i * 16 * kMs;
        h.add({static_cast<std::uint64_t>(i), seen_ns - head_age_ns, seen_ns - tool_age_ns, std::nullopt, seen_ns,
               5 * kMs, false});
    }
    return h;
}

}  // namespace

TEST(FrameTimes, AgesAreThoseAtTheTimeEachEyeSeesTheFrame) {
    // Sampled: head at 100, tool at 104, cut at 90; seen at 112 by the left eye and at 120 by the right.
    const FrameTimes before{1, {}, {}, {}, 96 * kMs, 0, false};
    const FrameTimes frame{2, 100 * kMs, 104 * kMs, 90 * kMs, 112 * kMs, 6 * kMs, false};
    const LatencySettings settings{3 * kMs, 2 * kMs, 1 * kMs, 8 * kMs};
    const FrameAges ages = ages_of(frame, &before, settings);
    EXPECT_EQ(value(ages, FrameFigure::head_age, kLeftEye), 12 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::head_age, kRightEye), 20 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::motion_to_photon, kLeftEye), (3 + 12 + 2) * kMs);
    EXPECT_EQ(value(ages, FrameFigure::motion_to_photon, kRightEye), (3 + 20 + 2) * kMs);
    EXPECT_EQ(value(ages, FrameFigure::tool_age, kLeftEye), 8 * kMs);
    // The force acts at 105, light comes at 114 and 122: touch is first.
    EXPECT_EQ(value(ages, FrameFigure::touch_before_sight, kLeftEye), 9 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::touch_before_sight, kRightEye), 17 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::carve_age, kLeftEye), 22 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::frame_time, kLeftEye), 16 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::frame_time, kRightEye), 16 * kMs);
    EXPECT_EQ(value(ages, FrameFigure::draw_time, kRightEye), 6 * kMs);
}

TEST(FrameTimes, SayNothingAboutWhatAFrameDoesNotHave) {
    const FrameTimes frame{1, {}, {}, {}, 112 * kMs, 6 * kMs, true};
    const FrameAges ages = ages_of(frame, &frame, {});
    for (const FrameFigure figure : {FrameFigure::head_age, FrameFigure::motion_to_photon, FrameFigure::tool_age,
                                     FrameFigure::touch_before_sight, FrameFigure::carve_age, FrameFigure::frame_time})
        EXPECT_FALSE(ages[static_cast<std::size_t>(figure)][kLeftEye]) << name_of(figure);
    FrameHistory h;
    h.add(frame);
    EXPECT_EQ(h.summary(FrameFigure::head_age).count, 0u);
    EXPECT_EQ(h.summary(FrameFigure::draw_time).count, 1u);
}

TEST(FrameTimes, SummariesAreTheNearestRanksByCounting) {
    std::mt19937 random(3);
    for (int n = 1; n <= 60; ++n) {
        std::vector<Nanoseconds> values;
        for (int i = 0; i < n; ++i) values.push_back(std::uniform_int_distribution<Nanoseconds>(-20, 20)(random));
        const FigureSummary s = summarised(values);
        const auto at_most = [&](Nanoseconds x) {
            return std::ranges::count_if(values, [&](Nanoseconds v) { return v <= x; });
        };
        const auto below = [&](Nanoseconds x) {
            return std::ranges::count_if(values, [&](Nanoseconds v) { return v < x; });
        };
        // The smallest value that at least that share of all does not exceed.
        EXPECT_GE(2 * at_most(s.median_ns), n);
        EXPECT_LT(2 * below(s.median_ns), n);
        EXPECT_GE(20 * at_most(s.p95_ns), 19 * n);
        EXPECT_LT(20 * below(s.p95_ns), 19 * n);
        EXPECT_GE(100 * at_most(s.p99_ns), 99 * n);
        EXPECT_LT(100 * below(s.p99_ns), 99 * n);
        EXPECT_EQ(at_most(s.most_ns), n);
        EXPECT_EQ(below(s.least_ns), 0);
        EXPECT_EQ(s.count, static_cast<std::size_t>(n));
    }
}

TEST(FrameTimes, TheHistoryKeepsTheLastFramesInTheirOrder) {
    FrameHistory h;
    EXPECT_EQ(h.size(), 0u);
    for (std::uint64_t i = 0; i < 1300; ++i)
        h.add({i, {}, {}, {}, static_cast<Nanoseconds>(i) * kMs, static_cast<Nanoseconds>(i), false});
    ASSERT_EQ(h.size(), FrameHistory::kFrames);
    for (std::size_t i = 0; i < h.size(); ++i) EXPECT_EQ(h.times(i).frame, 1300 - FrameHistory::kFrames + i);
    const FigureSummary s = h.summary(FrameFigure::draw_time);
    EXPECT_EQ(s.least_ns, 1300 - 512);
    EXPECT_EQ(s.most_ns, 1299);
    EXPECT_EQ(h.summary(FrameFigure::frame_time).median_ns, kMs);
}

TEST(FrameTimes, SummariseTheNewestFramesAlone) {
    FrameHistory h;
    for (Nanoseconds i = 1; i <= 100; ++i) h.add({0, {}, {}, {}, 0, i, false});
    EXPECT_EQ(h.recent(FrameFigure::draw_time, 10).least_ns, 91);
    EXPECT_EQ(h.recent(FrameFigure::draw_time, 10).count, 10u);
    EXPECT_EQ(h.recent(FrameFigure::draw_time, 1000).least_ns, 1);
    EXPECT_EQ(h.recent(FrameFigure::draw_time, 0).count, 0u);
}

TEST(FrameTimes, SummariseTheEyeThatIsWorseOff) {
    const FrameHistory h = history(10 * kMs, 5 * kMs, {.right_eye_later_ns = 8 * kMs});
    EXPECT_EQ(h.summary(FrameFigure::head_age).median_ns, 18 * kMs);
    EXPECT_EQ(h.summary(FrameFigure::head_age, kLeftEye).median_ns, 10 * kMs);
    EXPECT_EQ(h.summary(FrameFigure::head_age, kRightEye).median_ns, 18 * kMs);
}

TEST(FrameTimes, WarnExactlyAboveThePublishedLimits) {
    EXPECT_TRUE(history(17 * kMs, 16 * kMs).warnings().empty());  // the force acts a millisecond after its sample
    const auto head = [](Nanoseconds age) {
        const auto lines = history(age, 10 * kMs).warnings();
        return lines.size() == 1 ? lines[0].line : std::to_string(lines.size()) + " lines";
    };
    EXPECT_TRUE(report_has(head(17 * kMs + 100'000), "motion to photon 17.1 ms, above 17 ms"));
    EXPECT_TRUE(report_has(head(17 * kMs + 100'000), "Adelstein"));
    EXPECT_TRUE(report_has(head(21 * kMs), "21.0 ms, above 20 ms"));  // the laxest that is exceeded, alone
    EXPECT_TRUE(report_has(head(51 * kMs), "51.0 ms, above 50 ms"));
    const auto tool = [](Nanoseconds age) {
        const auto lines = history(5 * kMs, age).warnings();
        return lines.size() == 1 ? lines[0].line : std::to_string(lines.size()) + " lines";
    };
    EXPECT_TRUE(report_has(tool(17 * kMs), "touch before sight 16.0 ms, above 15 ms"));
    EXPECT_TRUE(report_has(tool(17 * kMs), "Di Luca"));
    EXPECT_TRUE(report_has(tool(-51 * kMs), "minus touch before sight 52.0 ms, above 50 ms"));
    EXPECT_TRUE(history(5 * kMs, -49 * kMs).warnings().empty());
    EXPECT_EQ(history(60 * kMs, 60 * kMs).warnings().size(), 2u);
}

TEST(FrameTimes, DoNotWarnOfAFewFramesOrTooEarly) {
    EXPECT_TRUE(history(60 * kMs, 60 * kMs, {}, 19).warnings().empty());
    FrameHistory h = history(10 * kMs, 10 * kMs, {}, 96);
    for (int i = 0; i < 4; ++i) h.add({200, 0, 0, {}, 100 * kMs, 0, false});
    EXPECT_TRUE(h.warnings().empty());
    for (int i = 0; i < 4; ++i) h.add({200, 0, 0, {}, 100 * kMs, 0, false});
    EXPECT_EQ(h.warnings().size(), 2u);
}

}  // namespace burin::session
