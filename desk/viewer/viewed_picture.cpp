// SPDX-License-Identifier: MIT
#include "desk/viewer/viewed_picture.hpp"

#include <algorithm>
#include <array>

#include "session/held/held_handle.hpp"
#include "session/held/staging.hpp"
#include "session/state/session_room.hpp"
#include "toolbox/tool_mesh.hpp"
#include "wall/projection.hpp"

namespace burin::session {
namespace {

// Keeps a large box around the whole workpiece from dimming it.
constexpr double kBoxOpacity = 0.04;

// Returns the colour of what the tool leaves behind; a cutting tool has its own.
Vec3 tool_colour(const HandState& hand) {
    if (hand.tool.operation == compute::Operation::cut) return picture::PictureTool{}.colour;
    const auto c = toolbox::material_of(hand.tool).colour;
    return Vec3(c[0], c[1], c[2]) / 255.0;
}

}  // namespace

std::optional<picture::Picture> scene_of(const ViewedSession& seen, std::size_t screen,
                                         const Vec3& lattice_origin_object, const haptics::ToolState& tool) {
    const auto& [state, room, viewer, desk] = seen;
    const HandState& hand = state.led();
    const View sight = seen.view_of(screen);
    if (!sight.visible) return std::nullopt;
    picture::Picture scene;
    scene.screen = sight.screen;
    scene.viewer = sight.viewer;
    const bool one_eye = wall::needs_of(seen.output_on(screen).mode).one_eye_point;
    if (one_eye) scene.viewer.interpupillary_m = 0.0;
    if (fades_at_edges(seen, screen)) scene.edge_fade = 1.0;
    scene.world_from_object = state.world_from_object;
    scene.lattice_origin_object = lattice_origin_object;
    scene.workpiece_object = room.workpiece_object;
    scene.show_wall_frame = false;
    const PlinthPlace plinth =
        plinth_under(room.workpiece_object, state.world_from_object, wall::middle_of(wall::eyes_of(scene.viewer)));
    scene.pedestal.visible = plinth.visible;
    scene.pedestal.top_center_world = plinth.top_center_world;
    scene.pedestal.radius_m = plinth.radius_m;
    Staging staging = staging_of(tool, hand.held->half_width_m(), room.hands[state.hand].workspace_device_m);
    staging.held = hand.held;
    staging.contact_shown = viewer.force_shown;
    staging.tool_visible = staging.tool_visible && !hand.handle;
    // Before the cursor has been over the picture nobody knows where the tool is to be; and beside the cursor, at the
    // border of what the hand reaches, it would be a large thing in the way.
    if (state.mouse == MouseMode::surface && (!viewer.desk.mouse_px || viewer.desk.beyond_reach))
        staging.tool_visible = false;
    // It is around all that is there.
    staging.box_visible = staging.box_visible && state.mouse != MouseMode::surface;
    stage(scene, staging, state.world_from_object);
    if (hand.handle) add_handle(scene, *hand.handle, tool, hand.held->half_width_m(), state.world_from_object);
    scene.tool.colour = tool_colour(hand);
    if (scene.box.face_opacity > kBoxOpacity) scene.box.face_opacity = kBoxOpacity;
    return scene;
}

void add_tool(picture::Picture& scene, const SessionState& state, std::size_t number, const haptics::ToolState& tool) {
    if (tool.tick == 0) return;
    const HandState& hand = state.hands[number];
    if (hand.handle) return add_handle(scene, *hand.handle, tool, hand.held->half_width_m(), state.world_from_object);
    static const auto kBall = picture::drawn_mesh(toolbox::drawing_of(compute::BallTool{1.0}));
    Similarity object_from_tool{tool.proxy_object_m, tool.tool_orientation_object, 1.0};
    const bool is_ball = !hand.held->drawn;
    if (is_ball) object_from_tool.scale = hand.held->half_width_m();
    scene.objects.push_back(
        {is_ball ? kBall : hand.held->drawn, state.world_from_object * object_from_tool, tool_colour(hand)});
    // A shaft as the tool in use has one, along the tool's +Y.
    static const auto kShaft = picture::drawn_mesh(toolbox::drawing_of(compute::CylinderTool{0.12, 3.2}));
    const double from_m = is_ball ? 0.8 * hand.held->half_width_m() : hand.held->shaft_height_m;
    Similarity object_from_shaft = object_from_tool;
    object_from_shaft.position_m += object_from_tool.orientation * Vec3(0.0, from_m, 0.0);
    object_from_shaft.scale = hand.held->half_width_m();
    scene.objects.push_back({kShaft, state.world_from_object * object_from_shaft, Vec3(0.1)});
}

bool could_fade_at_edges(const ViewedSession& seen, std::size_t screen) {
    return seen.desk.wall.setup.screens.size() == 1 && !wall::needs_of(seen.output_on(screen).mode).one_eye_point;
}

bool fades_at_edges(const ViewedSession& seen, std::size_t screen) {
    const Viewer& viewer = seen.viewer;
    const bool wanted =
        viewer.edge_comfort == EdgeComfort::automatic ? !viewer.head.tracked : viewer.edge_comfort == EdgeComfort::on;
    return wanted && could_fade_at_edges(seen, screen);
}

wall::ComfortFinding comfort_of(const ViewedSession& seen, const haptics::ToolState& tool) {
    const View sight = seen.view_of(seen.desk.wall.main);
    if (!sight.visible) return {};
    const Similarity& world_from_object = seen.state.world_from_object;
    const double scale = world_from_object.scale;
    const Box& workpiece = seen.room.workpiece_object;
    // Bounds the workpiece by a ball, since it may be turned any way.
    const std::array<wall::ContentBall, 2> balls{
        {{world_from_object * workpiece.center(),
          0.5 * scale * std::max({workpiece.extent().x, workpiece.extent().y, workpiece.extent().z})},
         {world_from_object * tool.proxy_object_m, scale * toolbox::reach_of(seen.state.led().held->shape)}}};
    return wall::judge(seen.desk.wall.setup.budget, sight.screen, wall::eyes_of(sight.viewer), {balls, {}});
}

}  // namespace burin::session
