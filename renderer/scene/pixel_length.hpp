// SPDX-License-Identifier: MIT
// Computes the length of a picture's pixel at a position in the scene: detail smaller than that may be left out there.
// Pure; any thread.
#pragma once

#include <algorithm>

#include "base/image.hpp"
#include "renderer/scene/scene.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {

class PixelLength {
public:
    PixelLength(const Scene& scene, ImageSize size) : screen_(scene.screen) {
        const double width_m = glm::length(screen_.lower_right_world - screen_.lower_left_world);
        const double height_m = glm::length(screen_.upper_left_world - screen_.lower_left_world);
        const double pixel_m = std::min(width_m / size.width, height_m / size.height);
        const wall::Eyes eyes = wall::eyes_of(scene.viewer);
        eye_m_ = std::min(wall::distance_in_front(screen_, eyes.left_world),
                          wall::distance_in_front(screen_, eyes.right_world));
        per_metre_ = pixel_m / eye_m_;
    }

    // Returns the length in metres of the world at the point of a ball
    // that is nearest to an eye; that distance counts as at least 1 cm.
    [[nodiscard]] double at(const Vec3& center_world, double radius_m) const {
        return per_metre_ * std::max(eye_m_ - wall::distance_in_front(screen_, center_world) - radius_m, 0.01);
    }

private:
    wall::Screen screen_;
    double eye_m_ = 0.0, per_metre_ = 0.0;
};

}  // namespace burin::renderer
