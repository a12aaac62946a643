// SPDX-License-Identifier: MIT
// Computes the length of a picture's pixel at a position in the scene: detail smaller than that may be left out there.
// Pure; any thread.
#pragma once

#include "base/image.hpp"
#include "renderer/scene/scene.hpp"

namespace burin::renderer {

class PixelLength {
public:
    PixelLength(const Scene& scene, ImageSize size);
    // Returns the length in metres of the world at the point of a ball
    // that is nearest to an eye; that distance counts as at least 1 cm.
    [[nodiscard]] double at(const Vec3& center_world, double radius_m) const;

private:
    wall::Screen screen_;
    double eye_m_ = 0.0, per_metre_ = 0.0;
};

}  // namespace burin::renderer
