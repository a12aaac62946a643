// SPDX-License-Identifier: MIT
// Computes the length of a picture's pixel at a position in the scene: detail smaller than that may be left out there.
// Pure; any thread.
#pragma once

#include <algorithm>

#include "base/image.hpp"
#include "picture/picture.hpp"
#include "wall/projection.hpp"

namespace burin::picture {

class PixelLength {
public:
    PixelLength(const Picture& picture, ImageSize size) : plane_(picture.screen) {
        const wall::Screen& screen = picture.screen;
        const double width_m = glm::length(screen.lower_right_world - screen.lower_left_world);
        const double height_m = glm::length(screen.upper_left_world - screen.lower_left_world);
        const double pixel_m = std::min(width_m / size.width, height_m / size.height);
        const wall::Eyes eyes = wall::eyes_of(picture.viewer);
        eye_m_ = std::min(plane_.distance_in_front(eyes.left_world), plane_.distance_in_front(eyes.right_world));
        per_metre_ = pixel_m / eye_m_;
    }

    // Returns the length in metres of the world at the point of a ball
    // that is nearest to an eye; that distance counts as at least 1 cm.
    [[nodiscard]] double at(const Vec3& center_world, double radius_m) const {
        return per_metre_ * std::max(eye_m_ - plane_.distance_in_front(center_world) - radius_m, 0.01);
    }

private:
    wall::ScreenPlane plane_;
    double eye_m_ = 0.0, per_metre_ = 0.0;
};

}  // namespace burin::picture
