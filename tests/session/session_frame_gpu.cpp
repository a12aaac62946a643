// SPDX-License-Identifier: MIT
// What a frame of several screens costs besides their pictures: submissions and waits do not grow with the screens.
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/core.hpp"
#include "tests/session/played_session.hpp"
#include "tests/window/xvfb.hpp"

namespace burin::session {
namespace {

class SessionFrame : public PlayedSession {
protected:
    // Plays the script in a cave of four screens and returns the submissions of each frame.
    std::vector<std::uint64_t> submissions(const std::string& folder, bool offscreen) {
        LiveOptions cave;
        cave.offscreen = offscreen;
        cave.wall = std::string(BURIN_WALLS) + "/cave.toml";
        cave.stereo = "side_by_side_half";
        cave.windowed = true;
        cave.width = 120;
        cave.height = 80;
        std::vector<std::uint64_t> frames;
        std::uint64_t before = 0;
        const Played played = play(folder, cave, [&](int, Presenter& stage) {
            const std::uint64_t now = stage.device().core()->submitted;
            frames.push_back(now - std::exchange(before, now));
            surface_ = stage.surface().store()->work();
        });
        EXPECT_TRUE(played.outcome) << played.outcome.error().line();
        return frames;
    }

    renderer::SurfaceStore::Work surface_;
};

}  // namespace

TEST_F(SessionFrame, OfFourScreensIsOneSubmissionUnlessItIsPhotographed) {
    std::vector<std::uint64_t> frames = submissions("a", true);
    ASSERT_GT(frames.size(), 20u);
    std::ranges::sort(frames);
    EXPECT_EQ(frames[frames.size() / 2], 1u);
    // Three frames take a screenshot of each screen; the first one prepares the device.
    EXPECT_LE(std::ranges::count_if(frames, [](std::uint64_t n) { return n > 1; }), 4);
    EXPECT_GT(surface_.uploads, 1u);
    EXPECT_LE(surface_.uploads, frames.size());
}

TEST_F(SessionFrame, OfFourWindowsIsOneSubmissionMoreForEach) {
    if (window::Xvfb::running().name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    std::vector<std::uint64_t> frames = submissions("a", false);
    ASSERT_GT(frames.size(), 20u);
    std::ranges::sort(frames);
    EXPECT_LE(frames[frames.size() / 2], 5u);
}

}  // namespace burin::session
