// SPDX-License-Identifier: MIT
#include "activities/world/world_view.hpp"

#include <algorithm>
#include <utility>

#include "picture/frame_setup.hpp"
#include "session/held/staging.hpp"

namespace burin::activities {
namespace {

// The world's longest side on the wall, and where its middle stands: behind the wall's plane, where eyes rest best.
constexpr double kLongestOnWall_m = 1.5;
const Vec3 kPlace_world{0.0, 1.15, -0.5}, kHead_world{0.0, 1.75, 2.0};

double longest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

session::DrawnWorld drawn_world_of(const scene::MeshPart& part, std::span<const scene::ObjectId> ids) {
    std::vector<scene::SceneObject> objects;
    for (const scene::ObjectId id : ids) objects.push_back(part.object(id));
    return session::DrawnWorld(objects);
}

}  // namespace

WorldView::WorldView(const scene::MeshPart& part, std::span<const scene::ObjectId> ids, double tool_radius_m)
    : WorldView(drawn_world_of(part, ids), tool_radius_m) {}

WorldView::WorldView(session::DrawnWorld drawn, double tool_radius_m)
    : drawn_(std::move(drawn)), bounds_scene_(drawn_.bounds_scene()), tool_radius_m_(tool_radius_m) {
    if (bounds_scene_.empty()) bounds_scene_ = {Vec3(-0.05), Vec3(0.05)};
    world_from_scene_.scale = kLongestOnWall_m / longest(bounds_scene_.extent());
    world_from_scene_.position_m = kPlace_world - world_from_scene_.scale * bounds_scene_.center();
}

picture::Picture WorldView::wall_scene(const haptics::ToolState& tool) const {
    picture::Picture scene;
    scene.viewer.head_world.position_m = kHead_world;
    scene.world_from_object = world_from_scene_;
    scene.workpiece_object = bounds_scene_;
    scene.objects = drawn_.in_world(world_from_scene_);
    session::Staging staging = session::staging_of(tool, tool_radius_m_, Vec3(0.0));
    staging.box_visible = false;
    staging.contact_shown = true;
    session::stage(scene, staging, world_from_scene_);
    const double bottom_world_m = (world_from_scene_ * bounds_scene_.lo).y;
    const Vec3 size = world_from_scene_.scale * bounds_scene_.extent();
    scene.pedestal.visible = true;
    scene.pedestal.top_center_world = {kPlace_world.x, bottom_world_m, kPlace_world.z};
    scene.pedestal.radius_m = 0.52 * std::max(size.x, size.z);
    return scene;
}

picture::Picture WorldView::close_scene(const haptics::ToolState& tool) const {
    picture::Picture scene = wall_scene(tool);
    const Vec3 towards_eye = glm::normalize(Vec3(0.25, 0.75, 1.0));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye)), up = glm::cross(towards_eye, right);
    const double half_width = 0.62 * kLongestOnWall_m, half_height = 0.75 * half_width;
    scene.screen = {kPlace_world - half_width * right - half_height * up,
                    kPlace_world + half_width * right - half_height * up,
                    kPlace_world - half_width * right + half_height * up};
    scene.viewer.interpupillary_m = 0.0;
    scene.viewer.head_world.position_m = kPlace_world + 4.0 * half_height * towards_eye;
    scene.show_wall_frame = false;
    scene.contact.metres_per_N = 0.1;
    return scene;
}

}  // namespace burin::activities
