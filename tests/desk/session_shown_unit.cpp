// SPDX-License-Identifier: MIT
// What asking a display now and then tells of its frames, with a display and a clock that are made up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "desk/timing/shown_frames.hpp"
#include "tests/support/test_units.hpp"

namespace burin::session {
namespace {

// Shows what it was handed from the next vblank on, a picture each.
struct Display {
    Nanoseconds period_ns = 16'683'333, phase_ns = 5 * kMs;
    std::vector<Nanoseconds> shown_ns;  // by the pictures' numbers, from 1

    std::uint64_t hand(Nanoseconds now_ns) {
        const auto periods = static_cast<Nanoseconds>(
            std::ceil(static_cast<double>(now_ns - phase_ns) / static_cast<double>(period_ns)));
        Nanoseconds at_ns = phase_ns + periods * period_ns;
        if (!shown_ns.empty()) at_ns = std::max(at_ns, shown_ns.back() + period_ns);
        shown_ns.push_back(at_ns);
        return shown_ns.size();
    }
    ShownFrames::WasShown at(Nanoseconds now_ns) const {
        return [this, now_ns](std::uint64_t picture) { return std::optional(shown_ns[picture - 1] <= now_ns); };
    }
};

// A session's loop: it wakes for a frame, works, hands it over, and looks as often as it is told until the next one.
struct Loop {
    Display display;
    PacingState pacing = begin_pacing({});
    ShownFrames frames;
    Nanoseconds now_ns = 1000 * kMs, work_ns = 4 * kMs;
    std::uint64_t looks = 0;
    std::vector<FrameMeasure> measures;
    std::vector<Nanoseconds> foreseen_wrong_ns;  // when a frame is planned to be seen, against when it is

    void look() {
        ++looks;
        for (const FrameMeasure& measure : frames.look(now_ns, display.at(now_ns))) {
            measures.push_back(measure);
            pacing = after_frame(pacing, measure);
        }
    }
    void frame() {
        const PlannedFrame planned = plan_frame(pacing, now_ns);
        pacing = planned.state;
        while (now_ns < planned.plan.wake_ns) {
            now_ns =
                std::min(planned.plan.wake_ns, std::max(now_ns, frames.next_look_ns().value_or(planned.plan.wake_ns)));
            look();
        }
        FrameMeasure measure;
        measure.plan = planned.plan;
        measure.sampled_ns = now_ns;
        now_ns += work_ns;
        measure.finished_ns = now_ns;
        pacing = frame_finished(pacing, planned.plan, now_ns);
        frames.handed(measure, display.hand(now_ns), now_ns);
        foreseen_wrong_ns.push_back(std::abs(display.shown_ns.back() - planned.plan.display_ns));
        look();
    }
};

FrameMeasure planned_for(Nanoseconds display_ns) {
    FrameMeasure measure;
    measure.plan.display_ns = display_ns;
    return measure;
}

}  // namespace

TEST(ShownFrames, TeachThePacingTheDisplaysBeat) {
    Loop loop;
    for (int i = 0; i < 300; ++i) loop.frame();
    EXPECT_TRUE(loop.pacing.flips_seen);
    EXPECT_NEAR(loop.pacing.period_ns, static_cast<double>(loop.display.period_ns), 5e3);
    for (std::size_t i = 200; i < 300; ++i) EXPECT_LE(loop.foreseen_wrong_ns[i], ShownFrames::kSharp_ns) << i;
    for (const FrameMeasure& measure : loop.measures) {
        if (!measure.flip_ns) continue;
        const auto& shown = loop.display.shown_ns;
        const auto at = std::ranges::lower_bound(shown, *measure.flip_ns - ShownFrames::kSharp_ns);
        ASSERT_NE(at, shown.end());
        EXPECT_LE(*at, *measure.flip_ns) << "never early, and late by at most what is called sharp";
    }
    // Once the beat is known it is only asked for about when it is due.
    const std::uint64_t before = loop.looks;
    for (int i = 0; i < 100; ++i) loop.frame();
    EXPECT_LE(loop.looks - before, 100u * 8);
}

TEST(ShownFrames, TellNoTimeThatIsNotKnownSharply) {
    ShownFrames frames;
    frames.handed(planned_for(10 * kMs), 1, 0);
    EXPECT_EQ(frames.next_look_ns(), kMs);
    EXPECT_TRUE(frames.look(kMs, [](auto) { return false; }).empty());
    const auto known = frames.look(9 * kMs, [](auto) { return true; });
    ASSERT_EQ(known.size(), 1u);
    EXPECT_FALSE(known[0].flip_ns || known[0].displayed_ns) << "some time in eight milliseconds";
    EXPECT_FALSE(frames.next_look_ns());
    frames.handed(planned_for(30 * kMs), 2, 20 * kMs);
    EXPECT_EQ(frames.next_look_ns(), 21 * kMs) << "all the time, until one is sharp";
}

TEST(ShownFrames, ThatThisDisplayWasNotHandedTellNothingOfIt) {
    ShownFrames frames;
    frames.handed(planned_for(10 * kMs), 7, 0);
    ASSERT_TRUE(frames.look(9 * kMs, [](auto) { return false; }).empty());
    EXPECT_TRUE(frames.look(10 * kMs, [](auto) { return true; })[0].flip_ns);
    frames.handed(planned_for(30 * kMs), 7, 20 * kMs);  // only another screen of the wall has changed
    const auto known = frames.look(20 * kMs, [](auto) { return true; });
    ASSERT_EQ(known.size(), 1u);
    EXPECT_FALSE(known[0].flip_ns) << "the picture before has been there for long";
}

TEST(ShownFrames, GiveFramesBackInTheirOrderAlsoWhereNothingIsTold) {
    ShownFrames frames;
    FrameMeasure blocked = planned_for(5 * kMs);
    blocked.flip_ns = 4 * kMs;
    frames.handed(blocked, 1, 6 * kMs);
    const auto known = frames.look(6 * kMs, [](auto) { return std::nullopt; });
    ASSERT_EQ(known.size(), 1u);
    EXPECT_EQ(known[0].flip_ns, 4 * kMs) << "what another told stays";
    // A window that nobody sees does not hold its frames back for ever.
    for (std::uint64_t i = 0; i < 3; ++i) frames.handed(planned_for(static_cast<Nanoseconds>(i)), 2 + i, 10 * kMs);
    const auto never = [](auto) { return std::optional(false); };
    EXPECT_TRUE(frames.look(100 * kMs, never).empty());
    const auto given_up = frames.look(10 * kMs + ShownFrames::kPatience_ns, never);
    ASSERT_EQ(given_up.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(given_up[i].plan.display_ns, static_cast<Nanoseconds>(i));
}

}  // namespace burin::session
