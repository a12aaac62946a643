// SPDX-License-Identifier: MIT
// The lighting of a surface: one light from above (two confuse the sense of depth), ambient light from the sky and the
// ground, and three cues of contact: shadows that sharpen as the tool comes down, ambient darkening, and a ring of the
// tool's colour. Occlusion by the workpiece itself comes with each vertex; occlusion by the tool is computed here in
// closed form.

#include "shaders/shared/srgb.h"

const float kPi = 3.14159265;

// Returns the share of the lamp that a round object hides. The object passes the line to the lamp at distance `miss`,
// `along` that line from the point. The shadow's edge is as wide as the lamp seen from there, so that shadows sharpen
// towards contact.
float hidden_share(float miss, float along, float radius) {
    float soft = max(frame.light.w * along, 0.02 * radius);
    float full = min(1.0, radius * radius / (soft * soft));  // a small object does not cover the lamp
    return full * (1.0 - smoothstep(radius - soft, radius + soft, miss));
}

// Returns the point of the tool's spine that is nearest to a point; of a ball, its centre.
vec3 nearest_of_tool(vec3 world) {
    vec3 spine = frame.tool_spine.xyz;
    float t = clamp(dot(world - frame.tool.xyz, spine) / max(dot(spine, spine), 1e-12), 0.0, 1.0);
    return frame.tool.xyz + t * spine;
}

// A branch saves a software driver nothing, so what cannot matter is left out at compile time: BURIN_FAR_FROM_TOOL is
// for the surface beyond the tool's ring and shadow (renderer/surface/patch_choice.cpp).
#ifndef BURIN_FAR_FROM_TOOL
// Returns the shadow of the tool and its stylus, 0 to 1.
float tool_shadow(vec3 world) {
    if (frame.tool.w <= 0.0) return 0.0;
    vec3 l = frame.light.xyz;
    float r = frame.tool.w;
    // Seen along the light the spine is a segment; of a ball, a point.
    vec3 to_ball = frame.tool.xyz - world;
    float along = dot(to_ball, l);
    vec3 beside = to_ball - along * l;
    float spine_along = dot(frame.tool_spine.xyz, l);
    vec3 spine = frame.tool_spine.xyz - spine_along * l;
    float s = clamp(-dot(beside, spine) / max(dot(spine, spine), 1e-12), 0.0, 1.0);
    along += s * spine_along;
    float reach = kToolShades * r;
    float dark = hidden_share(length(beside + s * spine), max(along, 0.0), r) * smoothstep(0.0, 0.5 * r, along);
    dark *= 1.0 - smoothstep(0.6 * reach, reach, along);
    // Seen along the light the stylus is a segment.
    vec3 to_tip = frame.stylus_tip.xyz - world, to_end = frame.stylus_end.xyz - world;
    float tip_along = dot(to_tip, l), end_along = dot(to_end, l);
    vec3 tip = to_tip - tip_along * l, shaft = to_end - end_along * l - tip;
    float t = clamp(-dot(tip, shaft) / max(dot(shaft, shaft), 1e-12), 0.0, 1.0);
    along = mix(tip_along, end_along, t);
    float radius = frame.stylus_tip.w * mix(0.4, 0.95, smoothstep(0.05, 0.25, t));
    float shaft_dark = hidden_share(length(tip + t * shaft), max(along, 0.0), radius) * smoothstep(0.0, 0.5 * r, along);
    shaft_dark *= 1.0 - smoothstep(0.6 * reach, reach, along);
    return max(dark, shaft_dark);
}
#endif

#ifdef BURIN_SHADOW_MAP
// Returns the i-th of so many places spread evenly over a disc, turned by an angle that has this cosine and sine. (What
// depends on i alone is folded when the shader is compiled.)
vec2 on_disc(int i, int all, vec2 turn) {
    float angle = 2.39996323 * float(i);
    vec2 at = sqrt((float(i) + 0.5) / float(all)) * vec2(cos(angle), sin(angle));
    return vec2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x);
}

// Returns the shadow of the objects, 0 to 1; n: the surface's normal. Its edge is as wide as the lamp appears from
// there (Fernando 2005): what is between the point and the lamp is looked for around the line to the lamp, and then its
// mean distance says how far apart the look-ups are. Each is at the depth of the surface's own plane there, so that a
// surface which is seen aslant does not shade itself.
float object_shadow(vec3 world, vec3 n) {
    vec3 l = frame.light.xyz;
    float sine = sqrt(max(1.0 - dot(n, l) * dot(n, l), 0.0));
    vec3 beside = world + frame.map.y * (kBesideSurface * sine * n + kTowardsLamp * l);
    vec3 at = (frame.map_from_world * vec4(beside, 1.0)).xyz;
    vec2 uv = 0.5 + 0.5 * at.xy;
    vec3 across = mat3(frame.map_from_world) * n;
    float side = frame.map.y / frame.map.x;
    vec2 slope = across.xy * (-0.5 * side * side / (frame.map.z * frame.map.z)) / min(across.z, -0.1 / frame.map.z);
    // By quarters of a turn from pixel to pixel, so that each 2 x 2 together have four times as many look-ups.
    float angle = 2.0 * kPi * fract(dot(gl_FragCoord.xy, vec2(0.5, 0.75)) - 0.625);
    vec2 turn = vec2(cos(angle), sin(angle));
    float apart = frame.map.x * kUsualShadow;
    if (kFinders > 0) {
        float spread = frame.light.w * frame.map.z / frame.map.y;  // of the lamp's disc, texels for each unit of depth
        float around = frame.map.x * clamp(spread * at.z, kSharpestShadow, kSoftestShadow);
        float found = 0.0, gap = 0.0;
        for (int i = 0; i < kFinders; ++i) {
            vec2 off = around * on_disc(i, kFinders, turn);
            float before = at.z + dot(slope, off) - texture(shadow_depths, uv + off).r;
            found += step(0.0, before);
            gap += max(before, 0.0);
        }
        apart = frame.map.x * clamp(spread * gap / max(found, 1.0), kSharpestShadow, kSoftestShadow);
    }
    float seen = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        vec2 off = apart * on_disc(i, kTaps, turn);
        seen += texture(shadow_map, vec3(uv + off, clamp(at.z + dot(slope, off), 0.0, 1.0)));
    }
    return 1.0 - seen / float(kTaps);
}
#endif

#ifndef BURIN_FAR_FROM_TOOL
// Returns the shadow of the workpiece on the plinth, 0 to 1: that of a ball of its typical size, as on the floor.
float workpiece_shadow(vec3 world) {
    vec3 to_ball = frame.workpiece.xyz - world;
    float along = dot(to_ball, frame.light.xyz);
    float miss = length(to_ball - along * frame.light.xyz);
    return hidden_share(miss, max(2.2 * along, 0.0), max(frame.workpiece.w, 1e-6)) * step(1e-6, frame.workpiece.w);
}
#endif

// Returns 1 for a capsule that there is and that does not stand for what is drawn, else 0.
float casts(int capsule) {
    return step(1e-9, frame.capsule_from[capsule].w) * min(abs(draw.material.w - float(capsule + 1)), 1.0);
}

// Returns the shadow of the capsules, 0 to 1: the darkest of theirs, since those of one hand overlap at its joints.
float capsule_shadow(vec3 world) {
    vec3 l = frame.light.xyz;
    float dark = 0.0;
    for (int i = 0; i < kMostCapsules; ++i) {
        float r = frame.capsule_from[i].w;
        vec3 to_from = frame.capsule_from[i].xyz - world, axis = frame.capsule_to[i].xyz - frame.capsule_from[i].xyz;
        // Seen along the light the axis is a segment.
        float along = dot(to_from, l), rise = dot(axis, l);
        vec3 beside = to_from - along * l, flat_axis = axis - rise * l;
        float s = clamp(-dot(beside, flat_axis) / max(dot(flat_axis, flat_axis), 1e-12), 0.0, 1.0);
        along += s * rise;
        dark = max(dark, hidden_share(length(beside + s * flat_axis), max(along, 0.0), max(r, 1e-6)) *
                             smoothstep(0.0, 0.5 * r, along) * casts(i));
    }
    return dark;
}

// Returns how much of the hemisphere over a point a ball covers, cosine-weighted; exact while all of it is above the
// horizon.
float ball_cover(vec3 world, vec3 normal, vec4 ball) {
    if (ball.w <= 0.0) return 0.0;
    vec3 to_ball = ball.xyz - world;
    float distance_m = max(length(to_ball), ball.w * 1.0001);
    float sine = ball.w / distance_m;
    return max(dot(normal, to_ball) / distance_m, 0.0) * sine * sine;
}

// Returns how much of the hemisphere over a point the nearest of the capsules covers.
float capsule_cover(vec3 world, vec3 normal) {
    float cover = 0.0;
    for (int i = 0; i < kMostCapsules; ++i) {
        vec3 from = frame.capsule_from[i].xyz, axis = frame.capsule_to[i].xyz - from;
        float t = clamp(dot(world - from, axis) / max(dot(axis, axis), 1e-12), 0.0, 1.0);
        cover = max(cover, casts(i) * ball_cover(world, normal, vec4(from + t * axis, frame.capsule_from[i].w)));
    }
    return cover;
}

// Returns the share of ambient light that reaches a point beside the tool and over the plinth.
float openness(vec3 world, vec3 normal) {
    vec3 tool = nearest_of_tool(world);
    float from_tool = length(tool - world);
    float near_tool = 1.0 - smoothstep(0.4 * kToolDarkens, kToolDarkens, from_tool / max(frame.tool.w, 1e-6));
    float open = 1.0 - 0.85 * near_tool * ball_cover(world, normal, vec4(tool, frame.tool.w));
    if (frame.pedestal.w > 0.0 && world.y >= frame.pedestal.y - 0.001) {
        // The plinth's top is a disc below the point: the part of the lower hemisphere that it hides, as seen above its
        // centre.
        float height = world.y - frame.pedestal.y;
        float r2 = frame.pedestal.w * frame.pedestal.w;
        vec2 from_axis = world.xz - frame.pedestal.xz;
        float near_axis = 1.0 - smoothstep(0.6 * r2, 1.6 * r2, dot(from_axis, from_axis));
        open *= 1.0 - 0.55 * near_axis * max(-normal.y, 0.0) * r2 / (r2 + 4.0 * height * height);
    }
    return open;
}

// Compresses highlights with a soft shoulder instead of clipping: the identity below 0.7, never beyond 1.
vec3 shoulder(vec3 c) { return mix(c, 1.0 - 0.3 * exp(-(max(c, vec3(0.7)) - 0.7) / 0.3), greaterThan(c, vec3(0.7))); }

vec3 ambient_light(vec3 normal) {
    return mix(frame.ground_colour.rgb, frame.sky_colour.rgb, 0.5 + 0.5 * normal.y);
}

// GGX with Smith-Schlick visibility and Schlick's Fresnel term for a dielectric.
float highlight(vec3 n, vec3 v, vec3 l, float roughness) {
    vec3 h = normalize(v + l);
    float nl = max(dot(n, l), 0.0), nv = max(dot(n, v), 0.001), nh = max(dot(n, h), 0.0), vh = max(dot(v, h), 0.0);
    float a = roughness * roughness, a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    float visibility = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    float one_minus = 1.0 - vh, squared = one_minus * one_minus;
    float fresnel = 0.04 + 0.96 * squared * squared * one_minus;
    return nl * a2 / (kPi * d * d) * visibility * 0.25 * fresnel * kPi;  // light_colour is irradiance over pi
}

#ifndef BURIN_FAR_FROM_TOOL
// Blends the tool's colour into the surface near the tool: a ring that closes in on the point of contact. Its width
// follows the tool's size.
vec3 ringed(vec3 albedo, vec3 world) {
    if (draw.material.z <= 0.0 || frame.tool.w <= 0.0) return albedo;
    float distance_r = length(world - nearest_of_tool(world)) / frame.tool.w;
    float gap = distance_r - 1.0;
    float near = exp(-gap * gap * 30.0) * 0.55 * (1.0 - smoothstep(1.4, kToolNears, distance_r));
    return mix(albedo, frame.tool_colour.rgb, near);
}
#endif

// Returns the light from a point of a surface to an eye. sun, open: the shares of the lamp's and of the surroundings'
// light that other parts of the workpiece let through.
vec3 lit(vec3 world, vec3 n, vec3 eye, vec3 colour, float sun, float open) {
    vec3 v = normalize(eye - world);
    vec3 l = frame.light.xyz;
    float nl = dot(n, l);
    open *= openness(world, n);
#ifdef BURIN_FAR_FROM_TOOL
    vec3 albedo = colour;
    float light = nl > 0.0 ? sun : 0.0;
#else
    vec3 albedo = ringed(colour, world);
    float light = nl > 0.0 ? sun * (1.0 - tool_shadow(world)) : 0.0;
    if (draw.material.z <= 0.0) open *= 1.0 - 0.8 * ball_cover(world, n, frame.workpiece);
    if (draw.material.z < 0.0) light *= 1.0 - 0.7 * workpiece_shadow(world);
#endif
#ifdef BURIN_SHADOW_MAP
    light *= 1.0 - object_shadow(world, n);
#endif
    if (kCapsules && draw.material.w >= 0.0) {
        light *= 1.0 - capsule_shadow(world);
        open *= 1.0 - 0.75 * capsule_cover(world, n);
    }
    vec3 key = frame.light_colour.rgb * light;
    float roughness = draw.material.x, gloss = draw.material.y;

    vec3 c = albedo * (key * max(nl, 0.0) + ambient_light(n) * open);
    c += key * highlight(n, v, l, roughness) * gloss;
    // The reflected environment: brighter above, with a wide soft lamp around the light; stronger at grazing angles.
    vec3 mirrored = reflect(-v, n);
    float grazing = 1.0 - max(dot(n, v), 0.0);
    float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * (1.0 - 0.6 * roughness);
    float lamp = smoothstep(0.75 - 0.3 * roughness, 0.98, dot(mirrored, l));
    c += (ambient_light(mirrored) + frame.light_colour.rgb * lamp * 0.35 * light) * fresnel * open * gloss;
    return shoulder(c);
}

#ifndef BURIN_VERTEX_STAGE
// Returns a dither of up to half a step of the 8-bit picture, in an ordered pattern in which every 2 x 2 pixels have
// four values, so that soft gradients show no bands. Without integers, which cost a software driver more than the
// lighting. A step of sRGB is 2.4 c^(1.4/2.4) / 1.055 steps of linear light.
float dither_step() {
    float quarter = fract(dot(gl_FragCoord.xy, vec2(0.5, 0.75)) - 0.625);  // 0, 1/4, 1/2 or 3/4
    return (quarter * (4.0 / 3.0) - 0.5) / 255.0;
}
// Converts linear light to the encoding of the picture, dithered.
vec3 finished(vec3 c) {
    return kEncodes ? srgb_of(c) + dither_step() : c + dither_step() * 2.27 * pow(c, vec3(0.58));
}
#endif
