// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Begins a pass that smooths, unless something before it is undone: then what the pass that stopped has counted stays.
#include "shaders/smooth_buffers.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    if (counters.left[parameters.pass] != 0u) {
        smooth_counts.stopped = 1u;
        return;
    }
    const SmoothGroups none = SmoothGroups(0u, 1u, 1u);
    smooth_counts.stopped = 0u;
    smooth_counts.why = 0u;
    smooth_counts.unstored = 0u;
    smooth_counts.ends = 0u;
    smooth_counts.rays = 0u;
    smooth_counts.fresh = 0u;
    smooth_counts.of_ends = none;
    smooth_counts.of_rays = none;
    for (int i = 0; i < kMostLevels; ++i) {
        smooth_counts.points[i] = 0u;
        smooth_counts.placed[i] = 0u;
        smooth_counts.of_points[i] = none;
    }
    for (int i = 0; i <= kMostWaves; ++i) {
        smooth_counts.waves[i] = 0u;
        smooth_counts.of_waves[i] = none;
    }
}
