// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The workpiece away from the tool, where light changes little from one vertex to the next: lit here, once per vertex.
#define BURIN_VERTEX_STAGE
#define BURIN_WITH_LIGHT
#define BURIN_FAR_FROM_TOOL
#include "shaders/frame.glsl"
#include "shaders/lighting.glsl"
#include "shaders/placed.glsl"
#include "shaders/vertex_input.glsl"

// Light in the encoding of the picture. Interpolated in screen space: over triangles of some pixels the depth hardly
// differs, and a software driver is spared three divisions a pixel.
layout(location = 0) noperspective out vec3 out_light;

void main() {
    vec4 world = draw.world_from_local * vec4(in_position, 1.0);
    gl_Position = placed(world);
    vec3 eye = frame.eye_world[gl_ViewIndex].xyz;
    vec3 c = lit(world.xyz, normalize(world_normal()), eye, linear_colour(), in_light.x, in_light.y);
    out_light = kEncodes ? srgb_of(c) : c;
}
