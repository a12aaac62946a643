// SPDX-License-Identifier: MIT
#version 460
// Draws the panel's triangles. Colours stay sRGB values, since letters are designed to be blended in them.
// Premultiplied for the overlay.

layout(set = 0, binding = 0) uniform sampler2D atlas;  // coverage of a pixel by a letter
layout(location = 0) in vec2 in_uv;
layout(location = 1) in vec4 in_colour;
layout(location = 0) out vec4 out_colour;

void main() {
    const float alpha = in_colour.a * texture(atlas, in_uv).r;
    out_colour = vec4(in_colour.rgb * alpha, alpha);
}
