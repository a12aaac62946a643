// SPDX-License-Identifier: MIT
#include "desk/viewer/viewer.hpp"

#include <algorithm>
#include <array>

#include "desk/viewer/framed_world.hpp"
#include "session/held/held_handle.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_room.hpp"
#include "wall/comfort.hpp"
#include "wall/projection.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

// Size of the workpiece's longest side as a share of the screen's height.
constexpr double kHeightOnScreen = 0.52;
// Size of a world's longest side as such a share: a world is wide rather than high.
constexpr double kWorldOnScreen = 0.8;
// Size of a handle's workspace that is shown as large as a world of that size.
constexpr double kOfWorkspace = 0.8;
// Distance of the workpiece's center behind the screen, as a share of its own longest side.
constexpr double kBehindScreen = 0.4;
// Height of its center above the screen's lower edge, as a share of the screen's height.
constexpr double kAboveLowerEdge = 0.55;

double longest_side_of(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

// Returns the size that is to fill its share of the screen.
double size_before_viewer_m(const Room& room, const HeldHandle* held) {
    const double size_m = longest_side_of(room.workpiece_object.extent());
    if (held == nullptr) return size_m;
    const double scale = object_from_device(*held, room.workpiece_object).scale;
    return std::max(size_m, kOfWorkspace * scale * longest_side_of(room.hands.front().workspace_device_m));
}

Similarity placed_on_screen(const Room& room, const DeskRoom& desk, const HeldHandle* held) {
    const wall::Screen s = desk.screen();
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const Vec3 out = glm::normalize(glm::cross(across, upright));
    const double height_m = glm::length(upright), size_m = size_before_viewer_m(room, held);
    Similarity world_from_object;
    const double share = room.covers_depth ? kWorldOnScreen : kHeightOnScreen;
    world_from_object.scale = share * height_m / size_m;
    world_from_object.orientation = world_from_screen(s);
    const Vec3 place =
        s.lower_left_world + 0.5 * across + kAboveLowerEdge * upright - kBehindScreen * share * height_m * out;
    const Vec3 middle = room.workpiece_object.center();
    world_from_object.position_m = place - world_from_object.scale * (world_from_object.orientation * middle);
    return world_from_object;
}

// Before a wall, moves the workpiece back or forth as far as its viewer's eyes require at the start.
Similarity moved_into_comfort(Similarity world_from_object, const Viewer& viewer, const Room& room,
                              const DeskRoom& desk, const HeldHandle* held) {
    if (desk.wall.desk) return world_from_object;
    const View sight = view_of(desk.wall.setup, desk.wall.main, viewer.head, viewer.interpupillary_m);
    if (!sight.visible) return world_from_object;
    const double radius_m = 0.5 * world_from_object.scale * longest_side_of(room.workpiece_object.extent());
    const HandRoom& hand = room.hands.front();
    const Similarity world_from_device = world_from_workspace(room, hand, world_from_object, held);
    const std::array<wall::ContentBall, 2> content{
        {{world_from_object * room.workpiece_object.center(), radius_m},
         {world_from_device * resting_hand_device(hand, held, 0.0), 0.2 * radius_m}}};  // the tool at rest
    const wall::ComfortFinding finding =
        wall::judge(desk.wall.setup.budget, sight.screen, wall::eyes_of(sight.viewer), {content, {}});
    if (finding.move_m)
        world_from_object.position_m += *finding.move_m * (world_from_screen(sight.screen) * Vec3(0.0, 0.0, 1.0));
    return world_from_object;
}

SeenFrom seen_from(const Viewer& viewer, const Room& room, const DeskRoom& desk, const HeldHandle* held) {
    const View sight = view_of(desk.wall.setup, desk.wall.main, viewer.head, viewer.interpupillary_m);
    SeenFrom from{sight.screen, wall::middle_of(wall::eyes_of(sight.viewer)), desk.free_width, room.workpiece_object};
    if (desk.frames_world && held != nullptr)
        from.bounds_object = grown(from.bounds_object, size_before_viewer_m(room, held));
    return from;
}

}  // namespace

Viewer begin_viewer(const DeskRoom& desk, const wall::OutputSettings& output) {
    Viewer viewer;
    viewer.desk = desk_at_home(desk.hands.front());
    viewer.head = follow_head({}, desk.wall.setup, desk.wall.setup.timing, {}, 0, viewer.desk.head_world);
    viewer.interpupillary_m = interpupillary_m(desk.wall.setup.eyes);
    viewer.output = output;
    viewer.first_steps = desk.first_steps;
    return viewer;
}

Similarity placed_before(const Viewer& viewer, const Room& room, const DeskRoom& desk, const HeldHandle* held) {
    const Similarity placed = moved_into_comfort(placed_on_screen(room, desk, held), viewer, room, desk, held);
    if (!desk.wall.desk || (room.mouse != MouseMode::surface && !desk.frames_world)) return placed;
    return fitted(seen_from(viewer, room, desk, held), placed.orientation);
}

void take_hand(Viewer& viewer, const SessionState& state) {
    const HandState& hand = state.led();
    viewer.desk.target_device_m = hand.target.position_device_m;
    viewer.desk.target_turn_device = hand.target_turn_device;
    viewer.desk.buttons = hand.target.buttons;
}

SeenFrom seen_from(const ViewedSession& seen) {
    return seen_from(seen.viewer, seen.room, seen.desk, seen.state.led().handle.get());
}

double value_of(const SessionState& state, const Viewer& viewer, Quantity quantity) {
    if (quantity == Quantity::eye_distance) return viewer.interpupillary_m;
    if (quantity == Quantity::strength) return viewer.desk.strength;
    return descriptor_of(quantity).value(state);
}

}  // namespace burin::session
