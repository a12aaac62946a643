// SPDX-License-Identifier: MIT
#include "activities/wand/wand_view.hpp"

#include <algorithm>

namespace burin::activities {
namespace {

constexpr double kPictureHeight_m = 1.2;  // in the world: what the picture shows is scaled to it
const Vec3 kMiddle_world{0.0, 1.3, -0.5};

}  // namespace

WandView::WandView(const devices::WandDescription& wand, double scale, double radius_m)
    : drawn_(wand), scale_(scale), radius_m_(radius_m) {}

void WandView::add_to(picture::Picture& scene, const WandPose& pose, const Similarity& world_from_scene) const {
    const Similarity scene_from_tool{pose.scene_from_tool.position_m, pose.scene_from_tool.orientation, scale_};
    session::DrawnHandle::Place place{world_from_scene * scene_from_tool, {}, world_from_scene.scale * radius_m_};
    for (const Vec3& point_scene : pose.points_scene) place.points_world.push_back(world_from_scene * point_scene);
    drawn_.add_to(scene.objects, place);
    scene.contact.visible = pose.force_N != Vec3(0.0);
    scene.contact.point_world = world_from_scene * pose.scene_from_tool.position_m;
    scene.contact.normal_world = Vec3(0.0);
    scene.contact.force_N = world_from_scene.orientation * pose.force_N;
}

picture::Picture WandView::close_scene(const WorldView& world, const WandPose& pose, const WandCamera& camera) const {
    picture::Picture scene = world.wall_scene({});
    scene.pedestal.visible = false;
    scene.show_wall_frame = false;
    // Scales and moves the world to where a picture is taken: in the middle of the room, in full light.
    const double scale = 0.5 * kPictureHeight_m / camera.half_height_m;
    const Similarity world_from_scene{kMiddle_world - scale * camera.middle_scene, {1, 0, 0, 0}, scale};
    const Similarity again = world_from_scene * inverse(world.world_from_scene());
    scene.world_from_object = world_from_scene;
    for (picture::DrawnObject& object : scene.objects) object.world_from_mesh = again * object.world_from_mesh;
    add_to(scene, pose, world_from_scene);
    const Vec3 towards_eye = glm::normalize(camera.towards_eye);
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye)), up = glm::cross(towards_eye, right);
    const double half_height = 0.5 * kPictureHeight_m, half_width = 4.0 / 3.0 * half_height;
    scene.screen = {kMiddle_world - half_width * right - half_height * up,
                    kMiddle_world + half_width * right - half_height * up,
                    kMiddle_world - half_width * right + half_height * up};
    scene.viewer.interpupillary_m = 0.0;
    scene.viewer.head_world.position_m = kMiddle_world + 4.0 * half_height * towards_eye;
    scene.contact.metres_per_N = 0.12;
    return scene;
}

}  // namespace burin::activities
