// SPDX-License-Identifier: MIT
// Light on a surface. One light from above (two confuse the sense of depth), ambient light from the sky and the ground, and
// three cues of contact: shadows that sharpen as the tool comes down, ambient darkening, and a ring of the tool's colour.

const float kPi = 3.14159265;

// The i-th of n points spread evenly over the unit disc (a Vogel spiral: the golden angle between neighbours).
vec2 disc_point(int i, int n) {
    float r = sqrt((float(i) + 0.5) / float(n));
    float a = float(i) * 2.39996323;
    return r * vec2(cos(a), sin(a));
}

// 0 in full shadow, 1 in full light. Percentage-closer soft shadows (Fernando 2005): the mean distance to what casts the
// shadow gives the width of its edge. No random rotation: noise would differ from the surface in stereo.
float sunlight(vec3 world, vec3 normal) {
    const int kSearch = 9, kTaps = 16;
    float texel_m = frame.shadow_scale.y;
    vec3 lifted = world + normal * (2.0 * texel_m);  // clear of its own texels
    vec3 at = (frame.shadow_from_world * vec4(lifted, 1.0)).xyz;
    if (frame.shadow_scale.w == 0.0 || any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
    float texel = frame.shadow_scale.z;

    const float kSearchTexels = 12.0;
    float blockers = 0.0, gap = 0.0;
    for (int i = 0; i < kSearch; ++i) {
        float depth = textureLod(shadow_depth, at.xy + disc_point(i, kSearch) * kSearchTexels * texel, 0.0).r;
        if (depth < at.z) {
            blockers += 1.0;
            gap += at.z - depth;
        }
    }
    if (blockers == 0.0) return 1.0;
    float gap_m = gap / blockers * frame.shadow_scale.x;
    float radius = clamp(gap_m * frame.light.w / texel_m, 1.2, kSearchTexels);
    float lit = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        lit += textureLod(shadow_compare, vec3(at.xy + disc_point(i, kTaps) * radius * texel, at.z), 0.0);
    }
    return lit / float(kTaps);
}

// How much of the hemisphere over a point a ball covers, cosine-weighted; exact while all of it is above the horizon.
float ball_cover(vec3 world, vec3 normal, vec4 ball) {
    if (ball.w <= 0.0) return 0.0;
    vec3 to_ball = ball.xyz - world;
    float distance_m = max(length(to_ball), ball.w * 1.0001);
    float sine = ball.w / distance_m;
    return max(dot(normal, to_ball) / distance_m, 0.0) * sine * sine;
}

// Ambient light that reaches a point beside the tool and over the plinth.
float openness(vec3 world, vec3 normal) {
    float open = 1.0 - 0.85 * ball_cover(world, normal, frame.tool);
    if (frame.pedestal.w > 0.0 && world.y >= frame.pedestal.y - 0.001) {
        // Looking down at a disc: the part of the lower hemisphere that it hides, seen from above its middle.
        float height = world.y - frame.pedestal.y;
        float r2 = frame.pedestal.w * frame.pedestal.w;
        vec2 from_axis = world.xz - frame.pedestal.xz;
        float near_axis = 1.0 - smoothstep(0.6 * r2, 1.6 * r2, dot(from_axis, from_axis));
        open *= 1.0 - 0.55 * near_axis * max(-normal.y, 0.0) * r2 / (r2 + 4.0 * height * height);
    }
    return open;
}

// A soft shoulder instead of clipping: the identity below 0.7, never beyond 1.
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

// Adds half a step of the 8-bit picture in an ordered pattern, so that soft gradients show no bands. A step of
// sRGB is 2.4 c^(1.4/2.4) / 1.055 steps of linear light.
vec3 dithered(vec3 c) {
    uvec2 at = uvec2(gl_FragCoord.xy);
    uint cell = ((at.x ^ at.y) & 1u) * 2u + (at.y & 1u);
    return c + (float(cell) / 3.0 - 0.5) / 255.0 * 2.27 * pow(c, vec3(0.58));
}
