// SPDX-License-Identifier: MIT
// The data of a frame (a uniform buffer) and of a draw (push constants) for the renderer's shaders. Only vec4 and mat4,
// so that std140 and C++ have the same layout. Lengths in metres, world frame; colours and light are linear.
#ifndef BURIN_SHARED_FRAME_UNIFORMS_H
#define BURIN_SHARED_FRAME_UNIFORMS_H
#include "shaders/shared/glm_names.h"
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

// Capsules that keep light off what is around them, such as the bones of a hand (Scene::capsules).
const int kMostCapsules = 24;

struct FrameUniforms {
    // left eye, right eye; with a guard band around the picture (picture/frame_setup.hpp)
    mat4 clip_from_world[2];
    vec4 eye_world[2];     // xyz
    vec4 light;            // xyz: unit direction towards the lamp; w: tangent of its half angle
    vec4 light_colour;     // rgb
    vec4 sky_colour;       // rgb: ambient light from above
    vec4 ground_colour;    // rgb: ambient light from below
    vec4 tool;             // xyz: first end of its spine (a ball's centre), w: radius around it; radius 0: no tool
    vec4 tool_spine;       // xyz: from there to its other end; zero for a ball
    vec4 tool_colour;      // rgb
    vec4 stylus_tip;       // xyz, w: radius
    vec4 stylus_end;       // xyz
    vec4 workpiece;        // xyz: centre of its bounding sphere, w: radius; radius 0: none
    vec4 pedestal;         // xyz: centre of its top, w: radius; radius 0: none
    vec4 background;       // rgb
    vec4 background_root;  // rgb: its components to the power of 1 / 2.4, as sRGB values have them
    // The view of the point midway between the eyes, without guard band; used for the fade of parallax only.
    mat4 clip_from_world_middle;
    // For parallax_fade.h: x: strength, y: band, z: distance of the point midway between the eyes from the screen; w:
    // the guard band.
    vec4 fade;
    vec4 capsule_from[kMostCapsules];  // xyz: one end, w: radius; radius 0: none
    vec4 capsule_to[kMostCapsules];    // xyz: the other end
    // The shadow map of the objects, as the lamp sees them: x and y -1 to 1 in the map, z 0 to 1 away from the lamp.
    mat4 map_from_world;
    vec4 map;  // x: side of a texel, in the map's width; y: the same in metres; z: metres from z = 0 to 1
};

// A panel in the scene is divided into this many cells each way where parallax is faded, since the fade is computed at
// vertices.
const int kFadedPanelCells = 16;

// Ranges of the tool's effects on its surroundings, from its spine and in the radius around that: beyond them nothing
// changes, so that a picture in which only the tool has moved need be redrawn only within them.
const float kToolNears = 1.8f;    // ring of colour
const float kToolDarkens = 3.5f;  // ambient occlusion
const float kToolShades = 20.0f;  // shadow, along the light

// Of the shadow map, in its texels: how far from a surface, along its normal and towards the lamp, a point is looked
// up, the bounds of half the width of a shadow's edge, and that width where nobody asks how far off the object is.
const float kBesideSurface = 2.0f, kTowardsLamp = 1.0f, kSharpestShadow = 1.2f, kSoftestShadow = 24.0f,
            kUsualShadow = 2.5f;

// Range around the foot of the plinth in which it occludes ambient light on the floor, in metres.
const float kFootDarkens = 0.5f;

struct DrawConstants {
    mat4 world_from_local;
    vec4 tint;  // rgb multiplies the vertex colour; a: opacity, for glass
    // x: roughness 0..1, y: strength of reflections, z: 1 = shows the nearness of the tool, w: 0 = the capsules keep
    // light off it, k > 0 = all but the k-th do, -1 = none does. For glass, x: how much denser it is towards the edges.
    vec4 material;
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::FrameUniforms) == 4 * 64 + (17 + 2 * 24) * 16);
static_assert(sizeof(burin::shared::DrawConstants) == 96,
              "must fit the 128 bytes of push constants that every device has");
#endif
#endif
