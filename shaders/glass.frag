// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
#include "shaders/shared/srgb.h"
// The faces of the haptic workspace's boxes: a clear tint, denser at grazing angles and towards the edges. The same
// shader draws the workspace's bubble, which has no edges: there their strength, material.x, is 0. Objects through
// which one sees are shaded, material.y is 1: darker where they turn from the light, with a highlight. An outline of
// what something hides, material.y is 2, is dense where the surface turns from the eye. Premultiplied linear light,
// which the device adds up as such (FrameTargets::glass_pass); the outline alone lies in the pass of what is solid.

layout(location = 0) in vec3 in_world;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec3 in_local;  // of a box: the unit cube, -0.5 to 0.5

layout(location = 0) out vec4 out_colour;

void main() {
    vec3 v = normalize(frame.eye_world[gl_ViewIndex].xyz - in_world);
    vec3 n = normalize(in_normal);
    n = dot(n, v) < 0.0 ? -n : n;  // a face is seen from either side
    float grazing = 1.0 - dot(n, v);
    // The face's own coordinate is +-0.5; of the other two, the one nearer to 0.5 gives the distance to an edge.
    vec3 a = abs(in_local);
    float edge = max(min(a.x, a.y), max(min(a.x, a.z), min(a.y, a.z)));
    float alpha = draw.tint.a * (0.5 + 0.7 * grazing + draw.material.x * smoothstep(0.36, 0.5, edge));
    if (draw.material.y == 0.0) {
        alpha = min(alpha, 0.6);
        out_colour = vec4(in_colour * alpha, alpha);
        return;
    }
    if (draw.material.y == 2.0) {
        alpha = draw.tint.a + 0.6 * smoothstep(0.45, 0.9, grazing);
        vec3 c = in_colour * alpha;
        if (kEncodes) {
            // As for the panel (panel_quad.frag): the value whose blend in sRGB equals that of linear light over the
            // background's grey.
            vec3 ground = frame.background.rgb;
            c = srgb_of(c + ground * (1.0 - alpha)) - srgb_of(ground) * (1.0 - alpha);
        }
        out_colour = vec4(c, alpha);
        return;
    }
    alpha = min(draw.tint.a * (0.75 + 0.5 * grazing), 1.0);
    float lit = 0.55 + 0.55 * max(dot(n, frame.light.xyz), 0.0);
    float shine = 0.25 * pow(max(dot(n, normalize(v + frame.light.xyz)), 0.0), 40.0);
    out_colour = vec4(in_colour * lit * alpha + shine, alpha);
}
