// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Gives the boxes of a row of a level their places among the sorted points, one behind the other: one invocation a row.
// Where a row begins is any; where its points lie in it is not. Leaves the counts of boxes and rows at zero.
#include "shaders/smooth_buffers.glsl"

void main() {
    if (is_stopped()) return;
    SmoothTask task = tasks[parameters.ball];
    int level = int(parameters.step);
    SmoothBoxes grid = boxes_of_level(task, level, behind_counts());
    uint row = gl_GlobalInvocationID.x;
    if (row >= uint(grid.y * grid.z)) return;
    uint count = boxes[parameters.boxes + row];
    boxes[grid.rows + row] = count;
    if (count == 0u) return;
    uint next = first_of_level(level) + atomicAdd(smooth_counts.placed[level], count);
    // The counts are left as they are: the host clears all of them where a pass was stopped.
    if (next + count > parameters.sorted) {
        stop(kShortOfSpace);
        return;
    }
    boxes[parameters.boxes + row] = 0u;
    uint first = row * uint(grid.x + 1);
    for (uint x = 0u; x < uint(grid.x); ++x) {
        boxes[grid.firsts + first + x] = next;
        next += boxes[first + x];
        boxes[first + x] = 0u;
    }
    boxes[grid.firsts + first + uint(grid.x)] = next;
}
