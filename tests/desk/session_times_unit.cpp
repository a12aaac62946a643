// SPDX-License-Identifier: MIT
#include "desk/timing/session_times.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

namespace burin::session {
namespace {

constexpr DisplayBeat kUnseen{10 * kMs, std::nullopt, 0};

Nanoseconds processor_now_ns = 0;
Nanoseconds fake_processor_ns() noexcept { return processor_now_ns; }

// A loop whose every stage takes as long as it is told.
struct TimedLoop {
    SimulatedClock clock;
    SessionTimes times{clock, fake_processor_ns};

    TimedLoop() {
        times.keep_frames();
        pass(1000 * kMs);
    }
    void pass(Nanoseconds t_ns) { clock.sleep_until(clock.now_ns() + t_ns); }
    void stage(FrameStage stage, Nanoseconds t_ns) {
        pass(t_ns);
        times.reached(stage);
    }
    // Head and tool are sampled when the input has been taken.
    void frame(Nanoseconds wait_ns, Nanoseconds draw_ns, bool drawn = true, const DisplayBeat& beat = kUnseen) {
        times.begin();
        stage(FrameStage::wait, wait_ns);
        times.sampled(clock.now_ns(), clock.now_ns());
        stage(FrameStage::draw, draw_ns);
        times.finished(drawn, beat);
    }
};

std::optional<Nanoseconds> age(const TimedFrame& frame, FrameFigure figure) { return worse_eye(frame.ages, figure); }
Nanoseconds length(const TimedFrame& frame, FrameStage stage) {
    return frame.stage_ns.at(static_cast<std::size_t>(stage));
}

}  // namespace

TEST(DisplayBeat, ShowsAPictureFromTheNextVblankOn) {
    const DisplayBeat seen{10 * kMs, 1003 * kMs, 0};
    for (Nanoseconds handed_ns = 950 * kMs; handed_ns < 1050 * kMs; handed_ns += 250'000) {
        Nanoseconds first_ns = 903 * kMs;  // by counting
        while (first_ns < handed_ns) first_ns += 10 * kMs;
        EXPECT_EQ(begins_to_show_ns(handed_ns, seen), first_ns) << handed_ns;
    }
    EXPECT_EQ(begins_to_show_ns(950 * kMs, kUnseen), 955 * kMs);
}

TEST(SessionTimes, GiveEachStageTheTimeSinceTheOneBefore) {
    TimedLoop loop;
    loop.times.begin();
    loop.stage(FrameStage::wait, 9 * kMs);
    loop.stage(FrameStage::input, 1 * kMs);
    loop.stage(FrameStage::step, 2 * kMs);
    for (int screen = 0; screen < 3; ++screen) {
        loop.stage(FrameStage::record, 3 * kMs);
        loop.stage(FrameStage::draw, 5 * kMs);
        loop.stage(FrameStage::show, 7 * kMs);
    }
    processor_now_ns += 40 * kMs;
    loop.times.finished(true, kUnseen);
    ASSERT_EQ(loop.times.frames().size(), 1u);
    const TimedFrame& frame = loop.times.frames()[0];
    EXPECT_EQ(length(frame, FrameStage::wait), 9 * kMs);
    EXPECT_EQ(length(frame, FrameStage::input), 1 * kMs);
    EXPECT_EQ(length(frame, FrameStage::step), 2 * kMs);
    EXPECT_EQ(length(frame, FrameStage::record), 9 * kMs);
    EXPECT_EQ(length(frame, FrameStage::draw), 15 * kMs);
    EXPECT_EQ(length(frame, FrameStage::show), 21 * kMs);
    EXPECT_EQ(frame.times.draw_ns, 15 * kMs);
    EXPECT_EQ(frame.processor_ns, 40 * kMs);
}

TEST(SessionTimes, AgesAreFromTheSampleToTheMiddleOfTheScanOut) {
    TimedLoop loop;
    loop.frame(3 * kMs, 6 * kMs);
    const TimedFrame& frame = loop.times.frames()[0];
    // Six milliseconds until it is handed over, five until the display begins with it, five until it is in its middle.
    EXPECT_EQ(age(frame, FrameFigure::head_age), 11 * kMs);
    EXPECT_EQ(age(frame, FrameFigure::motion_to_photon), 16 * kMs);
    EXPECT_EQ(age(frame, FrameFigure::touch_before_sight), 15 * kMs);  // the force acts a millisecond after its sample
    loop.frame(3 * kMs, 6 * kMs, true, {10 * kMs, 1000 * kMs, 0});
    // Sampled at 1012, handed over at 1018, shown from 1020.
    EXPECT_EQ(age(loop.times.frames()[1], FrameFigure::motion_to_photon), 13 * kMs);
    loop.frame(3 * kMs, 6 * kMs, true, {10 * kMs, 1000 * kMs, 4 * kMs});
    // Sampled at 1021, shown from 1030 to one eye and 1034 to the other.
    EXPECT_EQ(age(loop.times.frames()[2], FrameFigure::motion_to_photon), 18 * kMs);
    loop.frame(3 * kMs, 6 * kMs, true, {10 * kMs, 1000 * kMs, -4 * kMs});
    // Sampled at 1030, shown from 1040 to the right eye and 1044 to the left one.
    const auto& ages = loop.times.frames()[3].ages[static_cast<std::size_t>(FrameFigure::motion_to_photon)];
    EXPECT_EQ(ages[kRightEye], 15 * kMs);
    EXPECT_EQ(ages[kLeftEye], 19 * kMs);
}

TEST(SessionTimes, KnowNoFrameTimeWhereFramesWereSkipped) {
    TimedLoop loop;
    loop.frame(4 * kMs, 6 * kMs);
    loop.frame(4 * kMs, 6 * kMs);
    loop.frame(50 * kMs, 0, false);
    loop.frame(4 * kMs, 6 * kMs);
    loop.frame(4 * kMs, 6 * kMs);
    EXPECT_EQ(loop.times.drawn(), 4u);
    EXPECT_EQ(loop.times.skipped(), 1u);
    const auto& frames = loop.times.frames();
    EXPECT_FALSE(age(frames[0], FrameFigure::frame_time));
    EXPECT_EQ(age(frames[1], FrameFigure::frame_time), 10 * kMs);
    EXPECT_FALSE(age(frames[2], FrameFigure::frame_time));
    EXPECT_EQ(age(frames[3], FrameFigure::frame_time), 10 * kMs);
}

TEST(SessionTimes, ACutHasAnAgeInTheFirstFrameThatShowsIt) {
    TimedLoop loop;
    const Nanoseconds cut_ns = loop.clock.now_ns() - 20 * kMs;
    for (int i = 0; i < 3; ++i) {
        loop.times.begin();
        loop.times.cut(i < 2 ? cut_ns : cut_ns + 15 * kMs);  // light that is baked comes with the same cut again
        loop.times.finished(true, kUnseen);
    }
    const auto& frames = loop.times.frames();
    EXPECT_EQ(age(frames[0], FrameFigure::carve_age), 25 * kMs);
    EXPECT_FALSE(age(frames[1], FrameFigure::carve_age));
    EXPECT_EQ(age(frames[2], FrameFigure::carve_age), 10 * kMs);
}

TEST(SessionTimes, ASessionThatNeverBeginsHasNone) {
    TimedLoop loop;
    loop.times.sampled(1, 1);
    loop.times.cut(1);
    loop.times.reached(FrameStage::draw);
    loop.times.finished(true, kUnseen);
    EXPECT_FALSE(loop.times.running());
    EXPECT_EQ(loop.times.drawn(), 0u);
    EXPECT_TRUE(loop.times.frames().empty());
}

TEST(SessionTimes, SayEachWarningOnceWhenItBegins) {
    TimedLoop loop;
    std::vector<std::string> said;
    const auto go = [&](int frames, Nanoseconds draw_ns) {
        for (int i = 0; i < frames; ++i) {
            loop.frame(0, draw_ns);
            for (std::string& line : loop.times.take_new_warnings()) said.push_back(std::move(line));
        }
    };
    go(200, 3 * kMs);  // to photon 13 ms
    EXPECT_TRUE(said.empty());
    go(200, 30 * kMs);  // 40 ms, and 39 ms after it was felt
    ASSERT_EQ(said.size(), 2u);
    EXPECT_NE(said[0].find("above 20 ms"), std::string::npos);
    EXPECT_NE(said[1].find("Di Luca"), std::string::npos);
    EXPECT_EQ(loop.times.warnings().size(), 2u);
    go(1000, 3 * kMs);
    EXPECT_TRUE(loop.times.warnings().empty());
    go(200, 30 * kMs);
    EXPECT_EQ(said.size(), 2u) << "come again, but not said again";
    EXPECT_EQ(loop.times.warnings().size(), 2u);
}

TEST(Warnings, AreShortEnoughForAPanel) {
    TimedLoop loop;
    for (int i = 0; i < 100; ++i) loop.frame(0, 800 * kMs);
    for (const FrameWarning& warning : loop.times.warnings()) EXPECT_LE(warning.title.size(), 45u) << warning.title;
    EXPECT_EQ(loop.times.warnings().size(), 2u);
}

TEST(HistogramSummary, IsTheNearestRankToWithinAnEighth) {
    std::mt19937 random(5);
    for (const int n : {1, 7, 100, 1000}) {
        haptics::Histogram histogram;
        std::vector<Nanoseconds> values;
        for (int i = 0; i < n; ++i) {
            values.push_back(std::uniform_int_distribution<Nanoseconds>(0, 3'000'000)(random));
            histogram.add(values.back());
        }
        const FigureSummary exact = summarised(values), close = summarised(histogram);
        EXPECT_EQ(close.count, exact.count);
        EXPECT_EQ(close.most_ns, exact.most_ns);
        const auto within = [](Nanoseconds a, Nanoseconds b) { return a >= b && a <= b + b / 8 + 1; };
        EXPECT_TRUE(within(close.median_ns, exact.median_ns)) << n;
        EXPECT_TRUE(within(close.p99_ns, exact.p99_ns)) << n;
    }
    EXPECT_EQ(summarised(haptics::Histogram()).count, 0u);
}

RC_GTEST_PROP(HistogramLook, SeesWhatWasAddedSinceTheLookBefore, ()) {
    haptics::Histogram histogram;
    HistogramLook look;
    for (int round = 0; round < 4; ++round) {
        const auto values = *rc::gen::container<std::vector<Nanoseconds>>(rc::gen::inRange<Nanoseconds>(0, 5'000'000));
        for (const Nanoseconds value : values) histogram.add(value);
        const HistogramLook::Seen seen = look.look(histogram);
        const Nanoseconds longest_ns = values.empty() ? 0 : *std::ranges::max_element(values);
        RC_ASSERT(seen.count == values.size());
        RC_ASSERT(seen.longest_ns >= longest_ns);
        RC_ASSERT(seen.longest_ns <= longest_ns + longest_ns / 8 + 1);
    }
}

}  // namespace burin::session
