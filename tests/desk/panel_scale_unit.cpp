// SPDX-License-Identifier: MIT
// Traps of displays: letters for small pixels, and letters of other scripts.
#include <gtest/gtest.h>

#include "desk/live/opened_desk.hpp"
#include "desk/panel/live_panel.hpp"
#include "session/live/opened_room.hpp"
#include "tests/desk/panel_models.hpp"

namespace burin::session {
namespace {

DeskRoom desk_of_scale(std::optional<double> scale) {
    SessionSetup options;
    options.desk.panel_scale = scale;
    options.desk.width = 3840;
    options.desk.height = 2160;
    return open_desk(options, session_wall(options.desk).value(), open_room(options).value().room);
}

// Returns whether the panel has letters for the text; what it lacks it tells.
std::string notice_for(const std::string& name) {
    Panel panel = Panel::create({.size = {340, 900}}).value();
    PanelModel model = idle_model();
    model.workpiece.name = name;
    static_cast<void>(panel.show(model, 0));
    return panel.notice();
}

}  // namespace

TEST(PanelScale, OfTwoMakesThePanelTwiceAsWideAsOn96Dpi) {
    const ImageSize uhd{3840, 2160};
    const DeskRoom usual = desk_of_scale(std::nullopt), large = desk_of_scale(2.0);
    EXPECT_EQ(panel_width(usual, uhd, uhd), 340u);
    EXPECT_EQ(panel_width(large, uhd, uhd), 680u);
    EXPECT_DOUBLE_EQ(large.free_width, 1.0 - 680.0 / 3840.0) << "the workpiece stands beside it";
    EXPECT_EQ(panel_width(large, {1280, 720}, {1280, 720}), 640u) << "no more than half of a window";
    Panel panel = Panel::create({.size = {680, 2160}, .scale = 2.0}).value();
    PanelModel model = idle_model();
    static_cast<void>(panel.show(model, 0));
    Panel small = Panel::create({.size = {340, 1080}}).value();
    static_cast<void>(small.show(model, 0));
    const auto wide = panel.place_of("operation cut"), narrow = small.place_of("operation cut");
    ASSERT_TRUE(wide && narrow);
    EXPECT_NEAR(wide->width, 2.0 * narrow->width, 4.0);
    EXPECT_NEAR(wide->height, 2.0 * narrow->height, 2.0);
}

TEST(PanelScale, MakesCapitalsReadableFromWhereTheyAreRead) {
    // 3 m before a wall of 3.05 m and 1920 pixels: 21 minutes of arc are 18.3 mm, 11.5 pixels, and capitals are 9.6 at
    // scale 1.
    EXPECT_NEAR(panel_scale(3.0, 3.05 / 1920.0), 1.2, 0.01);
    EXPECT_DOUBLE_EQ(panel_scale(6.0, 0.001), 2.0 * panel_scale(3.0, 0.001));
}

TEST(PanelLetters, OfChineseNamesAreShownWhereAFontHasThem) {
    const std::string notice = notice_for("\xE9\x9B\x95\xE5\x88\xBB.stl");
    if (!notice.empty()) GTEST_SKIP() << "no installed font has Chinese letters: " << notice;
    Panel panel = Panel::create({.size = {340, 900}}).value();
    PanelModel model = idle_model();
    static_cast<void>(panel.show(model, 0));
    const std::uint64_t before = panel.atlases();
    model.workpiece.name = "\xE9\x9B\x95\xE5\x88\xBB.stl";
    static_cast<void>(panel.show(model, 1));
    EXPECT_EQ(panel.atlases(), before + 1) << "the letters were taken from another font";
}

TEST(PanelLetters, ThatNoFontHasAreToldOnce) {
    // A place of the private area, U+E7A3, which no font of a script has.
    EXPECT_FALSE(notice_for("\xEE\x9E\xA3.stl").empty());
    EXPECT_EQ(notice_for("part.stl"), "");
}

}  // namespace burin::session
