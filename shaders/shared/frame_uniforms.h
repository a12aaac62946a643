// SPDX-License-Identifier: MIT
// What the renderer's shaders know of a frame (a uniform buffer) and of a draw (push constants). Only vec4 and mat4, so that
// std140 and C++ lay it out alike. Lengths in metres, world frame; colours and light are linear.
#ifndef BURIN_SHARED_FRAME_UNIFORMS_H
#define BURIN_SHARED_FRAME_UNIFORMS_H
#include "shaders/shared/glm_names.h"
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

struct FrameUniforms {
    mat4 clip_from_world[2];  // left eye, right eye; a guard band lies around the picture (renderer/frame_setup.hpp)
    vec4 eye_world[2];        // xyz
    vec4 light;               // xyz: unit direction towards the lamp; w: tangent of its half angle
    vec4 light_colour;        // rgb
    vec4 sky_colour;          // rgb: ambient light from above
    vec4 ground_colour;       // rgb: ambient light from below
    vec4 tool;                // xyz: centre, w: radius; radius 0: no tool
    vec4 tool_colour;         // rgb
    vec4 stylus_tip;          // xyz, w: radius
    vec4 stylus_end;          // xyz
    vec4 workpiece;           // xyz: centre of its bounding sphere, w: radius; radius 0: none
    vec4 pedestal;            // xyz: centre of its top, w: radius; radius 0: none
    vec4 background;          // rgb
    vec4 background_root;     // rgb: its components to the power of 1 / 2.4, as sRGB values have them
    mat4 clip_from_world_middle;  // as the point midway between the eyes sees it, without guard band; for the fade of parallax alone
    vec4 fade;  // parallax_fade.h: x: strength, y: band, z: the middle's distance from the screen; w: the guard band
};

// A standing panel is drawn in so many cells each way where parallax is faded, which is worked out at vertices.
const int kFadedPanelCells = 16;

// How far the tool changes what is around it, in its ball's radii: nothing beyond is touched, so that a picture in which only the tool
// has moved need be drawn anew only there.
const float kToolNears = 1.8f;    // its ring of colour
const float kToolDarkens = 3.5f;  // the ambient light that it keeps off
const float kToolShades = 20.0f;  // its shadow, along the light

// How far from its foot the plinth keeps ambient light off the floor, in metres.
const float kFootDarkens = 0.5f;

struct DrawConstants {
    mat4 world_from_local;
    vec4 tint;      // rgb multiplies the vertex colour; a: opacity, for glass
    vec4 material;  // x: roughness 0..1, y: strength of reflections, z: 1 = shows the nearness of the tool; glass has
                    // x: how much denser it is towards the edges
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::FrameUniforms) == 3 * 64 + 15 * 16);
static_assert(sizeof(burin::shared::DrawConstants) == 96,
              "must fit the 128 bytes of push constants that every device has");
#endif
#endif
