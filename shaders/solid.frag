// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.glsl"
#include "shaders/lighting.glsl"

layout(location = 0) in vec3 in_world;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;

layout(location = 0) out vec4 out_colour;

// The surface takes the tool's colour where it nears the tool: a ring that closes in on the point of contact. Its width
// follows the tool's size.
float nearness(vec3 world) {
    float gap = length(world - frame.tool.xyz) / frame.tool.w - 1.0;
    return exp(-gap * gap * 30.0) * 0.55;
}

void main() {
    vec3 n = normalize(in_normal);
    vec3 v = normalize(frame.eye_world[gl_ViewIndex].xyz - in_world);
    vec3 l = frame.light.xyz;
    vec3 albedo = in_colour;
    if (draw.material.z > 0.0 && frame.tool.w > 0.0) albedo = mix(albedo, frame.tool_colour.rgb, nearness(in_world));

    float nl = dot(n, l);
    float lit = nl > 0.0 ? sunlight(in_world, n) : 0.0;
    vec3 key = frame.light_colour.rgb * lit;
    float open = openness(in_world, n);
    if (draw.material.z == 0.0) open *= 1.0 - 0.8 * ball_cover(in_world, n, frame.workpiece);
    float roughness = draw.material.x, gloss = draw.material.y;

    vec3 c = albedo * (key * max(nl, 0.0) + ambient_light(n) * open);
    c += key * highlight(n, v, l, roughness) * gloss;
    // The room mirrored: brighter above, and a wide soft lamp around the light; stronger at grazing angles.
    vec3 mirrored = reflect(-v, n);
    float grazing = 1.0 - max(dot(n, v), 0.0);
    float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * (1.0 - 0.6 * roughness);
    float lamp = smoothstep(0.75 - 0.3 * roughness, 0.98, dot(mirrored, l));
    c += (ambient_light(mirrored) + frame.light_colour.rgb * lamp * 0.35 * lit) * fresnel * open * gloss;
    out_colour = vec4(dithered(shoulder(c)), 1.0);
}
