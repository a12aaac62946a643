// SPDX-License-Identifier: MIT
#include "desk/panel/panel_feed.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace burin::session {
namespace {

// A session of a frame every 10 ms, each with a force and a tick of its own.
struct FedPanel {
    SimulatedClock clock;
    SessionTimes times{clock, [] noexcept -> Nanoseconds { return 0; }};
    haptics::Histogram ticks;
    renderer::RenderStats drawn;
    PanelFeed feed;
    bool real_time = true;
    int frame = 0;

    PanelModel go(bool stirring, double force_N) {
        if (real_time) times.begin();
        clock.sleep_until(clock.now_ns() + 10 * kMs);
        ticks.add(20'000 + 50 * frame++);
        times.sampled(clock.now_ns() - 4 * kMs, clock.now_ns() - 2 * kMs);
        drawn.parts = {{0, 0, 10, 10}};
        drawn.patches = static_cast<std::uint32_t>(frame);
        feed.feed({clock.now_ns(), force_N, 0, 0, stirring, times, ticks, drawn, {100, 50}});
        times.finished(true, {10 * kMs, std::nullopt, 0});
        PanelModel model;
        feed.show_on(model);
        return model;
    }
};

}  // namespace

TEST(PanelFeed, ChangesNumbersTwiceASecondAndPlotsTenTimes) {
    FedPanel session;
    std::set<double> forces, ticks;
    std::vector<PanelPlot> plots;
    for (int i = 0; i < 500; ++i) {
        const PanelModel model = session.go(true, 0.001 * i);
        forces.insert(model.touch.force_N);
        if (model.figures.tick_us) ticks.insert(*model.figures.tick_us);
        if (plots.empty() || plots.back() != model.force_N) plots.push_back(model.force_N);
    }
    // Five seconds; the first numbers and plots come at once.
    EXPECT_NEAR(static_cast<double>(forces.size()), 10.0, 1.0);
    EXPECT_LE(ticks.size(), 11u);
    EXPECT_NEAR(static_cast<double>(plots.size()), 50.0, 1.0);
}

TEST(PanelFeed, ShowsWhatTheFramesTook) {
    FedPanel session;
    PanelModel model;
    for (int i = 0; i < 200; ++i) model = session.go(true, 1.5);
    EXPECT_NEAR(model.figures.frames_per_s, 100.0, 2.0);
    ASSERT_TRUE(model.figures.frame_ms && model.figures.head_age_ms && model.figures.touch_before_sight_ms);
    EXPECT_DOUBLE_EQ(*model.figures.frame_ms, 10.0);
    EXPECT_DOUBLE_EQ(*model.figures.head_age_ms, 9.0);             // 4 ms, and half a period
    EXPECT_DOUBLE_EQ(*model.figures.motion_to_photon_ms, 14.0);    // and half a scan-out
    EXPECT_DOUBLE_EQ(*model.figures.touch_before_sight_ms, 11.0);  // 2 + 5 + 5 - 1 ms
    EXPECT_NEAR(*model.figures.tick_us, 30.0, 30.0 / 8.0);
    EXPECT_FLOAT_EQ(model.frame_ms.values.back(), 10.0f);
    EXPECT_FLOAT_EQ(model.force_N.values.back(), 1.5f);
    ASSERT_TRUE(model.savings);
    EXPECT_GT(model.savings->patches, 100u);
}

TEST(PanelFeed, KeepsTheHighestForceBetweenTwoPoints) {
    FedPanel session;
    PanelModel model;
    for (int i = 0; i < 100; ++i) model = session.go(true, i == 57 ? 3.0 : 0.1);
    EXPECT_EQ(std::ranges::count(model.force_N.values, 3.0f), 1);
}

TEST(PanelFeed, StandsStillWhileTheSessionRests) {
    FedPanel session;
    for (int i = 0; i < 100; ++i) (void)session.go(true, 1.0);
    for (int i = 0; i < 110; ++i) (void)session.go(false, 0.0);
    const PanelModel at_rest = session.go(false, 0.0);
    EXPECT_EQ(at_rest.figures.frames_per_s, 0.0);
    for (int i = 0; i < 300; ++i) EXPECT_EQ(session.go(false, 0.0), at_rest) << i;
    EXPECT_NE(session.go(true, 2.0), at_rest);
}

TEST(PanelFeed, ShowsNothingThatSimulatedTimeDoesNotHave) {
    FedPanel session;
    session.real_time = false;
    PanelModel model;
    for (int i = 0; i < 300; ++i) model = session.go(true, 1.5);
    EXPECT_FLOAT_EQ(model.force_N.values.back(), 1.5f);
    EXPECT_EQ(model.figures, PanelFigures());
    EXPECT_FALSE(model.savings);
    EXPECT_TRUE(model.tick_us.values.empty());
    EXPECT_TRUE(model.frame_ms.values.empty());
    EXPECT_TRUE(model.warnings.empty());
}

}  // namespace burin::session
