// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The fragment stage for fine.vert: writes the light that was computed at the vertices.
#include "shaders/frame.glsl"
#include "shaders/lighting.glsl"

layout(location = 0) noperspective in vec3 in_light;

layout(location = 0) out vec4 out_colour;

void main() { out_colour = vec4(kEncodes ? in_light + dither_step() : finished(in_light), 1.0); }
