// SPDX-License-Identifier: MIT
// The vertex stage of surfaces that are lit at every pixel, and of glass; vertices are SurfaceVertex with VertexLight.
// A program selects what its fragment stage reads by BURIN_WITH_LIGHT and BURIN_WITH_LOCAL.
#include "shaders/placed.glsl"
#include "shaders/vertex_input.glsl"

layout(location = 0) out vec3 out_world;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_colour;  // linear
#ifdef BURIN_WITH_LIGHT
layout(location = 3) out vec2 out_light;  // sun, open
#endif
#ifdef BURIN_WITH_LOCAL
layout(location = 3) out vec3 out_local;
#endif

void main() {
    vec4 world = draw.world_from_local * vec4(in_position, 1.0);
    gl_Position = placed(world);
    out_world = world.xyz;
    out_normal = world_normal();
    out_colour = linear_colour();
#ifdef BURIN_WITH_LIGHT
    out_light = in_light;
#endif
#ifdef BURIN_WITH_LOCAL
    out_local = in_position;
#endif
}
