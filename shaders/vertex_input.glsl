// SPDX-License-Identifier: MIT
// The vertex attributes: SurfaceVertex, and the light on it.
#include "shaders/shared/srgb.h"

layout(location = 0) in vec3 in_position;
layout(location = 1) in uint in_normal;
layout(location = 2) in vec4 in_colour;  // sRGB
#ifdef BURIN_WITH_LIGHT
layout(location = 3) in vec2 in_light;  // sun, open
#endif

vec3 linear_colour() { return linear_of(in_colour.rgb) * draw.tint.rgb; }

// Returns the normal in the world frame, of any length. Normals are transformed by the cofactor matrix, so that shapes
// may be stretched along their axes.
vec3 world_normal() {
    Direction n = decode_normal(in_normal);
    mat3 m = mat3(draw.world_from_local);
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * vec3(n.x, n.y, n.z);
}
