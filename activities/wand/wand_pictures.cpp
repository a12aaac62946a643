// SPDX-License-Identifier: MIT
#include "activities/wand/wand_pictures.hpp"
#include "scene/world_file.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace burin::activities {
namespace {

constexpr std::size_t kMostWandPictures = 24;

WandPose pose_felt(const WandFelt& felt) {
    WandPose pose;
    pose.scene_from_tool = felt.scene_from_tool;
    for (const PointFelt& point : felt.points) pose.points_scene.push_back(point.place_m);
    pose.force_N = felt.given_force_N;
    return pose;
}

}  // namespace

WandPictures::WandPictures(const scene::World& world, const WandOptions& feel, PictureDrawer draw)
    : view_(session::DrawnWorld(world.objects), feel.radius_m),
      avatar_(feel.wand, feel.wand.gain, feel.radius_m),
      draw_(std::move(draw)) {
    const Vec3 size_m = view_.bounds_scene().extent();
    camera_.middle_scene = view_.bounds_scene().center();
    camera_.half_height_m = 0.55 * std::max({size_m.x, size_m.y, size_m.z});
}

Result<void> WandPictures::at(const WandMoment& moment) {
    if (!draw_ || moment.felt == nullptr) return {};
    view_.take(*moment.drawn);
    last_ = pose_felt(*moment.felt);
    if (!moment.newly_touched || touched_ >= kMostWandPictures) return {};
    ++touched_;
    return draw("touched-" + std::to_string(touched_) + "-" + file_word(*moment.newly_touched) + ".png");
}

Result<void> WandPictures::finish() { return draw_ ? draw("end.png") : Result<void>{}; }

Result<void> WandPictures::draw(const std::string& file) const {
    return draw_(avatar_.close_scene(view_, last_, camera_), file);
}

}  // namespace burin::activities
