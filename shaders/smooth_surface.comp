// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Lists the nodes next to the surface that the tool reaches, the first wave: one invocation a node.
#include "shaders/smooth_buffers.glsl"

void main() {
    if (is_stopped()) return;
    SmoothTask task = tasks[parameters.ball];
    int width = task.hi[0] - task.lo[0] + 3;
    int height = task.hi[1] - task.lo[1] + 3;
    int depth = task.hi[2] - task.lo[2] + 3;
    uint number = gl_GlobalInvocationID.x;
    if (number >= uint(width * height * depth)) return;
    uint flags = nodes[number].flags;
    if ((flags & kWeighs) == 0u) return;  // among them are all nodes at the border of the box
    uint up = uint(width);
    uint far = uint(width * height);
    bool is_crossed = ((nodes[number - 1u].flags ^ flags) & kWasInside) != 0u ||
                      ((nodes[number + 1u].flags ^ flags) & kWasInside) != 0u ||
                      ((nodes[number - up].flags ^ flags) & kWasInside) != 0u ||
                      ((nodes[number + up].flags ^ flags) & kWasInside) != 0u ||
                      ((nodes[number - far].flags ^ flags) & kWasInside) != 0u ||
                      ((nodes[number + far].flags ^ flags) & kWasInside) != 0u;
    if (!is_crossed) return;
    atomicOr(nodes[number].flags, kIsKnown);
    uint place = atomicAdd(smooth_counts.waves[0], 1u);
    if (place >= parameters.waves) {
        stop(kShortOfSpace);
        return;
    }
    waves[place] = number;
    atomicMax(smooth_counts.of_waves[0].x, groups_for(place + 1u));
}
