// SPDX-License-Identifier: MIT
// What a frame of several screens costs besides their pictures: submissions and waits do not grow with the screens.
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/core.hpp"
#include "tests/desk/played_session.hpp"
#include "tests/support/places.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

class SessionFrame : public PlayedSession {
protected:
    struct Cost {
        std::vector<std::uint64_t> submissions, waits;  // of each frame
    };
    // Plays the script in a cave of four screens.
    Cost play_cave(const std::string& folder, bool offscreen) {
        DeskOptions cave;
        cave.offscreen = offscreen;
        cave.wall = std::string(kWallsFolder) + "/cave.toml";
        cave.stereo = "side_by_side_half";
        cave.windowed = true;
        cave.width = 120;
        cave.height = 80;
        Cost cost;
        std::uint64_t submitted = 0, waits = 0;
        const Played played = play(folder, cave, [&](int, Presenter& stage) {
            const gpu::Core& core = *stage.device().core();
            cost.submissions.push_back(core.submitted - std::exchange(submitted, core.submitted));
            cost.waits.push_back(core.waits - std::exchange(waits, core.waits));
            surface_ = stage.surface().store()->work();
        });
        EXPECT_TRUE(played.outcome) << played.outcome.error().line();
        return cost;
    }

    renderer::SurfaceStore::Work surface_;
};

std::uint64_t median(std::vector<std::uint64_t> counts) {
    std::ranges::sort(counts);
    return counts[counts.size() / 2];
}

}  // namespace

TEST_F(SessionFrame, OfFourScreensIsOneSubmissionAndOneWaitUnlessItIsPhotographed) {
    const Cost cost = play_cave("a", true);
    const std::vector<std::uint64_t>& frames = cost.submissions;
    ASSERT_GT(frames.size(), 20u);
    EXPECT_EQ(median(frames), 1u);
    EXPECT_EQ(median(cost.waits), 1u);
    // Three frames take a screenshot of each screen; the first one prepares the device.
    EXPECT_LE(std::ranges::count_if(frames, [](std::uint64_t n) { return n > 1; }), 4);
    EXPECT_GT(surface_.uploads, 1u);
    EXPECT_LE(surface_.uploads, frames.size());
}

// Which eye an interlaced row belongs to depends on where the window is on its monitor.
TEST_F(SessionFrame, OfAWindowThatIsMovedIsAnotherOneOnlyWhereItsPlaceChoosesTheEyes) {
    const auto idle_frames = [&](const std::string& folder, const char* mode) {
        DeskOptions shown;
        shown.offscreen = true;
        shown.stereo = mode;
        shown.width = 240;
        shown.height = 160;
        std::uint64_t before = 0;
        int idle = 0;
        const Played played = play(folder, shown, [&](int frame, Presenter& stage) {
            const std::uint64_t now = stage.device().core()->submitted;
            if (frame > 0 && now == before) ++idle;
            before = now;
            wall::OutputPlace place = stage.place();
            place.monitor_y = frame;
            stage.put(0, place);
        });
        EXPECT_TRUE(played.outcome) << played.outcome.error().line();
        return idle;
    };
    EXPECT_GT(idle_frames("a", "mono"), 5);
    EXPECT_EQ(idle_frames("b", "row_interlaced"), 0);
}

TEST_F(SessionFrame, OfFourWindowsIsOneSubmissionMoreForEachAndStillOneWait) {
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    const Cost cost = play_cave("a", false);
    ASSERT_GT(cost.submissions.size(), 20u);
    EXPECT_LE(median(cost.submissions), 5u);
    EXPECT_EQ(median(cost.waits), 1u);
}

}  // namespace burin::session
