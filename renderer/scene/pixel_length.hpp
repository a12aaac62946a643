// SPDX-License-Identifier: MIT
// How long a pixel of the picture is at a place of the scene: what may be left out of a shape there.
// Pure; any thread.
#pragma once

#include "renderer/image.hpp"
#include "renderer/scene.hpp"

namespace burin {

class PixelLength {
public:
    PixelLength(const Scene& scene, ImageSize size);
    // In metres of the world, where a ball is nearest to an eye; no nearer than 1 cm.
    [[nodiscard]] double at(const Vec3& center_world, double radius_m) const;

private:
    Screen screen_;
    double eye_m_ = 0.0, per_metre_ = 0.0;
};

}  // namespace burin
