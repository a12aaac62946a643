// SPDX-License-Identifier: MIT
#include "desk/draw/drawn_detail.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace burin::session {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

// A session's frames before a device on which a full picture takes so long, and one of larger pixels as much less as it
// has fewer of them, beside what triangles take in any case.
struct DrawnFrames {
    Nanoseconds full_ns = 100 * kMs, triangles_ns = 5 * kMs;
    DetailState state{};
    Nanoseconds now_ns = 1000 * kMs;
    std::optional<WholePicture> last{};

    std::uint32_t frame(bool moves, bool in_full = false) {
        const std::uint32_t before = state.pixel;
        const DetailStep step = step_detail(state, {now_ns, in_full, moves, last});
        state = step.state;
        last.reset();
        Nanoseconds took_ns = 1 * kMs;
        if (moves || step.pixel != before) {
            took_ns = triangles_ns + (full_ns - triangles_ns) / (step.pixel * step.pixel);
            last = WholePicture{step.pixel, took_ns};
        }
        now_ns += std::max(took_ns, 16 * kMs);
        return step.pixel;
    }
    std::vector<std::uint32_t> motion(int frames) {
        std::vector<std::uint32_t> pixels;
        for (int i = 0; i < frames; ++i) pixels.push_back(frame(true));
        return pixels;
    }
    void rest() {
        for (int i = 0; i < 30; ++i) static_cast<void>(frame(false));
    }
};

bool only_grows(const std::vector<std::uint32_t>& pixels) { return std::ranges::is_sorted(pixels); }

}  // namespace

TEST(DrawnDetail, APictureIsFullUntilTheViewMoves) {
    DrawnFrames frames;
    EXPECT_EQ(frames.frame(false), 1u);
    EXPECT_FALSE(owes_full_picture(frames.state));
    EXPECT_EQ(frames.frame(true), 2u);
    EXPECT_TRUE(owes_full_picture(frames.state));
}

TEST(DrawnDetail, AViewThatRestsIsDrawnInFullOnce) {
    DrawnFrames frames;
    frames.motion(20);
    std::vector<std::uint32_t> after;
    for (int i = 0; i < 40; ++i) after.push_back(frames.frame(false));
    EXPECT_EQ(after.front(), 2u) << "a hand that drags pauses";
    EXPECT_EQ(after.back(), 1u);
    EXPECT_TRUE(std::ranges::is_sorted(after, std::greater{})) << "it was coarse again before it moved";
    EXPECT_FALSE(owes_full_picture(frames.state));
}

TEST(DrawnDetail, AHandThatPausesShortlyDoesNotMakeThePictureFlicker) {
    DrawnFrames frames;
    std::vector<std::uint32_t> pixels;
    for (int i = 0; i < 200; ++i) pixels.push_back(frames.frame(i % 8 == 0));  // every 128 ms
    EXPECT_EQ(std::ranges::count(pixels, 1u), 0);
}

TEST(DrawnDetail, PixelsGrowWhereFramesStayLateAndNeverBeyondTheLargest) {
    DrawnFrames frames{.full_ns = 400 * kMs, .triangles_ns = 50 * kMs};
    const std::vector<std::uint32_t> pixels = frames.motion(50);
    EXPECT_EQ(pixels.front(), 2u);
    EXPECT_EQ(pixels.back(), kMostPixel);
    EXPECT_TRUE(only_grows(pixels));
    frames.rest();
    EXPECT_EQ(frames.frame(true), kMostPixel) << "the next motion begins as the last one ended";
}

TEST(DrawnDetail, OneLateFrameIsAHitch) {
    DrawnFrames frames;
    frames.motion(5);
    frames.full_ns = 600 * kMs;
    frames.motion(1);
    frames.full_ns = 100 * kMs;
    const std::vector<std::uint32_t> pixels = frames.motion(20);
    EXPECT_EQ(pixels.back(), 2u);
}

TEST(DrawnDetail, AMachineThatDrawsInTimeIsSparedLargerPixels) {
    DrawnFrames frames{.full_ns = 20 * kMs};
    frames.frame(true);  // nothing is known of it yet
    frames.rest();
    EXPECT_EQ(frames.motion(20), std::vector<std::uint32_t>(20, 1u));
}

TEST(DrawnDetail, PicturesToKeepAreFullWhateverTheyTake) {
    DrawnFrames frames{.full_ns = 4000 * kMs};
    for (int i = 0; i < 50; ++i) EXPECT_EQ(frames.frame(i % 3 > 0, true), 1u);
    EXPECT_FALSE(owes_full_picture(frames.state));
}

RC_GTEST_PROP(DrawnDetail, NeverGoesBackAndForthWithinOneMotion, ()) {
    DrawnFrames frames{.full_ns = *rc::gen::inRange<Nanoseconds>(1, 900) * kMs,
                       .triangles_ns = *rc::gen::inRange<Nanoseconds>(0, 60) * kMs};
    for (int motion = 0; motion < 5; ++motion) {
        std::vector<std::uint32_t> pixels;
        for (int i = 0; i < 30; ++i) {
            frames.full_ns =
                std::max(frames.triangles_ns + 1, frames.full_ns + *rc::gen::inRange<Nanoseconds>(-9, 10) * kMs);
            pixels.push_back(frames.frame(*rc::gen::inRange(0, 4) > 0));
        }
        // Frames that rest within it are drawn as those around them.
        const auto first = std::ranges::find_if(pixels, [](std::uint32_t p) { return p > 1; });
        RC_ASSERT(only_grows({first, pixels.end()}));
        frames.rest();
        RC_ASSERT(frames.frame(false) == 1u);
    }
}

}  // namespace burin::session
