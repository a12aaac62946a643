// SPDX-License-Identifier: MIT
#include "desk/viewer/viewer_lead.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "desk/viewer/framed_world.hpp"
#include "desk/viewer/view_cube.hpp"
#include "session/held/held_handle.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_room.hpp"
#include "toolbox/tool_mesh.hpp"
#include "wall/projection.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

// Returns the distance from the main screen to the head; never 0, even where the head is beside or behind it.
double head_distance_m(const Viewer& viewer, const wall::Screen& screen, const wall::WallSetup& setup) {
    return std::max(wall::distance_in_front(screen, head_world(setup, viewer.head).position_m), 0.05);
}

DeskSurface surface_of(const ViewedSession& seen, const ViewerLook& look) {
    const std::size_t main = seen.desk.wall.main;
    const View sight = seen.view_of(main);
    const Similarity object_from_world = inverse(seen.state.world_from_object);
    const HeldTool& held = *seen.state.led().held;
    DeskSurface on;
    on.seen = look.surface;
    on.cursor = {seen.output_on(main), look.output, sight.screen, wall::middle_of(wall::eyes_of(sight.viewer)),
                 object_from_world};
    on.tool = {toolbox::tip_m(held.shape), held.half_width_m(), held.half_width_m(), 0.0};
    on.object_from_device = object_from_device_on_surface(seen.room);
    on.object_from_screen = glm::normalize(object_from_world.orientation * world_from_screen(sight.screen));
    on.middle_object = seen.room.workpiece_object.center();
    return on;
}

DeskView desk_view_of(const ViewedSession& seen, const StepView& view, const ViewerLook& look) {
    const SessionState& state = seen.state;
    const HandState& hand = state.led();
    const wall::Screen screen = seen.desk.screen();
    const double width_m = glm::length(screen.lower_right_world - screen.lower_left_world);
    const double screen_m_per_px = width_m / std::max(look.eye_size.width, 1u);
    const double eye_m = head_distance_m(seen.viewer, screen, seen.desk.wall.setup);
    const Vec3 tool_world = state.world_from_object * view.tool.hip_object_m;
    const double to_tool_m = std::max(eye_m - wall::distance_in_front(screen, tool_world), 0.1);
    DeskView desk;
    desk.device_m_per_px = device_m_per_px(screen_m_per_px, eye_m, to_tool_m, hand.world_from_device.scale);
    desk.world_m_per_px = screen_m_per_px;
    desk.picture_px_per_px = picture_px_per_px(seen.output_on(seen.desk.wall.main).mode);
    desk.world_from_screen = world_from_screen(screen);
    // A handle's axes need not be the screen's.
    if (hand.handle) desk.device_from_screen = hand.handle->device_from_scene_turn() * desk.device_from_screen;
    desk.pivot_world = state.world_from_object * seen.room.workpiece_object.center();
    desk.scene_scale = state.world_from_object.scale / state.home_world_from_object.scale;
    // A press on the view's cube is not one into the scene.
    desk.mouse_captured = look.captured.mouse || seen.viewer.over_cube.has_value();
    desk.keyboard_captured = look.captured.keyboard;
    if (state.mouse == MouseMode::surface && look.surface != nullptr) desk.surface = surface_of(seen, look);
    if (state.mouse == MouseMode::free && seen.desk.frames_world && seen.desk.wall.desk)
        desk.cursor = cursor_of(seen, view, look.output);
    return desk;
}

}  // namespace

Led ViewerLead::lead(const SessionState& state, const Room& /*room*/, std::span<const InputEvent> events,
                     const StepView& view) {
    viewer_.seen_from = seen_from(seen(state));
    BesideCube beside = take_presses(viewer_, seen(state), events, look_);
    const DeskView desk_view = desk_view_of(seen(state), view, look_);
    DeskStep desk = step_desk(viewer_.desk, beside.events, view.dt_s, desk_view, desk_.hands[state.hand]);
    viewer_.desk = desk.state;
    const wall::StereoMode mode = seen(state).output_on(desk_.wall.main).mode;
    viewer_.head = follow_head(viewer_.head, desk_.wall.setup, timing_in(desk_.wall.setup, mode), events,
                               look_.display_ns, viewer_.desk.head_world);
    Led led{.world_from_object = state.world_from_object, .hand = desk.target, .hand_way = std::move(desk.way)};
    if (desk.scene_change != Similarity{}) led.world_from_object = desk.scene_change * led.world_from_object;
    WandStep wands =
        step_wands(viewer_.wands, events, view.dt_s, led.world_from_object, head_world(desk_.wall.setup, viewer_.head),
                   {.home_world_from_scene = state.home_world_from_object});
    viewer_.wands = wands.state;
    led.world_from_object = wands.world_from_scene;
    for (const Gesture stroke : desk.strokes) led.strokes.push_back(stroke == Gesture::smooth_surface);
    led.strokes_now = viewer_.desk.on_surface.pressed;
    led.stroke_depth_m = viewer_.desk.strength * state.led().held->half_width_m();
    led.turns_scene = viewer_.desk.drag.has_value();
    if (desk.missed)
        led.message =
            "the cursor was beside the workpiece, and nothing was touched: press where the tool stands on it; a drag "
            "beside it turns the scene";
    led.actions = std::move(beside.views);
    led.actions.insert(led.actions.end(), desk.actions.begin(), desk.actions.end());
    return led;
}

void ViewerLead::meet(const InputEvent& event) {
    const auto* click = std::get_if<MouseClick>(&event.input);
    if (click != nullptr && click->pressed) viewer_.first_steps = false;
}

Result<void> ViewerLead::run(SessionState& state, SessionOrders& orders, const SessionCommand& command) {
    return run_command(viewer_, state, desk_, orders, command);
}

bool ViewerLead::keep_governed() {
    if (governed_ == governed_part()) return false;
    std::tie(viewer_.force_shown, viewer_.output.mode, viewer_.output.swap_eyes, viewer_.output.test_pattern,
             viewer_.edge_comfort) = governed_;
    return true;
}

ViewedStep step_viewed(SessionState state, Viewer viewer, const Room& room, const DeskRoom& desk,
                       std::span<const InputEvent> events, const StepView& view, const ViewerLook& look) {
    ViewerLead leader(viewer, room, desk, look);
    SessionStep step = step_session(std::move(state), room, events, view, leader);
    return {std::move(step), std::move(viewer)};
}

}  // namespace burin::session
