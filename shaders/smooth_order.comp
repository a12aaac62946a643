// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Lists the points of each box of a level, in the order in which they came: one invocation a point.
#include "shaders/smooth_buffers.glsl"

void main() {
    int level = int(parameters.step);
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || number >= smooth_counts.points[level]) return;
    SmoothBoxes grid = boxes_of_level(tasks[parameters.ball], level, behind_counts());
    uvec4 key_box = points[number].key_box;
    order[boxes[grid.firsts + key_box.y] + key_box.z] = number;
}
