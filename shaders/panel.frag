// SPDX-License-Identifier: MIT
#version 460
// Colours are sRGB values and stay so: letters are designed to be mixed in them. Premultiplied for the overlay.

layout(set = 0, binding = 0) uniform sampler2D atlas;  // how much of a pixel a letter covers
layout(location = 0) in vec2 in_uv;
layout(location = 1) in vec4 in_colour;
layout(location = 0) out vec4 out_colour;

void main() {
    const float alpha = in_colour.a * texture(atlas, in_uv).r;
    out_colour = vec4(in_colour.rgb * alpha, alpha);
}
