// SPDX-License-Identifier: MIT
#include "activities/carve/stroke_pictures.hpp"

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "picture/frame_setup.hpp"
#include "sculpt/sculpture.hpp"

#include <algorithm>
#include <cmath>

namespace burin::activities {
namespace {

constexpr ImageSize kEyeSize{1280, 960};  // the wall is 4 : 3
// The workpiece is scaled so that its longest side has this length. It stands so that the carved side lies about in the
// wall's own plane, where eyes rest best, and its pedestal behind the wall, where the wall's lower edge does not cut it
// off.
constexpr double kLargestOnWall_m = 1.15;
const Vec3 kPlace_world{0.0, 1.22, -0.45};
const Vec3 kHead_world{0.0, 1.60, 2.00};

constexpr std::size_t kTilesAStep = 256;

constexpr const char* kBefore = "before.png";
constexpr const char* kAfter = "after.png";
constexpr const char* kLeft = "left.png";
constexpr const char* kRight = "right.png";
constexpr const char* kStereo = "stereo.png";

double longest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

StrokePictures::StrokePictures(std::filesystem::path folder, gpu::Device device, renderer::Renderer renderer,
                               const Box& bounds_object)
    : folder_(std::move(folder)), device_(std::move(device)), renderer_(std::move(renderer)) {
    device_name_ = device_.info().name;
    world_from_object_.scale = kLargestOnWall_m / longest(bounds_object.extent());
    world_from_object_.position_m = kPlace_world - world_from_object_.scale * bounds_object.center();
    center_world_ = kPlace_world;
    bottom_world_m_ = kPlace_world.y - 0.5 * world_from_object_.scale * bounds_object.extent().y;
    radius_world_m_ = 0.5 * world_from_object_.scale * glm::length(bounds_object.extent());
}

Result<StrokePictures> StrokePictures::create(const std::filesystem::path& folder, const Box& bounds_object) {
    for (const char* name : {kBefore, kAfter, kLeft, kRight, kStereo}) {
        BURIN_TRY_DO(check_writable(folder / name));
    }
    Result<gpu::Device> device = gpu::Device::create();
    if (!device) {
        Error e = device.error();
        e.what += ", and --pictures needs one";
        return std::unexpected(e);
    }
    BURIN_TRY(renderer, renderer::Renderer::create(*device, kEyeSize));
    return StrokePictures(folder, std::move(*device), std::move(renderer), bounds_object);
}

// Updates the renderer's surface. Pictures are not urgent: all light is computed before one is taken.
Result<void> StrokePictures::bring_up_to_date(sculpt::Sculpture& carving) {
    const Vec3 to_light_object = inverse(world_from_object_.orientation) * picture::direction_to_light();
    BURIN_TRY_DO(carving.keep_light({to_light_object, picture::kLightHalfAngleTangent}));
    while (carving.bake_light(Vec3(0.0), kTilesAStep) > 0) {
    }
    shown_.resize(carving.surface().tile_count());
    for (std::uint32_t tile = 0; tile < shown_.size(); ++tile) show_tile(carving, tile);
    std::vector<Box> inner = carving.light()->inner_boxes_object();
    const Vec3& origin = carving.surface().lattice().origin_object;
    for (Box& box : inner) box = {box.lo - origin, box.hi - origin};
    renderer_.surface().set_occluders(std::move(inner));
    return {};
}

// Knows what has changed by itself: a session that carves takes that from the workpiece for its own frames.
void StrokePictures::show_tile(const sculpt::Sculpture& carving, std::uint32_t tile) {
    const auto& mesh = carving.surface().shared_tile(tile);
    const auto& light = carving.light()->shared_light(tile);
    if (shown_[tile].mesh == mesh && shown_[tile].light == light) return;
    shown_[tile] = {mesh, light};
    renderer_.surface().set_patch(tile, mesh);
    if (light) renderer_.surface().set_patch_light(tile, light->vertices);
}

picture::Picture StrokePictures::wall_scene(const sculpt::Sculpture& carving) const {
    picture::Picture scene;
    scene.viewer.head_world.position_m = kHead_world;
    scene.world_from_object = world_from_object_;
    scene.lattice_origin_object = carving.surface().lattice().origin_object;
    scene.pedestal.visible = true;
    scene.pedestal.top_center_world = {center_world_.x, bottom_world_m_, center_world_.z};
    scene.pedestal.radius_m = std::min(0.3, 0.5 * radius_world_m_);
    return scene;
}

// Shows the same scene through a smaller screen that stands around the workpiece, square to the line of sight.
picture::Picture StrokePictures::close_scene(const sculpt::Sculpture& carving) const {
    picture::Picture scene = wall_scene(carving);
    const Vec3 towards_eye = glm::normalize(Vec3(0.18, 0.22, 1.0));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye));
    const Vec3 up = glm::cross(towards_eye, right);
    const double half_height = 1.12 * std::max(radius_world_m_ / std::sqrt(2.0), 0.35 * radius_world_m_);
    const double half_width = half_height * kEyeSize.width / kEyeSize.height;
    scene.screen = {center_world_ - half_width * right - half_height * up,
                    center_world_ + half_width * right - half_height * up,
                    center_world_ - half_width * right + half_height * up};
    scene.viewer.interpupillary_m = 0.0;
    scene.viewer.head_world.position_m = center_world_ + 4.0 * half_height * towards_eye;
    scene.show_wall_frame = false;
    return scene;
}

Result<void> StrokePictures::take_before(sculpt::Sculpture& carving) {
    BURIN_TRY_DO(bring_up_to_date(carving));
    BURIN_TRY(image, renderer_.render(close_scene(carving)));
    carving.drop_light();  // not needed until the next picture
    return picture::write_png(folder_ / kBefore, image.left);
}

Result<void> StrokePictures::take_after(sculpt::Sculpture& carving, const session::Staging& staging) {
    BURIN_TRY_DO(bring_up_to_date(carving));
    BURIN_TRY(close, renderer_.render(close_scene(carving)));
    BURIN_TRY_DO(picture::write_png(folder_ / kAfter, close.left));

    picture::Picture scene = wall_scene(carving);
    stage(scene, staging, world_from_object_);

    BURIN_TRY(stereo, renderer_.render(scene));
    BURIN_TRY_DO(picture::write_png(folder_ / kLeft, stereo.left));
    BURIN_TRY_DO(picture::write_png(folder_ / kRight, stereo.right));
    return picture::write_png(folder_ / kStereo, side_by_side(stereo));
}

Result<Image> StrokePictures::view_of_wall(sculpt::Sculpture& carving, const session::Staging& staging) {
    BURIN_TRY_DO(bring_up_to_date(carving));
    picture::Picture scene = wall_scene(carving);
    scene.viewer.interpupillary_m = 0.0;
    stage(scene, staging, world_from_object_);
    BURIN_TRY(views, renderer_.render(scene));
    return std::move(views.left);
}

}  // namespace burin::activities
