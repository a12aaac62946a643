// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
// Depth as the light sees it.

layout(location = 0) in vec3 in_position;

void main() {
    vec4 shadow = frame.shadow_from_world * (draw.world_from_local * vec4(in_position, 1.0));
    gl_Position = vec4(shadow.xy * 2.0 - 1.0, shadow.z, 1.0);
}
