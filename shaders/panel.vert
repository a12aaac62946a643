// SPDX-License-Identifier: MIT
#version 460
// The panel's triangles, in pixels from its upper left corner.

layout(push_constant) uniform Panel { vec2 clip_per_px; };
layout(location = 0) in vec2 in_px;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_colour;
layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_colour;

void main() {
    out_uv = in_uv;
    out_colour = in_colour;
    gl_Position = vec4(in_px * clip_per_px - 1.0, 0.0, 1.0);
}
