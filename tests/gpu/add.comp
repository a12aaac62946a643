// SPDX-License-Identifier: MIT
#version 460
// out[i] = in[i] * factor + kOffset, for the tests of gpu/.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kOffset = 0;
layout(std430, binding = 0) readonly buffer In { uint values[]; } source;
layout(std430, binding = 1) writeonly buffer Out { uint values[]; } target;
layout(push_constant) uniform Push { uint count; uint factor; } push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < push.count) target.values[i] = source.values[i] * push.factor + kOffset;
}
