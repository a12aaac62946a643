// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
#include "shaders/shared/srgb.h"
// Draws a panel that stands in the scene. Its picture holds sRGB values, premultiplied; it is emissive, so neither lamp
// nor shadow changes it. Where a pixel of the picture is as large as one of the panel, the panel's own values result;
// where the panel appears smaller than it was painted, four taps over the pixel's footprint keep letters whole.

layout(set = 1, binding = 0) uniform sampler2D panel;
layout(location = 0) in vec2 in_uv;
layout(location = 0) out vec4 out_colour;

// Returns the offset from the footprint's centre to its taps: zero where the footprint is at most one pixel of the
// panel, growing towards a quarter of a large footprint.
vec2 spread(vec2 footprint) {
    float size_px = length(footprint * vec2(textureSize(panel, 0)));
    return 0.25 * footprint * max(1.0 - 1.0 / max(size_px, 1.0), 0.0);
}

void main() {
    vec2 across = spread(dFdx(in_uv)), down = spread(dFdy(in_uv));
    vec4 c = 0.25 * (texture(panel, in_uv + across + down) + texture(panel, in_uv + across - down) +
                     texture(panel, in_uv - across + down) + texture(panel, in_uv - across - down));
    if (c.a < 1.0 / 512.0) discard;  // writes no depth either
    c.rgb = linear_of(min(c.rgb / c.a, 1.0)) * c.a;
    if (kEncodes) {
        // The device blends sRGB values here: the value is chosen so that the blend equals that of linear light over
        // the background's grey, as where the panel is laid over the eyes' pictures.
        vec3 ground = frame.background.rgb;
        c.rgb = srgb_of(c.rgb + ground * (1.0 - c.a)) - srgb_of(ground) * (1.0 - c.a);
    }
    out_colour = c;
}
