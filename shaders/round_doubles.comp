// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Computes quotients, roots, products and sums of doubles, for the host to compare with its own
// (compute/vulkan/rounding_check.hpp).
#include "shaders/shared/rounding_case.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; };
layout(std430, binding = 0) readonly buffer Cases { RoundingCase cases[]; };
layout(std430, binding = 1) writeonly buffer Rounded { RoundedDoubles rounded[]; };

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number < count) rounded[number] = rounded_doubles(cases[number]);
}
