// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Sorts the points of each box of a level by their keys: one invocation a point, which counts those before it. So the
// order is that of the host, whatever the order in which they came.
#include "shaders/smooth_buffers.glsl"

void main() {
    int level = int(parameters.step);
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || number >= smooth_counts.points[level]) return;
    SmoothBoxes grid = boxes_of_level(tasks[parameters.ball], level, behind_counts());
    uvec4 key_box = points[number].key_box;
    uint box = grid.firsts + key_box.y;
    uint first = boxes[box];
    uint end = boxes[box + 1u];
    if (end - first > kMostInBox) {
        stop(kBeyondDevice);
        return;
    }
    uint rank = 0u;
    for (uint i = first; i < end; ++i) {
        uint other = order[i];
        uint other_key = points[other].key_box.x;
        if (other_key < key_box.x || (other_key == key_box.x && other < number)) ++rank;
    }
    sorted[first + rank] = points[number];
}
