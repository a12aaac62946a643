// SPDX-License-Identifier: MIT
// The light of a way (bench/frame/frame.hpp) as text in the GLSL that OpenSceneGraph and VTK compile, with the scene's
// constants in it. An eye's axes are the world's, so directions are the same in both frames.
#pragma once

#include <string>

#include "bench/frame/frame.hpp"

namespace burin::bench {

// Returns the function vec3 light_of(vec3 normal, vec3 to_eye), both of length 1: the colour of a point, encoded as the
// picture has it but for the dither. Burin's light is that of shaders/lighting.glsl far from the tool, without plinth
// and with nothing hidden, as it is on this surface. Compiles as GLSL 1.20 to 1.50.
[[nodiscard]] std::string gl_light_function(const FrameLook& look, FrameLight light);

// Returns the vec3 that a fragment shader adds: Burin's dither, or nothing.
[[nodiscard]] std::string gl_dither(FrameLight light);

}  // namespace burin::bench
