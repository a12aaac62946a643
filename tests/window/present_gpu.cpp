// SPDX-License-Identifier: MIT
// Pictures to a window, in every mode and through every mishap, with validation on.
#include <array>

#include "gpu/direct_display.hpp"
#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "renderer/output/output_stage.hpp"
#include "tests/renderer/output/output_pictures.hpp"
#include "tests/window/window_test.hpp"

namespace burin::window {

namespace {

using gpu::FrameAnswer;

ImageSize size_of(const gpu::SwapchainFrame& frame) { return {frame.width, frame.height}; }

}  // namespace

class PresentPictures : public PresentTest {
protected:
    void SetUp() override {
        PresentTest::SetUp();
        if (IsSkipped()) return;
        window_.emplace(open({.width = 96, .height = 64}));
        chain_.emplace(chain_for(*window_));
        auto stage = renderer::OutputStage::create(device(), chain_->format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
        ASSERT_TRUE(stage) << stage.error().line();
        stage_.emplace(std::move(*stage));
        auto eyes = renderer::upload_eyes(device(), left_, right_);
        ASSERT_TRUE(eyes);
        eyes_ = std::move(*eyes);
    }
    void TearDown() override {
        eyes_ = {};
        stage_.reset();
        chain_.reset();
        window_.reset();
        PresentTest::TearDown();
    }

    wall::OutputPlace place(const gpu::SwapchainFrame& frame) const {
        const auto at = window_->on_monitor();
        return {.size = size_of(frame), .monitor_x = at.x, .monitor_y = at.y};
    }

    // One picture. The answer is that of acquire() where there was none to draw into.
    gpu::FrameAnswer show(const wall::OutputSettings& settings) {
        const gpu::SwapchainFrame frame = acquire(*chain_, *window_);
        if (frame.answer != gpu::FrameAnswer::presented) return frame.answer;
        auto commands = gpu::Commands::begin(device());
        if (!commands) return chain_->abandon(frame);
        const auto done =
            stage_->record(*commands, {eyes_.view(), left_.size}, {frame.views[0], place(frame)}, settings);
        if (!done) return chain_->abandon(frame);
        const auto submission = std::move(*commands).submit(frame.sync);
        last_ = frame;
        return submission ? chain_->present(frame) : chain_->abandon(frame);
    }

    // Pictures until one is shown.
    gpu::FrameAnswer show_through_resizing(const wall::OutputSettings& settings) {
        gpu::FrameAnswer answer = show(settings);
        for (int i = 0; i < 10 && answer == gpu::FrameAnswer::resized; ++i) answer = show(settings);
        return answer;
    }

    Image left_ = renderer::marked_gradient({96, 64}, wall::Eye::left),
          right_ = renderer::marked_gradient({96, 64}, wall::Eye::right);
    std::optional<Window> window_;
    std::optional<gpu::Swapchain> chain_;
    std::optional<renderer::OutputStage> stage_;
    gpu::Image eyes_;
    gpu::SwapchainFrame last_;
};

TEST_F(PresentPictures, ShowsAHundredFramesInEachMode) {
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        const std::uint64_t before = chain_->presented();
        for (int i = 0; i < 100; ++i) ASSERT_EQ(show(settings), gpu::FrameAnswer::presented) << file_name_of(mode) << i;
        EXPECT_EQ(chain_->presented(), before + 100);
    }
}

TEST_F(PresentPictures, HandsOverWhatTheReferenceSaysAtAnOddPlace) {
    if (!chain_->can_copy_from()) GTEST_SKIP() << "this surface's images cannot be read back";
    window_->set_position(101, 53);
    ASSERT_TRUE(next<MoveEvent>(*window_, [](const MoveEvent& e) { return e.x == 101 && e.y == 53; }));
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::row_interlaced;
    ASSERT_EQ(show_through_resizing(settings), gpu::FrameAnswer::presented);
    ASSERT_TRUE(device().wait_idle());
    const auto shown =
        renderer::read_back(device(), last_.raw, size_of(last_), chain_->format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    ASSERT_TRUE(shown);
    wall::OutputPlace at{.size = {96, 64}, .monitor_x = 101, .monitor_y = 53};
    EXPECT_EQ(renderer::greatest_difference(*shown, renderer::compose(left_, right_, settings, at)), 0);
    at.monitor_y = 54;
    EXPECT_GT(renderer::greatest_difference(*shown, renderer::compose(left_, right_, settings, at)), 50)
        << "a row off is the other eye";
}

TEST_F(PresentPictures, KnowsHowOldAnImageIs) {
    const wall::OutputSettings settings;
    for (int i = 0; i < 12; ++i) {
        ASSERT_EQ(show(settings), gpu::FrameAnswer::presented);
        EXPECT_LE(last_.age, chain_->presented() - 1);
        EXPECT_TRUE(i > 0 || last_.age == 0) << "nothing was in it";
        EXPECT_TRUE(i < 8 || last_.age >= 1);
    }
}

TEST_F(PresentPictures, SurvivesAStormOfSizes) {
    const wall::OutputSettings settings;
    int resized = 0;
    for (int i = 0; i < 40; ++i) {
        window_->set_size(50 + 37 * i % 400, 40 + 53 * i % 300);
        static_cast<void>(window_->poll());
        resized += show(settings) == gpu::FrameAnswer::resized ? 1 : 0;
    }
    EXPECT_GT(resized, 10);
    window_->set_size(210, 130);
    ASSERT_TRUE(next<ResizeEvent>(*window_, [](const ResizeEvent& e) { return e.width == 210 && e.height == 130; }));
    ASSERT_EQ(show_through_resizing(settings), gpu::FrameAnswer::presented);
    EXPECT_EQ(chain_->width(), 210u);
    EXPECT_EQ(chain_->height(), 130u);
}

TEST_F(PresentPictures, DrawsNothingWhileThereIsNoAreaAndGoesOnAfterwards) {
    const wall::OutputSettings settings;
    ASSERT_EQ(show(settings), gpu::FrameAnswer::presented);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(chain_->acquire(0, 0).answer, gpu::FrameAnswer::minimised);
    EXPECT_EQ(chain_->acquire(96, 0).answer, gpu::FrameAnswer::minimised);
    ASSERT_EQ(show_through_resizing(settings), gpu::FrameAnswer::presented);
    window_->set_visible(false);
    static_cast<void>(window_->wait(0.05));
    static_cast<void>(show_through_resizing(settings));  // whatever the display says to a hidden window, it is no crash
    window_->set_visible(true);
    static_cast<void>(window_->wait(0.05));
    EXPECT_EQ(show_through_resizing(settings), gpu::FrameAnswer::presented);
}

TEST_F(PresentPictures, GivesBackAFrameThatWasNotDrawn) {
    const gpu::SwapchainFrame frame = acquire(*chain_, *window_);
    ASSERT_EQ(frame.answer, gpu::FrameAnswer::presented);
    EXPECT_EQ(chain_->abandon(frame), gpu::FrameAnswer::resized);
    EXPECT_EQ(show_through_resizing({}), gpu::FrameAnswer::presented);
}

TEST_F(PresentPictures, SaysWhenTheDeviceIsLostAndANewOneGoesOn) {
    ASSERT_EQ(show({}), gpu::FrameAnswer::presented);
    device().core()->lose_at_next_submit = true;
    EXPECT_EQ(show({}), gpu::FrameAnswer::device_lost);
    EXPECT_TRUE(device().lost());
    EXPECT_EQ(show({}), gpu::FrameAnswer::device_lost);
    auto commands = gpu::Commands::begin(device());
    ASSERT_TRUE(commands);
    const auto refused = std::move(*commands).submit();
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("device lost"));
    // As a session does: drop what was made on it, and begin again in the same window.
    eyes_ = {};
    stage_.reset();
    chain_.reset();
    PresentTest::TearDown();
    PresentTest::SetUp();
    chain_.emplace(chain_for(*window_));
    stage_.emplace(renderer::OutputStage::create(device(), chain_->format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR).value());
    eyes_ = renderer::upload_eyes(device(), left_, right_).value();
    EXPECT_EQ(show_through_resizing({}), gpu::FrameAnswer::presented);
}

TEST_F(PresentPictures, TwoWindowsTakeAnEyeEach) {
    Window second = open({.width = 96, .height = 64, .x = 400, .y = 10});
    gpu::Swapchain other_chain = chain_for(second);
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::two_windows;
    for (int i = 0; i < 10; ++i) {
        ASSERT_EQ(show(settings), gpu::FrameAnswer::presented);
        const gpu::SwapchainFrame frame = acquire(other_chain, second);
        ASSERT_EQ(frame.answer, gpu::FrameAnswer::presented);
        auto commands = gpu::Commands::begin(device());
        ASSERT_TRUE(commands);
        ASSERT_TRUE(stage_->record(*commands, {eyes_.view(), left_.size},
                                   {frame.views[0], {.size = size_of(frame), .eye = wall::Eye::right}}, settings));
        ASSERT_TRUE(std::move(*commands).submit(frame.sync));
        ASSERT_EQ(other_chain.present(frame), gpu::FrameAnswer::presented);
    }
    ASSERT_TRUE(device().wait_idle());
}

}  // namespace burin::window
