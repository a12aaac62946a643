// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
// The environment fills the picture behind everything else, so one quad at the greatest depth suffices; each pixel
// finds its own point of the environment. A mesh would be clipped by the picture's edges, and Mesa 22.3's software
// driver gives clipped triangles wrong attributes in every view but the first.

layout(location = 0) in vec3 in_position;
layout(location = 0) out vec3 out_screen;  // the point on the screen, world frame

void main() {
    out_screen = (draw.world_from_local * vec4(in_position, 1.0)).xyz;
    gl_Position = vec4(in_position.x, -in_position.y, 1.0, 1.0);
}
