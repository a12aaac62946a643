// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
// The faces of the haptic workspace's boxes: a clear tint, denser at grazing angles and towards the edges. The same
// shader draws the workspace's bubble, which has no edges: there their strength, material.x, is 0. Premultiplied.

layout(location = 0) in vec3 in_world;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec3 in_local;  // of a box: the unit cube, -0.5 to 0.5

layout(location = 0) out vec4 out_colour;

void main() {
    vec3 v = normalize(frame.eye_world[gl_ViewIndex].xyz - in_world);
    float grazing = 1.0 - abs(dot(normalize(in_normal), v));
    // The face's own coordinate is +-0.5; of the other two, the one nearer to 0.5 gives the distance to an edge.
    vec3 a = abs(in_local);
    float edge = max(min(a.x, a.y), max(min(a.x, a.z), min(a.y, a.z)));
    float alpha = draw.tint.a * (0.5 + 0.7 * grazing + draw.material.x * smoothstep(0.36, 0.5, edge));
    alpha = min(alpha, 0.6);
    out_colour = vec4(in_colour * alpha, alpha);
}
