// SPDX-License-Identifier: MIT
#include "session/held/staging.hpp"

#include "haptics/tool_state.hpp"
#include "picture/picture.hpp"
#include "session/held/held_tool.hpp"

#include <numbers>

namespace burin::session {
namespace {

// The shaft of a tool leaves it along +Y (compute/tools/tool.hpp); a drawn stylus has it along +Z.
const Quat kToolFromStylus = glm::angleAxis(-0.5 * std::numbers::pi, Vec3(1.0, 0.0, 0.0));

void stage_tool(picture::PictureTool& tool, const Staging& staging, const Similarity& world_from_object) {
    tool.visible = staging.tool_visible;
    const Similarity world_from_tool =
        world_from_object * Similarity{staging.tool_center_object, staging.tool_orientation_object, 1.0};
    tool.center_world = world_from_tool.position_m;
    tool.radius_m = staging.tool_radius_object_m * world_from_object.scale;
    tool.stylus_world = {tool.center_world, world_from_tool.orientation * kToolFromStylus};
    if (!staging.held || !staging.held->drawn) return;
    const HeldTool& held = *staging.held;
    tool.mesh = held.drawn;
    tool.world_from_mesh = world_from_tool;
    tool.center_world = world_from_tool * held.spine.from_m;
    tool.spine_m = apply_to_vector(world_from_tool, held.spine.to_m - held.spine.from_m);
    tool.radius_m = held.spine.radius_m * world_from_object.scale;
    tool.stylus_world.position_m = world_from_tool * Vec3(0.0, held.shaft_height_m, 0.0);
}

// Draws ring and arrow. The arrow's length scales with the screen's height, so that a newton looks the same on a
// desktop display and on a wall.
void stage_contact(picture::Picture& scene, const Staging& staging, const Similarity& world_from_object) {
    constexpr double kScreenHeightsPerN = 1.0 / 25.0;
    const Quat world_from_device = world_from_object.orientation * staging.object_from_device.orientation;
    scene.contact.visible = staging.contact_shown && staging.in_contact;
    scene.contact.point_world = world_from_object * staging.contact_object;
    scene.contact.normal_world = world_from_object.orientation * staging.contact_normal_object;
    scene.contact.force_N = world_from_device * staging.force_device_N;
    scene.contact.metres_per_N =
        kScreenHeightsPerN * glm::length(scene.screen.upper_left_world - scene.screen.lower_left_world);
}

void stage_workspace(picture::Picture& scene, const Staging& staging, const Similarity& world_from_object) {
    const Similarity world_from_device = world_from_object * staging.object_from_device;
    scene.box.visible = staging.box_visible;
    scene.box.center_world = {world_from_device.position_m, world_from_device.orientation};
    scene.box.size_m = staging.workspace_device_m * world_from_device.scale;
    scene.proposed_box.visible = staging.proposed_visible;
    scene.proposed_box.center_world = {world_from_object * staging.proposed_center_object,
                                       world_from_device.orientation};
    scene.proposed_box.size_m = scene.box.size_m;
    if (staging.proposed_visible) scene.box.face_opacity = 0.0;
    scene.bubble.visible = staging.bubble_radius_object_m > 0.0;
    scene.bubble.center_world = world_from_device.position_m;
    scene.bubble.radius_m = staging.bubble_radius_object_m * world_from_object.scale;
}

}  // namespace

Staging staging_of(const haptics::ToolState& tool, double tool_radius_object_m, const Vec3& workspace_device_m) {
    const haptics::WorkspacePicture& picture = tool.workspace;
    Staging staging;
    staging.tool_center_object = tool.proxy_object_m;
    staging.tool_orientation_object = tool.tool_orientation_object;
    staging.tool_radius_object_m = tool_radius_object_m;
    staging.tool_visible = tool.tick > 0;
    staging.object_from_device = picture.object_from_device;
    staging.workspace_device_m = workspace_device_m;
    staging.box_visible = tool.tick > 0;
    staging.proposed_visible = tool.tick > 0 && picture.proposed_visible;
    staging.proposed_center_object = picture.proposed_center_object_m;
    staging.bubble_radius_object_m = tool.tick > 0 ? picture.bubble_radius_object_m : 0.0;
    staging.in_contact = tool.tick > 0 && (tool.flags & haptics::kTickInContact) != 0;
    staging.contact_object = tool.proxy_object_m - tool_radius_object_m * tool.contact_normal_object;
    // A tool that is no ball says itself where it is borne.
    if (tool.touched_object_m != Vec3(0.0)) staging.contact_object = tool.touched_object_m;
    staging.contact_normal_object = tool.contact_normal_object;
    staging.force_device_N = tool.given.force_device_N;
    return staging;
}

void stage(picture::Picture& scene, const Staging& staging, const Similarity& world_from_object) {
    stage_tool(scene.tool, staging, world_from_object);
    stage_contact(scene, staging, world_from_object);
    stage_workspace(scene, staging, world_from_object);
}

}  // namespace burin::session
