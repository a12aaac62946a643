// SPDX-License-Identifier: MIT
#include "activities/world/touch_pictures.hpp"
#include "scene/world_file.hpp"

#include <utility>

namespace burin::activities {
namespace {

constexpr std::size_t kMostTouchPictures = 24;

}  // namespace

std::string file_word(const std::string& name) {
    std::string word;
    for (const char c : name.substr(0, 40)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        word += plain ? c : '-';
    }
    return word;
}

TouchPictures::TouchPictures(const scene::World& world, double radius_m, PictureDrawer draw)
    : view_(session::DrawnWorld(world.objects), radius_m), draw_(std::move(draw)) {}

Result<void> TouchPictures::at(const WorldMoment& moment) {
    if (!draw_) return {};
    view_.take(*moment.drawn);
    if (!std::exchange(has_begun_, true)) return draw_(view_.close_scene({}), "world.png");
    if (!moment.newly_touched || touched_ >= kMostTouchPictures) return {};
    ++touched_;
    return draw_(view_.close_scene(moment.tool),
                 "touched-" + std::to_string(touched_) + "-" + file_word(*moment.newly_touched) + ".png");
}

}  // namespace burin::activities
