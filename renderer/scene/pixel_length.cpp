// SPDX-License-Identifier: MIT
#include "renderer/scene/pixel_length.hpp"

#include <algorithm>

#include "wall/projection.hpp"

namespace burin::renderer {

PixelLength::PixelLength(const Scene& scene, ImageSize size) : screen_(scene.screen) {
    const double width_m = glm::length(screen_.lower_right_world - screen_.lower_left_world);
    const double height_m = glm::length(screen_.upper_left_world - screen_.lower_left_world);
    const double pixel_m = std::min(width_m / size.width, height_m / size.height);
    const wall::Eyes eyes = wall::eyes_of(scene.viewer);
    eye_m_ =
        std::min(wall::distance_in_front(screen_, eyes.left_world), wall::distance_in_front(screen_, eyes.right_world));
    per_metre_ = pixel_m / eye_m_;
}

double PixelLength::at(const Vec3& center_world, double radius_m) const {
    return per_metre_ * std::max(eye_m_ - wall::distance_in_front(screen_, center_world) - radius_m, 0.01);
}

}  // namespace burin::renderer
