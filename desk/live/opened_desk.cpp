// SPDX-License-Identifier: MIT
#include "desk/live/opened_desk.hpp"

#include "base/longest_side.hpp"
#include "base/try.hpp"
#include "desk/panel/live_panel.hpp"

namespace burin::session {
namespace {

// Returns how mouse and keys lead a hand: by the wheel in steps that suit how far it reaches.
DeskSettings settings_of(const HandRoom& hand, const SessionWall& wall) {
    constexpr double kOwnDepthPerWheelStep = 0.025;  // of the workspace's longest side, about as a stylus'
    constexpr double kArmDepthPerWheelStep_m = 0.01;
    DeskSettings settings;
    const Pose fallback = wall.setup.fallback_head_tracker;
    settings.home_head_world = {wall.setup.world_from_tracker * fallback.position_m,
                                wall.setup.world_from_tracker.orientation * fallback.orientation};
    if (wall.desk) settings.head_world = {{-2.0, 0.4, 0.3}, {2.0, 2.4, 6.0}};
    settings.workspace_m = hand.workspace_device_m;
    settings.rest_device = hand.rest_device;
    settings.leans_sideways = hand.is_upright;
    if (hand.reach == Reach::own)
        settings.depth_per_wheel_step_m = kOwnDepthPerWheelStep * longest_side_m({Vec3(0.0), hand.workspace_device_m});
    if (hand.reach == Reach::arm) settings.depth_per_wheel_step_m = kArmDepthPerWheelStep_m;
    return settings;
}

Vec3 across(const wall::Screen& screen) { return screen.lower_right_world - screen.lower_left_world; }

ImageSize asked_window(const DeskOptions& options) {
    return {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height)};
}

// The picture of one eye in the mode that the session begins with.
ImageSize eye_at_first(const DeskOptions& options) {
    const auto mode = options.stereo.empty() ? wall::StereoMode::mono
                                             : wall::parse_stereo_mode(options.stereo).value_or(wall::StereoMode::mono);
    return wall::eye_size(mode, asked_window(options));
}

// The share of a desktop window's picture beside the panel.
double free_width_at_first(const DeskOptions& options, const DeskRoom& desk) {
    if (!desk.wall.desk || desk.wall.has_panel_window()) return 1.0;
    return beside_panel(desk, eye_at_first(options), asked_window(options));
}

}  // namespace

DeskRoom open_desk(const SessionSetup& options, const SessionWall& wall, const Room& room) {
    DeskRoom desk;
    desk.wall = wall;
    if (const auto cannot = no_surface(options)) desk.no_surface = cannot->what;
    desk.offers_mouse = options.hands.mouse.has_value() && desk.no_surface.empty();
    desk.hands.clear();
    for (const HandRoom& hand : room.hands) desk.hands.push_back(settings_of(hand, wall));
    desk.panel_scale = options.desk.panel_scale.value_or(1.0);
    desk.first_steps = options.desk.first_steps;
    desk.frames_world = options.desk.frames_world;
    desk.free_width = free_width_at_first(options.desk, desk);
    if (room.carved_object) desk.mirror_panes = mirror_panes(*room.carved_object);
    if (!wall.desk || (room.mouse != MouseMode::surface && !desk.frames_world)) return desk;
    fit_desk_screen(desk.wall, eye_at_first(options.desk));
    // Before the middle of what the panel leaves free, so that nothing there is seen aslant.
    desk.hands.front().home_head_world.position_m -= 0.5 * (1.0 - desk.free_width) * across(desk.screen());
    return desk;
}

Result<wall::OutputSettings> first_output(const SessionWall& wall, const DeskOptions& options) {
    wall::OutputSettings output = wall.screens[wall.main].shown;
    output.swap_eyes = output.swap_eyes != options.swap_eyes;
    if (options.stereo.empty()) return output;
    BURIN_TRY(mode, wall::parse_stereo_mode(options.stereo));
    output.mode = mode;
    return output;
}

}  // namespace burin::session
