// SPDX-License-Identifier: MIT
// Shared by the peers that draw with OpenGL (OpenSceneGraph and VTK): an eye's view in OpenGL's conventions, the
// conversion of their pictures, and the light of a way (bench/frame/frame.hpp) as text in GLSL, with the scene's
// constants in it. An eye's axes are the world's, so directions are the same in both frames.
#pragma once

#include <string>

#include "bench/frame/frame.hpp"

namespace burin::bench {

struct GlView {
    Mat4 eye_from_world;  // a translation alone, as the screen stands upright in the plane z = 0
    Mat4 clip_from_eye;
};

// Returns an eye's off-axis view in OpenGL's conventions: y upwards, depth -1 to 1.
[[nodiscard]] GlView gl_view(const FrameScene& scene, const Vec3& eye_world);

// Converts OpenGL's pixels, rows from the bottom, to an opaque image. `row_pixels` may exceed the picture's width.
[[nodiscard]] Image image_of_gl(ImageSize size, const unsigned char* rgba, std::size_t row_pixels);

// Returns the function vec3 light_of(vec3 normal, vec3 to_eye), both of length 1: the colour of a point, encoded as the
// picture has it but for the dither. Burin's light is that of shaders/lighting.glsl far from the tool, without plinth
// and with nothing hidden, as it is on this surface. Compiles as GLSL 1.20 to 1.50.
[[nodiscard]] std::string gl_light_function(const FrameLook& look, FrameLight light);

// Returns the vec3 that a fragment shader adds: Burin's dither, or nothing.
[[nodiscard]] std::string gl_dither(FrameLight light);

}  // namespace burin::bench
