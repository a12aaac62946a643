// SPDX-License-Identifier: MIT
#include "activities/wand/wand_view.hpp"

#include <algorithm>

#include "sculpt/tool_mesh.hpp"

namespace burin::activities {
namespace {

constexpr double kRodRadius = 0.02;       // as a share of the handle's length
constexpr double kPictureHeight_m = 1.2;  // in the world: what the picture shows is scaled to it
const Vec3 kMiddle_world{0.0, 1.3, -0.5};
const Vec3 kRod{0.75, 0.76, 0.80}, kTopBall{0.86, 0.12, 0.10}, kBottomBall{0.10, 0.68, 0.22},
    kOtherBall{0.20, 0.40, 0.85};

}  // namespace

WandView::WandView(const devices::WandDescription& wand, double scale, double radius_m)
    : tool_from_handle_(wand.device_tool_from_handle), scale_(scale), half_length_m_(0.5 * wand.handle_m) {
    rod_ = renderer::drawn_mesh(sculpt::drawing_of(compute::CylinderTool{kRodRadius * wand.handle_m, wand.handle_m}));
    ball_ = renderer::drawn_mesh(sculpt::drawing_of(compute::BallTool{radius_m}));
}

void WandView::add_to(renderer::Scene& scene, const WandPose& pose, const Similarity& world_from_scene) const {
    // A cylinder stands on its origin.
    const Similarity scene_from_handle =
        Similarity{pose.scene_from_tool.position_m, pose.scene_from_tool.orientation, scale_} *
        Similarity{tool_from_handle_.position_m, tool_from_handle_.orientation, 1.0};
    scene.objects.push_back(
        {rod_, world_from_scene * scene_from_handle * Similarity{{0.0, -half_length_m_, 0.0}, {1, 0, 0, 0}, 1.0},
         kRod});
    for (std::size_t i = 0; i < pose.points_scene.size(); ++i) {
        const bool is_last = i + 1 == pose.points_scene.size();
        const Vec3& colour = i == 0 ? kTopBall : (is_last ? kBottomBall : kOtherBall);
        scene.objects.push_back({ball_, world_from_scene * Similarity{pose.points_scene[i]}, colour});
    }
    scene.contact.visible = pose.force_N != Vec3(0.0);
    scene.contact.point_world = world_from_scene * pose.scene_from_tool.position_m;
    scene.contact.normal_world = Vec3(0.0);
    scene.contact.force_N = world_from_scene.orientation * pose.force_N;
}

renderer::Scene WandView::close_scene(const WorldView& world, const WandPose& pose, const WandCamera& camera) const {
    renderer::Scene scene = world.wall_scene({});
    scene.pedestal.visible = false;
    scene.show_wall_frame = false;
    // Scales and moves the world to where a picture is taken: in the middle of the room, in full light.
    const double scale = 0.5 * kPictureHeight_m / camera.half_height_m;
    const Similarity world_from_scene{kMiddle_world - scale * camera.middle_scene, {1, 0, 0, 0}, scale};
    const Similarity again = world_from_scene * inverse(world.world_from_scene());
    scene.world_from_object = world_from_scene;
    for (renderer::DrawnObject& object : scene.objects) object.world_from_mesh = again * object.world_from_mesh;
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
