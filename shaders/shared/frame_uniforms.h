// SPDX-License-Identifier: MIT
// What the renderer's shaders know of a frame (a uniform buffer) and of a draw (push constants). Only vec4 and mat4, so that
// std140 and C++ lay it out alike. Lengths in metres, world frame; colours and light are linear.
#ifndef BURIN_SHARED_FRAME_UNIFORMS_H
#define BURIN_SHARED_FRAME_UNIFORMS_H
#include "shaders/shared/portable.h"

#ifdef __cplusplus
#include <glm/glm.hpp>
#endif

BURIN_SHARED_BEGIN

#ifdef __cplusplus
using vec4 = glm::vec4;
using mat4 = glm::mat4;
#endif

struct FrameUniforms {
    mat4 clip_from_world[2];  // left eye, right eye
    vec4 eye_world[2];        // xyz
    mat4 shadow_from_world;   // xy in 0..1 over the shadow map, z the depth from the light in 0..1
    vec4 light;               // xyz: unit direction towards the light; w: tangent of its half angle
    vec4 light_colour;        // rgb
    vec4 sky_colour;          // rgb: ambient light from above
    vec4 ground_colour;       // rgb: ambient light from below
    vec4 shadow_scale;  // x: depth of the map in metres, y: a texel in metres, z: a texel in map units, w: 1 = in use
    vec4 tool;          // xyz: centre, w: radius; radius 0: no tool
    vec4 tool_colour;   // rgb
    vec4 workpiece;     // xyz: centre of its bounding sphere, w: radius; radius 0: none
    vec4 pedestal;      // xyz: centre of its top, w: radius; radius 0: none
    vec4 background;    // rgb
};

struct DrawConstants {
    mat4 world_from_local;
    vec4 tint;      // rgb multiplies the vertex colour; a: opacity, for glass
    vec4 material;  // x: roughness 0..1, y: strength of reflections, z: 1 = shows the nearness of the tool; glass has
                    // x: how much denser it is towards the edges
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::FrameUniforms) == 3 * 64 + 12 * 16);
static_assert(sizeof(burin::shared::DrawConstants) == 96,
              "must fit the 128 bytes of push constants that every device has");
#endif
#endif
