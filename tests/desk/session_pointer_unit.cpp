// SPDX-License-Identifier: MIT
// Where the mouse and a wand point on the panel, and that it is what is seen under the mouse in every stereo mode.
#include <gtest/gtest.h>

#include <random>

#include "desk/panel/panel_pointer.hpp"
#include "renderer/output/compose.hpp"
#include "wall/output_settings.hpp"
#include "wall/projection.hpp"

namespace burin::session {
namespace {

// A panel of 200 x 400 pixels, 0.5 m wide, a metre before the wall and turned.
const picture::PanelStand kStand =
    picture::stand_of_width({{0.4, 1.2, 1.0}, glm::angleAxis(-0.3, Vec3(0, 1, 0))}, 0.5, ImageSize{200, 400});
const ImageSize kPanel{200, 400};

Vec3 on_panel(const Vec2& px) {
    return kStand.world_from_panel *
           Vec3((px.x / kPanel.width - 0.5) * kStand.size_m.x, (0.5 - px.y / kPanel.height) * kStand.size_m.y, 0.0);
}

template <typename Event>
std::vector<Event> only_of(const std::vector<InputEvent>& events) {
    std::vector<Event> found;
    for (const InputEvent& event : events)
        if (const auto* e = std::get_if<Event>(&event.input)) found.push_back(*e);
    return found;
}

}  // namespace

TEST(PanelPointer, TheMouseIsWhereTheEyesSeeIt) {
    const Vec3 eye_world{0.1, 1.7, 2.5};
    wall::OutputSettings output;
    output.mode = wall::StereoMode::mono;
    const MouseView mouse{wall::screen_of(wall::Wall{}), {eye_world, eye_world}, output, {.size = {1280, 960}}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.02, 0.98);
    for (int i = 0; i < 100; ++i) {
        const Vec2 wanted{part(random) * kPanel.width, part(random) * kPanel.height};
        // Where the line from the eye through that point of the panel meets the wall, in the plane z = 0.
        const Vec3 at = on_panel(wanted);
        const Vec3 wall = eye_world + (at - eye_world) * (eye_world.z / (eye_world.z - at.z));
        const Vec2 px{(wall.x / 3.048 + 0.5) * 1280.0, (1.0 - wall.y / 2.286) * 960.0};
        const std::vector<InputEvent> events{{0, MouseMove{px}}};
        const Pointed pointed = point_at_panel({}, events, kStand, kPanel, mouse);
        ASSERT_TRUE(pointed.pointer.over);
        const auto moves = only_of<MouseMove>(pointed.panel);
        ASSERT_EQ(moves.size(), 1u);
        EXPECT_LT(glm::length(moves[0].position_px - wanted), 1e-6);
    }
}

TEST(PanelPointer, AWandThatPressesThePanelDoesNotGrabTheScene) {
    const auto wand = [](const Vec3& at) { return WandInput{0, {at + Vec3(0, 0, 1), Quat{1, 0, 0, 0}}, true}; };
    const std::vector<InputEvent> on{{0, wand(on_panel({50, 60}))}, {1, WandClick{0, 0, true}}};
    Pointed pointed = point_at_panel({}, on, kStand, kPanel, {});
    EXPECT_EQ(only_of<WandClick>(pointed.rest).size(), 0u);
    ASSERT_EQ(only_of<MouseClick>(pointed.panel).size(), 1u);
    EXPECT_LT(glm::length(only_of<MouseMove>(pointed.panel)[0].position_px - Vec2(50, 60)), 1e-6);
    // Released beside it: the panel is told, and the scene still is not.
    const std::vector<InputEvent> beside{
        {2, wand({-3, 1, 0})}, {3, WandClick{0, 0, false}}, {4, WandClick{0, 0, true}}};
    pointed = point_at_panel(pointed.pointer, beside, kStand, kPanel, {});
    ASSERT_EQ(only_of<MouseClick>(pointed.panel).size(), 1u);
    EXPECT_FALSE(only_of<MouseClick>(pointed.panel)[0].pressed);
    ASSERT_EQ(only_of<WandClick>(pointed.rest).size(), 1u) << "what begins beside the panel is the scene's";
    EXPECT_TRUE(only_of<WandClick>(pointed.rest)[0].pressed);
}

namespace {

// Apart far enough that the wrong eye is many pixels off.
const wall::Eyes kEyes{{-0.1, 1.7, 2.2}, {0.3, 1.75, 2.25}};
const wall::Screen kScreen = wall::screen_of(wall::Wall{});

// In pixels of an eye's picture, by the matrix with which it is drawn.
Vec2 projected(const Vec3& eye_world, const Vec3& at_world, ImageSize picture) {
    const auto clip = off_axis_projection(kScreen, eye_world, 0.1, 10.0) * glm::dvec4(at_world, 1.0);
    return (0.5 + 0.5 * Vec2(clip.x, clip.y) / clip.w) * Vec2(picture.width, picture.height);
}

// Black, but for the four pixels around a place.
Image lit_at(const Vec2& px, ImageSize size) {
    Image image{size, std::vector<std::uint8_t>(std::size_t{4} * size.width * size.height, 0)};
    const auto x0 = static_cast<std::size_t>(std::floor(px.x - 0.5)),
               y0 = static_cast<std::size_t>(std::floor(px.y - 0.5));
    for (const std::size_t y : {y0, y0 + 1})
        for (const std::size_t x : {x0, x0 + 1})
            for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * (y * size.width + x) + c] = 255;
    return image;
}

std::vector<Vec2> lit_pixels(const Image& image) {
    std::vector<Vec2> lit;
    for (std::uint32_t y = 0; y < image.size.height; ++y)
        for (std::uint32_t x = 0; x < image.size.width; ++x)
            if (const std::uint8_t* p = image.pixel(x, y); p[0] + p[1] + p[2] > 0) lit.emplace_back(x + 0.5, y + 0.5);
    return lit;
}

bool both_look_at_once(wall::StereoMode mode) {
    switch (mode) {
        case wall::StereoMode::anaglyph_red_cyan:
        case wall::StereoMode::anaglyph_green_magenta:
        case wall::StereoMode::anaglyph_amber_blue:
        case wall::StereoMode::mono:
        case wall::StereoMode::frame_sequential:
        case wall::StereoMode::two_layers: return true;
        default: return false;
    }
}

std::vector<wall::OutputSettings> every_way_to_show() {
    std::vector<wall::OutputSettings> all;
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        wall::OutputSettings settings;
        settings.mode = mode;
        all.push_back(settings);
        settings.swap_eyes = true;
        all.push_back(settings);
        settings.first_eye = wall::Eye::right;
        settings.homography = wall::homography_onto({Vec2{0.1, 0.05}, {0.95, 0.0}, {0.9, 0.97}, {0.0, 0.9}}).value();
        all.push_back(settings);
    }
    return all;
}

struct Shot {
    wall::Eye eye;
    wall::OutputPlace place;
    std::size_t lit = 0;
};

// Lights a point of the panel in one eye's picture, and points the mouse at every pixel of the output that is lit by
// it.
void expect_hit_where_lit(const wall::OutputSettings& output, Shot& shot, const Vec2& wanted) {
    const ImageSize size = wall::eye_size(output.mode, shot.place.size);
    const bool both = both_look_at_once(output.mode);
    const Vec3 middle = middle_of(kEyes), from = both                          ? middle
                                                 : shot.eye == wall::Eye::left ? kEyes.left_world
                                                                               : kEyes.right_world;
    const Vec2 at = projected(from, on_panel(wanted), size);
    const Image lit = lit_at(at, size), dark{size, std::vector<std::uint8_t>(lit.rgba.size(), 0)};
    const Image shown = renderer::compose(shot.eye == wall::Eye::left ? lit : dark,
                                          shot.eye == wall::Eye::right ? lit : dark, output, shot.place);
    const MouseView mouse{
        kScreen,
        kEyes,
        output,
        {.size = shot.place.size, .monitor_x = shot.place.monitor_x, .monitor_y = shot.place.monitor_y}};
    // A pixel of the output to each side, and what its own filter spreads.
    const Vec2 pixel = picture_px_per_px(output.mode) * (output.homography ? 2.3 : 1.0);
    for (Vec2 px : lit_pixels(shown)) {
        ++shot.lit;
        if (output.mode == wall::StereoMode::two_windows && shot.place.eye == wall::Eye::right)
            px.x += wall::kRightWindow_px;
        const std::vector<InputEvent> events{{0, MouseMove{px}}};
        const auto moves = only_of<MouseMove>(point_at_panel({}, events, kStand, kPanel, mouse).panel);
        ASSERT_EQ(moves.size(), 1u) << file_name_of(output.mode) << " misses at " << px.x << ", " << px.y;
        const Vec2 off = glm::abs(projected(from, on_panel(moves[0].position_px), size) - at);
        EXPECT_LE(off.x, pixel.x + 1e-6) << file_name_of(output.mode);
        EXPECT_LE(off.y, pixel.y + 1e-6) << file_name_of(output.mode);
    }
}

}  // namespace

TEST(PanelPointer, TheMouseMeetsWhatIsSeenUnderItInEveryModeAndEye) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0.2, 0.8);
    for (const wall::OutputSettings& output : every_way_to_show()) {
        for (const wall::Eye eye : {wall::Eye::left, wall::Eye::right}) {
            std::size_t lit = 0;
            for (int i = 0; i < 6; ++i) {
                const Vec2 wanted{part(random) * kPanel.width, part(random) * kPanel.height};
                for (const wall::Eye outlet : {wall::Eye::left, wall::Eye::right}) {
                    if (outlet == wall::Eye::right && !wall::shows_one_eye_at_a_time(output.mode)) continue;
                    Shot shot{eye, {.size = {161, 123}, .eye = outlet, .monitor_x = 3, .monitor_y = -6}};
                    expect_hit_where_lit(output, shot, wanted);
                    lit += shot.lit;
                    if (HasFatalFailure()) return;
                }
            }
            const bool never =
                (output.mode == wall::StereoMode::left || output.mode == wall::StereoMode::right) &&
                ((output.mode == wall::StereoMode::left) != (eye == wall::Eye::left)) != output.swap_eyes;
            const bool mono = output.mode == wall::StereoMode::mono && eye == wall::Eye::right;
            EXPECT_EQ(lit == 0, never || mono) << file_name_of(output.mode) << " shows neither";
        }
    }
}

TEST(PanelPointer, WhatIsDraggedOffAnEyesPictureStaysWithThatEye) {
    wall::OutputSettings output;
    output.mode = wall::StereoMode::side_by_side;
    const wall::OutputPlace place{.size = {1280, 480}};
    const std::vector<InputEvent> events{{0, MouseMove{{600, 100}}},
                                         {0, MouseClick{MouseButton::left, true, {}}},
                                         {0, MouseMove{{700, 100}}},
                                         {0, MouseClick{MouseButton::left, false, {}}},
                                         {0, MouseMove{{701, 100}}}};
    const auto moves = only_of<MouseMove>(mouse_on_picture({}, events, output, place).events);
    ASSERT_EQ(moves.size(), 3u);
    EXPECT_EQ(moves[0].position_px, Vec2(600, 100));
    EXPECT_EQ(moves[1].position_px, Vec2(700, 100)) << "beyond its right edge, not at the other's left one";
    EXPECT_EQ(moves[2].position_px, Vec2(61, 100));
    // A slider that is pulled beyond the panel is not told of a place beside it until it is let go.
    output.mode = wall::StereoMode::mono;
    const MouseView mouse{kScreen, kEyes, output, {.size = {1280, 960}}};
    const Vec2 on = projected(middle_of(kEyes), on_panel({150, 200}), {1280, 960});
    const std::vector<InputEvent> pulled{
        {0, MouseMove{on}}, {0, MouseClick{MouseButton::left, true, {}}}, {0, MouseMove{{0, 0}}}};
    Pointed pointed = point_at_panel({}, pulled, kStand, kPanel, mouse);
    EXPECT_EQ(only_of<MouseMove>(pointed.panel).size(), 1u);
    const std::vector<InputEvent> released{{1, MouseClick{MouseButton::left, false, {}}}};
    pointed = point_at_panel(pointed.pointer, released, kStand, kPanel, mouse);
    ASSERT_EQ(pointed.panel.size(), 2u);
    EXPECT_LT(std::get<MouseMove>(pointed.panel[0].input).position_px.x, 0.0) << "first: a button there is not pressed";
}

TEST(PanelPointer, OnADeskTheMouseMeetsThePanelOfEitherEye) {
    const ImageSize size{1000, 500};
    for (const wall::StereoMode mode : {wall::StereoMode::side_by_side, wall::StereoMode::side_by_side_half,
                                        wall::StereoMode::top_bottom, wall::StereoMode::top_bottom_half}) {
        wall::OutputSettings output;
        output.mode = mode;
        const ImageSize eye = wall::eye_size(mode, size);
        const Vec2 share = Vec2(eye.width, eye.height) / picture_px_per_px(mode);
        const bool above = mode == wall::StereoMode::top_bottom || mode == wall::StereoMode::top_bottom_half;
        const Vec2 place = 0.3 * share, second = above ? Vec2(0.0, share.y) : Vec2(share.x, 0.0);
        const std::vector<InputEvent> events{{0, MouseMove{place}}, {0, MouseMove{place + second}}};
        const auto moves = only_of<MouseMove>(mouse_on_picture({}, events, output, {.size = size}).events);
        ASSERT_EQ(moves.size(), 2u);
        for (const MouseMove& move : moves)
            EXPECT_LT(glm::length(move.position_px - 0.3 * Vec2(eye.width, eye.height)), 1e-9) << file_name_of(mode);
    }
}

}  // namespace burin::session
