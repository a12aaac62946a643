// SPDX-License-Identifier: MIT
// How a display of its own, its mode and its plane are chosen; without any display.
#include <gtest/gtest.h>

#include "gpu/display_choice.hpp"

namespace burin::gpu {

TEST(DisplayChoice, TakesADisplayByItsNameItsPlaceOrAPartOfItsName) {
    const std::vector<std::string> names{"Desk 2000 (DP-0)", "Projector (HDMI-0)", "Projector (HDMI-1)", "2"};
    EXPECT_EQ(choose_display(names, ""), 0);
    EXPECT_EQ(choose_display(names, "1"), 1);
    EXPECT_EQ(choose_display(names, "2"), 3) << "a whole name goes before a place";
    EXPECT_EQ(choose_display(names, "Projector"), 1) << "the first of two";
    EXPECT_EQ(choose_display(names, "HDMI-1"), 2);
    EXPECT_EQ(choose_display(names, "VGA"), -1);
    EXPECT_EQ(choose_display(names, "2000"), -1) << "a number is a place, not a part of a name";
    EXPECT_EQ(choose_display(names, "99999999999999999999999"), -1);
    EXPECT_EQ(choose_display({}, ""), -1);
    EXPECT_EQ(choose_display({}, "0"), -1);
}

TEST(DisplayChoice, TakesTheModeOfTheRightSizeAndTheNearestRate) {
    const std::vector<DisplayMode> modes{
        {1920, 1080, 60.0, true}, {1920, 1080, 120.0, false}, {1280, 720, 60.0, true}, {1920, 1080, 24.0, true}};
    EXPECT_EQ(choose_mode(modes, {.width = 1920, .height = 1080}), 1) << "the fastest";
    EXPECT_EQ(choose_mode(modes, {.width = 1920, .height = 1080, .refresh_Hz = 50.0}), 0);
    EXPECT_EQ(choose_mode(modes, {.width = 1920, .height = 1080, .stereo = DisplayStereo::hdmi_3d}), 0);
    EXPECT_EQ(choose_mode(modes, {.width = 1920, .refresh_Hz = 120.0, .stereo = DisplayStereo::onboard_din}), 1);
    EXPECT_EQ(choose_mode(modes, {.width = 1280}), 2);
    EXPECT_EQ(choose_mode(modes, {.width = 640}), -1);
    EXPECT_EQ(choose_mode({{800, 600, 60.0, false}}, {.stereo = DisplayStereo::hdmi_3d}), -1);
    EXPECT_EQ(choose_mode({}, {}), -1);
}

TEST(DisplayChoice, TakesThePlaneThatIsOnTheDisplayOrAFreeOneThatHoldsThePicture) {
    const DisplayPlane elsewhere{.reaches = true, .taken = true}, cannot{.reaches = false}, free{.reaches = true};
    const DisplayPlane on_it{.reaches = true, .shows = true};
    const DisplayPlane small{.reaches = true, .most_width = 256, .most_height = 256};
    EXPECT_EQ(choose_plane({elsewhere, cannot, free, on_it}, 1920, 1080), 3);
    EXPECT_EQ(choose_plane({elsewhere, cannot, small, free, free}, 1920, 1080), 3);
    EXPECT_EQ(choose_plane({small}, 256, 256), 0);
    EXPECT_EQ(choose_plane({elsewhere, cannot, small}, 1920, 1080), -1);
    EXPECT_EQ(choose_plane({}, 1, 1), -1);
}

TEST(DisplayChoice, AsksAPlaneOnlyForAnAlphaThatItHas) {
    EXPECT_EQ(choose_alpha(0b1111), 0b0001u);
    EXPECT_EQ(choose_alpha(0b1100), 0b0100u);
    EXPECT_EQ(choose_alpha(0b0010), 0b0010u);
    EXPECT_EQ(choose_alpha(0), 0b0001u) << "a plane that does not say is asked for an opaque picture";
}

TEST(DisplayChoice, ListsModesBySizeForPeople) {
    EXPECT_EQ(listed({{1920, 1080, 60.0, false}, {1280, 720, 60.0, true}, {1920, 1080, 24.0, true}}),
              "1920 x 1080 at 60, 24 Hz (HDMI 3D at 24 Hz); 1280 x 720 at 60 Hz (HDMI 3D at 60 Hz)");
    std::vector<DisplayMode> many;
    for (std::uint32_t i = 1; i <= 11; ++i) many.push_back({100 * i, 100, 59.94, false});
    EXPECT_TRUE(listed(many).ends_with("800 x 100 at 59.94 Hz; and 3 more sizes")) << listed(many);
    EXPECT_EQ(listed({}), "");
}

}  // namespace burin::gpu
