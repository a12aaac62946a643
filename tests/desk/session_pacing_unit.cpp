// SPDX-License-Identifier: MIT
// Frame pacing against simulated displays: a clock, a queue of images that a vblank takes one of, loads and jitter of
// choice.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include "desk/timing/frame_pacing.hpp"
#include "tests/support/test_units.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kUs = 1000;
constexpr Nanoseconds k60 = 16'666'667, k120 = 8'333'333;

struct PacedDisplay {
    Nanoseconds period_ns = k60;
    Nanoseconds phase_ns = 3'000'000;
    bool throttles = true;      // first in, first out, at vblanks
    std::size_t queue = 2;      // images beside the one shown
    bool tells_display = true;  // when each frame was shown
    Nanoseconds lead_ns = 200 * kUs;
};

struct Shown {
    FramePlan plan;
    Nanoseconds sampled_ns, finished_ns, display_ns;
    std::uint32_t interval;
};

class PacedSession {
public:
    PacedDisplay display;
    std::function<Nanoseconds(std::uint64_t frame)> processor = [](std::uint64_t) { return 2 * kMs; };
    std::function<Nanoseconds(std::uint64_t frame)> graphics = [](std::uint64_t) { return 4 * kMs; };
    Nanoseconds oversleep_ns = 0, flip_noise_ns = 0;  // at most; uniform
    PacingState state;

    explicit PacedSession(PacingSettings settings = {}) : state(begin_pacing(settings)) {}

    std::vector<Shown> run(int frames) {
        std::vector<Shown> shown;
        for (int i = 0; i < frames; ++i) shown.push_back(one_frame());
        return shown;
    }

private:
    Nanoseconds up_to(Nanoseconds most) {
        return most > 0 ? std::uniform_int_distribution<Nanoseconds>(0, most)(random_) : 0;
    }
    Nanoseconds vblank_at_or_after(Nanoseconds t) const {
        const Nanoseconds p = display.period_ns;
        const Nanoseconds k = (t - display.phase_ns + p - 1) / p;
        return display.phase_ns + k * p;
    }

    Shown one_frame() {
        learn_what_is_known();
        const PlannedFrame planned = plan_frame(state, now_ns_);
        state = planned.state;
        FrameMeasure m;
        m.plan = planned.plan;
        EXPECT_GE(m.plan.wake_ns, now_ns_);
        EXPECT_GT(m.plan.display_ns, m.plan.wake_ns);
        now_ns_ = m.plan.wake_ns + up_to(oversleep_ns);
        m.sampled_ns = now_ns_;
        now_ns_ += processor(m.plan.frame);
        m.finished_ns = now_ns_ + graphics(m.plan.frame);
        const Nanoseconds shown_ns = present(m);
        now_ns_ = std::max(now_ns_, m.finished_ns);
        state = frame_finished(state, m.plan, m.finished_ns);
        pending_.emplace_back(shown_ns, m);
        return {m.plan, m.sampled_ns, m.finished_ns, shown_ns, m.plan.interval};
    }

    // When the picture is seen; blocks while the queue is full.
    Nanoseconds present(FrameMeasure& m) {
        const Nanoseconds ready_ns = m.finished_ns + display.lead_ns;
        if (!display.throttles) return ready_ns;
        const Nanoseconds shown_ns = vblank_at_or_after(std::max(ready_ns, last_shown_ns_ + 1));
        last_shown_ns_ = shown_ns;
        queue_.push_back(shown_ns);
        while (!queue_.empty() && queue_.front() <= now_ns_) queue_.pop_front();
        if (queue_.size() > display.queue) {
            m.blocked_ns = queue_.front() - now_ns_;
            now_ns_ = queue_.front();
            m.flip_ns = now_ns_;
        }
        if (display.tells_display) {
            m.displayed_ns = shown_ns;
            m.flip_ns = shown_ns + up_to(flip_noise_ns);
        }
        return shown_ns;
    }

    void learn_what_is_known() {
        while (!pending_.empty() && (pending_.front().first <= now_ns_ || !display.throttles)) {
            state = after_frame(state, pending_.front().second);
            pending_.pop_front();
        }
    }

    std::mt19937 random_{1};
    Nanoseconds now_ns_ = 1'000'000'000'000;  // like a monotonic clock, not from 0
    Nanoseconds last_shown_ns_ = 0;
    std::deque<Nanoseconds> queue_;
    std::deque<std::pair<Nanoseconds, FrameMeasure>> pending_;
};

std::vector<Shown> last(const std::vector<Shown>& all, std::size_t count) {
    return {all.end() - static_cast<long>(count), all.end()};
}

int late(const std::vector<Shown>& frames, Nanoseconds period_ns) {
    return static_cast<int>(std::ranges::count_if(
        frames, [&](const Shown& s) { return s.display_ns - s.plan.display_ns > period_ns / 2; }));
}

Nanoseconds oldest_head(const std::vector<Shown>& frames) {
    Nanoseconds most = 0;
    for (const Shown& s : frames) most = std::max(most, s.display_ns - s.sampled_ns);
    return most;
}

double rate_Hz(const std::vector<Shown>& frames) {
    return static_cast<double>(frames.size() - 1) / seconds(frames.back().display_ns - frames.front().display_ns);
}

Nanoseconds worst_prediction(const std::vector<Shown>& frames) {
    Nanoseconds most = 0;
    for (const Shown& s : frames) most = std::max(most, std::abs(s.display_ns - s.plan.display_ns));
    return most;
}

}  // namespace

TEST(FramePacing, ASteadyLoadIsShownEveryPeriodWithAHeadHardlyOlderThanTheWork) {
    for (const Nanoseconds period : {k60, k120}) {
        PacedSession session({.period_ns = period});
        session.display.period_ns = period;
        session.graphics = [&](std::uint64_t) { return period / 3; };
        const auto frames = last(session.run(600), 500);
        EXPECT_EQ(late(frames, period), 0);
        EXPECT_NEAR(rate_Hz(frames), 1e9 / static_cast<double>(period), 0.01);
        // Work, the least margin and the lead; the best one could do is 0.8 ms less.
        EXPECT_LE(oldest_head(frames), 2 * kMs + period / 3 + kMs + 20 * kUs);
        EXPECT_LE(worst_prediction(frames), 20 * kUs);
    }
}

TEST(FramePacing, LearnsAPeriodThatIsNotTheOneAnnounced) {
    PacedSession session({.period_ns = k60});
    session.display.period_ns = 16'683'350;  // 59.94 Hz
    const auto frames = last(session.run(1200), 600);
    EXPECT_EQ(late(frames, k60), 0);
    EXPECT_NEAR(session.state.period_ns, 16'683'350.0, 500.0);
    EXPECT_LE(worst_prediction(frames), 20 * kUs);
}

TEST(FramePacing, ALoadThatJumpsCostsAFewFramesAndNoMore) {
    PacedSession session;
    session.graphics = [](std::uint64_t frame) { return frame < 300 ? 3 * kMs : 9 * kMs; };
    const auto frames = session.run(700);
    const std::vector<Shown> during(frames.begin() + 299, frames.begin() + 320), after = last(frames, 300);
    EXPECT_GE(late(during, k60), 1);  // nobody could foresee it
    EXPECT_LE(late(during, k60), 3);
    EXPECT_EQ(late(after, k60), 0);
    EXPECT_NEAR(rate_Hz(after), 60.0, 0.01);
    EXPECT_LE(oldest_head(after), 13 * kMs);
}

TEST(FramePacing, ALoadThatFallsMakesHeadsYoungAgain) {
    PacedSession session;
    session.graphics = [](std::uint64_t frame) { return frame < 300 ? 9 * kMs : 3 * kMs; };
    const auto frames = session.run(400);
    EXPECT_EQ(late(last(frames, 100), k60), 0);
    EXPECT_LE(oldest_head(last(frames, 60)), 2 * kMs + 3 * kMs + kMs + 100 * kUs);
}

TEST(FramePacing, ASingleHitchIsSoonForgotten) {
    PacedSession session;
    session.graphics = [](std::uint64_t frame) { return frame == 300 ? 12 * kMs : 3 * kMs; };
    const auto frames = session.run(330);
    EXPECT_LE(late(last(frames, 32), k60), 1);
    EXPECT_LE(oldest_head(last(frames, 20)), 2 * kMs + 3 * kMs + kMs + 500 * kUs);
}

TEST(FramePacing, ALoadLongerThanAPeriodRunsAtHalfRateWithoutFluttering) {
    for (const Nanoseconds load : {15 * kMs + 400 * kUs, 16 * kMs, 18 * kMs, 25 * kMs}) {
        PacedSession session;
        session.processor = [](std::uint64_t) { return kMs; };
        session.graphics = [&](std::uint64_t frame) {
            return load - kMs + static_cast<Nanoseconds>(frame % 5) * 200 * kUs;
        };
        const auto frames = last(session.run(600), 500);
        EXPECT_EQ(late(frames, k60), 0) << load;
        EXPECT_NEAR(rate_Hz(frames), 30.0, 0.01) << load;
        EXPECT_TRUE(std::ranges::all_of(frames, [](const Shown& s) { return s.interval == 2; })) << load;
        EXPECT_LE(oldest_head(frames), load + 800 * kUs + kMs + 20 * kUs) << load;
    }
}

TEST(FramePacing, ALoadAboutAsLongAsAPeriodChangesItsRateSeldom) {
    PacedSession session;
    std::mt19937 random(5);
    session.processor = [](std::uint64_t) { return kMs; };
    session.graphics = [&](std::uint64_t) {
        return 14 * kMs + std::uniform_int_distribution<Nanoseconds>(0, kMs)(random);
    };
    const auto frames = session.run(2000);
    int changes = 0;
    for (std::size_t i = 101; i < frames.size(); ++i) changes += frames[i].interval != frames[i - 1].interval ? 1 : 0;
    EXPECT_LE(changes, 4);
}

TEST(FramePacing, OversleepingAndNoisyFlipsOfMillisecondsAreRiddenOut) {
    PacedSession session;
    session.oversleep_ns = 3 * kMs;
    session.flip_noise_ns = 2 * kMs;
    const auto frames = last(session.run(2000), 1500);
    EXPECT_LE(late(frames, k60), 15);  // one in a hundred
    EXPECT_NEAR(rate_Hz(frames), 60.0, 0.7);
    EXPECT_LE(worst_prediction(last(frames, 30)), k60 + 2 * kMs);
    EXPECT_EQ(session.state.period_resets, 0u);
    EXPECT_NEAR(session.state.period_ns, static_cast<double>(k60), 60'000.0);
    // The work, the worst oversleeping, the margin it has grown and the mean noise of a flip: no whole period lost.
    Nanoseconds sum = 0;
    for (const Shown& s : frames) sum += s.display_ns - s.sampled_ns;
    EXPECT_LE(sum / static_cast<Nanoseconds>(frames.size()), 12 * kMs);
}

TEST(FramePacing, MissedVblanksAreCountedAndTheNextFramesAreInTimeAgain) {
    PacedSession session;
    session.processor = [](std::uint64_t frame) { return frame % 100 == 99 ? 30 * kMs : 2 * kMs; };  // a stall
    const auto frames = session.run(1000);
    const int seen = late(frames, k60);
    EXPECT_GE(seen, 10);
    EXPECT_LE(seen, 12);
    EXPECT_LE(session.state.missed, static_cast<std::uint64_t>(seen));
    EXPECT_GE(session.state.missed + 2, static_cast<std::uint64_t>(seen));  // the last may not be known yet
    for (std::size_t i = 50; i < frames.size(); i += 100)
        EXPECT_LE(frames[i].display_ns - frames[i].sampled_ns, 2 * kMs + 4 * kMs + 2 * kMs);
}

TEST(FramePacing, ADisplayThatDoesNotThrottleIsFedAtThePeriodOrAsFastAsTheWorkAllows) {
    PacedSession light;
    light.display.throttles = light.display.tells_display = false;
    const auto steady = last(light.run(300), 200);
    EXPECT_NEAR(rate_Hz(steady), 60.0, 0.05);
    EXPECT_FALSE(light.state.flips_seen);

    PacedSession heavy;
    heavy.display = light.display;
    heavy.graphics = [](std::uint64_t) { return 40 * kMs; };  // a software device: 42 ms, no need to wait for 50
    const auto frames = last(heavy.run(300), 200);
    EXPECT_GT(rate_Hz(frames), 1000.0 / 44.0);
    EXPECT_LE(oldest_head(frames), 43 * kMs);
}

TEST(FramePacing, WithoutFlipsALoadThatFallsHoldsNoFrameUp) {
    PacedSession session;
    session.display.throttles = session.display.tells_display = false;
    session.graphics = [](std::uint64_t frame) { return frame < 50 ? 300 * kMs : 20 * kMs; };
    const auto frames = last(session.run(100), 45);
    for (std::size_t i = 1; i < frames.size(); ++i)
        EXPECT_LE(frames[i].sampled_ns - frames[i - 1].finished_ns, k60) << i;
}

TEST(FramePacing, AQueueThatHasFilledIsEmptiedAgain) {
    // A burst before anything is known fills the swapchain's queue: every frame is then in time and yet seen late.
    for (const bool tells : {true, false}) {
        PacedSession session({.period_ns = k60 * 9 / 10});  // too fast: it runs into the queue's end
        session.display.tells_display = tells;
        const auto frames = session.run(3000);
        EXPECT_LE(oldest_head(last(frames, 20)), (tells ? 1 : 2) * k60 + 8 * kMs) << tells;
        EXPECT_NEAR(rate_Hz(last(frames, 1000)), 60.0, 0.5) << tells;
        EXPECT_GE(session.state.left_out, 1u) << tells;
    }
}

TEST(FramePacing, AnotherRateOfTheDisplayIsLearnt) {
    for (const Nanoseconds now : {Nanoseconds{13'333'333}, Nanoseconds{20'000'000}, Nanoseconds{33'333'333}}) {
        PacedSession session;
        session.run(300);
        session.display.period_ns = now;  // nobody tells the pacer
        const auto frames = last(session.run(500), 200);
        EXPECT_NEAR(session.state.period_ns, static_cast<double>(now), 0.003 * static_cast<double>(now));
        EXPECT_EQ(late(frames, now), 0) << now;
        EXPECT_NEAR(rate_Hz(frames), 1e9 / static_cast<double>(now), 0.05) << now;
        EXPECT_LE(oldest_head(frames), 8 * kMs) << now;
    }
    PacedSession told;
    told.run(300);
    told.display.period_ns = k120;
    told.state = display_changed(told.state, k120);
    EXPECT_NEAR(rate_Hz(last(told.run(300), 100)), 120.0, 0.05);
}

TEST(FramePacing, TheSameTimesGiveTheSamePlans) {
    const auto plans = [] {
        PacedSession session;
        session.oversleep_ns = 2 * kMs;
        std::vector<Nanoseconds> wakes;
        for (const Shown& s : session.run(200)) wakes.push_back(s.plan.wake_ns);
        return wakes;
    };
    EXPECT_EQ(plans(), plans());
}

// ---- The display's lead: a picture finished less than this before a vblank misses it

namespace {
constexpr Nanoseconds kLead = 4 * kMs;

// A pacer that has seen the display's vblanks, at multiples of k60, and works 2 ms a frame.
PacingState with_lead() {
    PacingState state = begin_pacing({.period_ns = k60, .lead_ns = kLead});
    for (std::uint64_t i = 0; i < 40; ++i) {
        const PlannedFrame planned = plan_frame(state, static_cast<Nanoseconds>(600 + i) * k60 + kMs);
        FrameMeasure m;
        m.plan = planned.plan;
        m.sampled_ns = m.plan.wake_ns;
        m.finished_ns = m.plan.wake_ns + 2 * kMs;
        m.displayed_ns = m.flip_ns = m.plan.display_ns / k60 * k60;
        state = after_frame(frame_finished(planned.state, m.plan, m.finished_ns), m);
    }
    return state;
}
}  // namespace

TEST(FramePacing, PlansPicturesToBeFinishedTheDisplaysLeadBeforeTheVblank) {
    const PlannedFrame planned = plan_frame(with_lead(), 700 * k60 + kMs);
    const FramePlan& plan = planned.plan;
    EXPECT_NEAR(static_cast<double>(plan.display_ns), static_cast<double>(701 * k60), 1e3);
    EXPECT_EQ(plan.finish_by_ns, plan.display_ns - kLead);
    EXPECT_GE(plan.finish_by_ns - plan.wake_ns, 2 * kMs) << "there is no time for the work";
    EXPECT_LE(plan.finish_by_ns - plan.wake_ns, 3 * kMs) << "the head could be younger";
}

TEST(FramePacing, APictureFinishedWithinTheLeadIsTakenToBeSeenAPeriodLater) {
    const PlannedFrame first = plan_frame(with_lead(), 700 * k60 + kMs);
    const Nanoseconds finished_ns = first.plan.display_ns - kLead / 2;
    // The next one is not planned for the vblank that the late one takes.
    const PacingState late = frame_finished(first.state, first.plan, finished_ns);
    const Nanoseconds next_ns = plan_frame(late, finished_ns).plan.display_ns;
    EXPECT_NEAR(static_cast<double>(next_ns - first.plan.display_ns), 2.0 * static_cast<double>(k60), 1e3);
    // Nor is its head as young as was planned, where nobody tells when it was seen.
    FrameMeasure m;
    m.plan = first.plan;
    m.sampled_ns = first.plan.wake_ns;
    m.finished_ns = finished_ns;
    const PacingState told = after_frame(late, m);
    EXPECT_EQ(told.missed, late.missed + 1);
    EXPECT_NEAR(static_cast<double>(told.head_age_ns),
                static_cast<double>(first.plan.display_ns + k60 - first.plan.wake_ns), 1e3);
    // Without vblanks it is seen as soon as the display has taken it.
    const PacingState blind = begin_pacing({.period_ns = k60, .lead_ns = kLead});
    const PlannedFrame free = plan_frame(blind, 0);
    m.plan = free.plan;
    m.sampled_ns = 0;
    m.finished_ns = 20 * kMs;
    EXPECT_EQ(after_frame(free.state, m).head_age_ns, 20 * kMs + kLead);
}

TEST(FramePacing, AnotherDisplayIsNotShownFramesAsRarelyAsTheOldOneHadTo) {
    PacedSession session;
    session.graphics = [](std::uint64_t frame) { return frame < 300 ? 25 * kMs : kMs; };
    session.run(300);
    ASSERT_EQ(session.state.interval, 2u);
    EXPECT_EQ(display_changed(session.state, k60).interval, 1u);
}

TEST(FramePacing, NewsOfAnOlderFrameDoesNotMoveTheNextOne) {
    const PlannedFrame first = plan_frame(with_lead(), 700 * k60 + kMs);
    const PlannedFrame second = plan_frame(first.state, 701 * k60 + kMs);
    const PacingState told = frame_finished(second.state, first.plan, first.plan.display_ns + 3 * k60);
    EXPECT_EQ(told.last_plan.display_ns, second.plan.display_ns);
}

}  // namespace burin::session
