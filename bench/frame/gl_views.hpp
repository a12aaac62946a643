// SPDX-License-Identifier: MIT
// Converts an eye's off-axis view to OpenGL's conventions: y upwards, depth -1 to 1.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "bench/frame/frame_scene.hpp"
#include "wall/projection.hpp"

namespace burin::bench {

struct GlView {
    Mat4 eye_from_world;  // a translation alone, as the screen stands upright in the plane z = 0
    Mat4 clip_from_eye;
};

[[nodiscard]] inline GlView gl_view(const FrameScene& scene, const Vec3& eye_world) {
    Mat4 gl_from_vulkan(1.0);
    gl_from_vulkan[1][1] = -1.0;
    gl_from_vulkan[2][2] = 2.0;
    gl_from_vulkan[3][2] = -1.0;  // z' = 2 z - w
    const Mat4 clip_from_world =
        gl_from_vulkan * off_axis_projection(scene.screen, eye_world, scene.near_m, scene.far_m);
    return {glm::translate(Mat4(1.0), -eye_world), clip_from_world * glm::translate(Mat4(1.0), eye_world)};
}

// Converts OpenGL's pixels, rows from the bottom, to an opaque image. `row_pixels` may exceed the picture's width.
[[nodiscard]] inline Image image_of_gl(ImageSize size, const unsigned char* rgba, std::size_t row_pixels) {
    Image image{size, {}};
    image.rgba.reserve(std::size_t{4} * size.width * size.height);
    for (std::uint32_t y = size.height; y-- > 0;) {
        const unsigned char* row = rgba + 4 * row_pixels * y;
        image.rgba.insert(image.rgba.end(), row, row + std::size_t{4} * size.width);
    }
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

}  // namespace burin::bench
