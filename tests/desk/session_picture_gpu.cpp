// SPDX-License-Identifier: MIT
// What a screen's picture reports as changed: the outputs keep all else as they showed it last.
#include "desk/draw/session_picture.hpp"

#include <gtest/gtest.h>

#include "tests/gpu/test_device.hpp"

namespace burin::session {
namespace {

constexpr ImageSize kSize{240, 180};

class ScreenPicture : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        surface_ = std::make_shared<renderer::SurfaceStore>(device());
        auto made = SessionPicture::create(device(), 1, surface_);
        ASSERT_TRUE(made) << made.error().line();
        picture_.emplace(std::move(*made));
    }
    void TearDown() override {
        picture_.reset();
        surface_.reset();
        gpu::DeviceTest::TearDown();
    }
    // Draws the scene, or darkness, and returns what has changed.
    std::vector<PixelRect> changed_by(const std::optional<picture::Picture>& scene) {
        auto commands = gpu::Commands::begin(device());
        EXPECT_TRUE(commands && surface_->flush(*commands));
        const auto drawn = picture_->draw(*commands, scene, kSize, kMono);
        EXPECT_TRUE(drawn) << drawn.error().line();
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        return picture_->changed({.size = kSize}, kMono);
    }
    static constexpr wall::OutputSettings kMono{};

private:
    std::shared_ptr<renderer::SurfaceStore> surface_;
    std::optional<SessionPicture> picture_;
};

}  // namespace

// As where a tracked head steps behind a screen and comes back.
TEST_F(ScreenPicture, IsNewAllOverWhereItTurnsDarkAndWhereItEndsBeingDark) {
    picture::Picture scene;
    scene.viewer.head_world.position_m = {0.0, 1.6, 2.0};
    const std::vector<PixelRect> all{all_of(kSize)};
    EXPECT_EQ(changed_by(scene), all);
    EXPECT_TRUE(changed_by(scene).empty());
    for (int time = 0; time < 2; ++time) {
        EXPECT_EQ(changed_by(std::nullopt), all);
        EXPECT_TRUE(changed_by(std::nullopt).empty()) << "it is dark already";
        EXPECT_EQ(changed_by(scene), all) << "what was dark would stay so";
        EXPECT_TRUE(changed_by(scene).empty());
    }
}

}  // namespace burin::session
