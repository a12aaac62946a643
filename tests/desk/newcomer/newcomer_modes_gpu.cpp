// SPDX-License-Identifier: MIT
// A newcomer's shorter walk where the window is another one: letters twice as large, each stereo mode, a cave's windows
// on one monitor.
#include "tests/desk/newcomer/newcomer_desk.hpp"
#include "tests/support/places.hpp"

namespace burin::session {
namespace {

class NewcomerElsewhere : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
};

// Takes up a tool on the panel, cuts along 10 mm at this place across, and takes it back.
void cut_and_undo(NewcomerDesk& desk, const std::string& name, double x_mm) {
    const double volume = desk.volume_mm3();
    const Image before = desk.picture(name + "-before");
    desk.press_button("tool cylinder");
    desk.stroke({{x_mm, 6, kFoot_mm}, {x_mm, 16, kFoot_mm}});
    const Image after = desk.picture(name + "-cut");
    EXPECT_NEAR(volume - desk.volume_mm3(), 155.0, 40.0) << name;
    EXPECT_GT(changed(before, after, desk.around_mm({x_mm, 4, kFoot_mm}, 3)), 0.3) << name;
    desk.press_button("undo");
    EXPECT_EQ(desk.volume_mm3(), volume) << name;
}

}  // namespace

TEST_F(NewcomerElsewhere, WorksInEachStereoModeChosenOnThePanel) {
    NewcomerDesk desk;
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        const std::string name(file_name_of(mode));
        if (mode != desk.viewer().output.mode) {
            desk.press_button("stereo-mode");
            desk.press_button("stereo-mode " + name);
        }
        ASSERT_EQ(desk.viewer().output.mode, mode);
        cut_and_undo(desk, name, 30.0);
    }
}

TEST_F(NewcomerElsewhere, WorksWithLettersTwiceAsLarge) {
    DeskOptions shown;
    shown.panel_scale = 2.0;
    NewcomerDesk desk(shown);
    desk.picture("192-opened");
    cut_and_undo(desk, "192", 30.0);
}

TEST_F(NewcomerElsewhere, WorksInACavesWindowsOnOneMonitor) {
    DeskOptions shown;
    shown.wall = std::string(kWallsFolder) + "/cave.toml";
    shown.windowed = true;
    NewcomerDesk desk(shown);
    cut_and_undo(desk, "cave", 30.0);
}

}  // namespace burin::session
