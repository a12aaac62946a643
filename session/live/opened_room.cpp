// SPDX-License-Identifier: MIT
#include "session/live/opened_room.hpp"

#include <numbers>
#include <utility>

#include "desk/panel/live_panel.hpp"
#include "desk/view/session_screens.hpp"
#include "devices/haptic/mouse_arm.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_registry.hpp"
#include "sculpt/workpiece.hpp"
#include "session/activity/activity.hpp"
#include "session/hands/session_hands.hpp"
#include "session/record/recordings.hpp"

namespace burin::session {
namespace {

Room room_of(const SessionWall& wall) {
    Room room;
    room.wall = wall;
    const Pose fallback = wall.setup.fallback_head_tracker;
    room.desk.home_head_world = {wall.setup.world_from_tracker * fallback.position_m,
                                 wall.setup.world_from_tracker.orientation * fallback.orientation};
    if (wall.desk) room.desk.head_world = {{-2.0, 0.4, 0.3}, {2.0, 2.4, 6.0}};
    return room;
}

// Has the desk steer a handle over a workspace of its own size.
void steer_over(HandRoom& room, const Vec3& workspace_device_m) {
    constexpr double kDepthPerWheelStep = 0.025;  // of the workspace's longest side, about as a stylus'
    room.workspace_device_m = room.desk.workspace_m = workspace_device_m;
    room.desk.depth_per_wheel_step_m = kDepthPerWheelStep * sculpt::longest_side_m({Vec3(0.0), workspace_device_m});
}

// Has the desk lead the palm of a glove: palm down, fingers away from the viewer and to the left, over a workspace that
// an arm reaches. (The device's own is larger by a hand, for its fingertips.)
void use_glove(HandRoom& room) {
    constexpr Vec3 kReach_m{0.33, 0.3, 0.264};
    constexpr double kToTheLeft_rad = 0.85, kDown_rad = 0.25, kDepthPerWheelStep_m = 0.01;
    room.workspace_device_m = room.desk.workspace_m = kReach_m;
    room.desk.depth_per_wheel_step_m = kDepthPerWheelStep_m;
    room.desk.rest_device = glm::angleAxis(kToTheLeft_rad, Vec3(0.0, 1.0, 0.0)) *
                            glm::angleAxis(-0.5 * std::numbers::pi - kDown_rad, Vec3(1.0, 0.0, 0.0));
}

Vec3 across(const wall::Screen& screen) { return screen.lower_right_world - screen.lower_left_world; }

ImageSize asked_window(const LiveOptions& live) {
    return {static_cast<std::uint32_t>(live.width), static_cast<std::uint32_t>(live.height)};
}

// The picture of one eye in the mode that the session begins with.
ImageSize eye_at_first(const LiveOptions& live) {
    const auto mode = live.stereo.empty() ? wall::StereoMode::mono
                                          : wall::parse_stereo_mode(live.stereo).value_or(wall::StereoMode::mono);
    return wall::eye_size(mode, asked_window(live));
}

// The share of a desktop window's picture beside the panel.
double free_width_at_first(const LiveOptions& live, const Room& room) {
    if (!room.wall.desk || room.wall.has_panel_window()) return 1.0;
    return beside_panel(room, eye_at_first(live), asked_window(live));
}

// Says how large the panel is and which share of the picture it leaves free.
void place_panel(Room& room, const LiveOptions& live) {
    room.panel_scale = live.panel_scale.value_or(1.0);
    room.first_steps = live.first_steps;
    room.frames_world = live.frames_world;
    room.free_width = free_width_at_first(live, room);
    if (!room.wall.desk || (room.mouse != MouseMode::surface && !room.frames_world)) return;
    fit_desk_screen(room.wall, eye_at_first(live));
    // Before the middle of what the panel leaves free, so that nothing there is seen aslant.
    room.desk.home_head_world.position_m -= 0.5 * (1.0 - room.free_width) * across(room.screen());
}

// Of a hand that a mouse leads or could lead, and of one that feels.
haptics::FillPlace fill_place_of(const devices::DeviceNature& nature) {
    if (nature.felt_by_person) return haptics::FillPlace::begun;
    const bool led_by_mouse = !nature.leads_itself && !nature.is_worn;
    return led_by_mouse ? haptics::FillPlace::hand : haptics::FillPlace::surface;
}

}  // namespace

bool has_world(const SculptOptions& options) { return options.scene || !options.world.empty(); }
bool has_workpiece(const SculptOptions& options) { return !options.no_workpiece || !has_world(options); }

Result<wall::OutputSettings> first_output(const Room& room, const LiveOptions& live) {
    wall::OutputSettings output = room.wall.screens[room.wall.main].shown;
    output.swap_eyes = output.swap_eyes != live.swap_eyes;
    if (live.stereo.empty()) return output;
    const auto mode = wall::parse_stereo_mode(live.stereo);
    if (!mode) return std::unexpected(mode.error());
    output.mode = *mode;
    return output;
}

Result<OpenedRoom> open_room(const SculptOptions& options, const SessionWall& wall) {
    OpenedRoom opened{room_of(wall), {}};
    opened.room.mouse = options.live.mouse.value_or(MouseMode::free);
    opened.room.mouse_chosen = options.live.mouse.has_value();
    if (const auto cannot = no_surface(options)) opened.room.no_surface = cannot->what;
    opened.room.offers_mouse = options.live.mouse.has_value() && opened.room.no_surface.empty();
    const std::vector<NamedDevice> hands = devices_of(options.live);
    opened.room.others.assign(hands.size() - 1, opened.room);
    opened.handles.assign(hands.size(), nullptr);
    for (std::size_t i = 0; i < hands.size(); ++i) {
        HandRoom& room = i == 0 ? opened.room : opened.room.others[i - 1];
        Result<devices::DeviceNature> nature = devices::nature_of_device(hands[i].device, &session_recordings());
        if (!nature) return std::unexpected(of_hand(hands[i].hand, nature.error()));
        if (nature->is_upright) {
            room.desk.rest_device = {1.0, 0.0, 0.0, 0.0};
            room.desk.leans_sideways = true;
        }
        if (hands[i].device == devices::kMouseArm) steer_over(room, devices::mouse_arm().workspace_m);
        room.fills = fill_place_of(*nature);
        if (nature->is_worn) use_glove(room);
        if (nature->is_worn && i == 0 && options.activity != nullptr)
            if (const std::optional<LedHand> led = options.activity->led_hand()) {
                opened.room.reach_object = led->reach_scene;
                room.desk.rest_device = led->rest_device;
            }
        if (!nature->handle) continue;
        steer_over(room, devices::device_of(*nature->handle).workspace_m);
        if (options.points.empty()) continue;
        auto points = devices::points_named(*nature->handle, options.points);
        if (!points) return std::unexpected(points.error());
        opened.handles[i] = std::make_shared<const HeldHandle>(std::move(*nature->handle), std::move(*points));
    }
    place_panel(opened.room, options.live);
    return opened;
}

}  // namespace burin::session
