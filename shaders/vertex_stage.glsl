// SPDX-License-Identifier: MIT
// The vertex stage of everything but the shadow map; vertices are SurfaceVertex. A program asks for what its fragment stage
// reads, by BURIN_WITH_COLOUR and BURIN_WITH_LOCAL.

layout(location = 0) in vec3 in_position;
layout(location = 1) in uint in_normal;
layout(location = 0) out vec3 out_world;
layout(location = 1) out vec3 out_normal;
#ifdef BURIN_WITH_COLOUR
layout(location = 2) in vec4 in_colour;  // sRGB
layout(location = 2) out vec3 out_colour;  // linear
#endif
#ifdef BURIN_WITH_LOCAL
layout(location = 3) out vec3 out_local;
#endif

// IEC 61966-2-1.
vec3 linear_of(vec3 srgb) {
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

void main() {
    vec4 world = draw.world_from_local * vec4(in_position, 1.0);
    gl_Position = frame.clip_from_world[gl_ViewIndex] * world;
    Direction n = decode_normal(in_normal);
    // Normals turn with the cofactor matrix, so that shapes may be stretched along their axes.
    mat3 m = mat3(draw.world_from_local);
    out_normal = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * vec3(n.x, n.y, n.z);
    out_world = world.xyz;
#ifdef BURIN_WITH_COLOUR
    out_colour = linear_of(in_colour.rgb) * draw.tint.rgb;
#endif
#ifdef BURIN_WITH_LOCAL
    out_local = in_position;
#endif
}
