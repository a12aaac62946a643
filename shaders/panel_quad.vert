// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The corners of a panel that stands in the scene, without any vertex buffer: at -0.5 and 0.5 of its own size, which
// world_from_local contains. Where parallax is faded the panel is divided into cells, since it no longer appears flat
// to the eyes.
#include "shaders/frame.glsl"
#include "shaders/placed.glsl"

layout(location = 0) out vec2 out_uv;

const int kCells = kFades ? kFadedPanelCells : 1;  // each way

void main() {
    int cell = gl_VertexIndex / 6, of_cell = gl_VertexIndex % 6;
    vec2 corner = vec2(cell % kCells, cell / kCells) +
                  vec2(of_cell == 1 || of_cell == 2 || of_cell == 4, of_cell == 2 || of_cell == 4 || of_cell == 5);
    corner /= float(kCells);
    out_uv = vec2(corner.x, 1.0 - corner.y);
    gl_Position = placed(draw.world_from_local * vec4(corner - 0.5, 0.0, 1.0));
}
