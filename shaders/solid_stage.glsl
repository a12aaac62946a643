// SPDX-License-Identifier: MIT
// The fragment stage of opaque surfaces: lights them at every pixel.
#include "shaders/frame.glsl"
#include "shaders/lighting.glsl"

layout(location = 0) in vec3 in_world;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec2 in_light;

layout(location = 0) out vec4 out_colour;

void main() {
    vec3 eye = frame.eye_world[gl_ViewIndex].xyz;
    out_colour = vec4(finished(lit(in_world, normalize(in_normal), eye, in_colour, in_light.x, in_light.y)), 1.0);
}
