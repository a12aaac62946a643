// SPDX-License-Identifier: MIT
#include "shaders/frame.glsl"
#include "shaders/lighting.glsl"
// The environment: a floor that rises softly into a backdrop, graded around mid-grey, with a fine grid and with the
// shadows of the workpiece and the plinth. The light comes from far above, so closed forms of a ball and a cylinder
// serve a workpiece better than a shadow map; the objects of a world are in one.

// Whether grid and shadows are visible and therefore drawn (renderer/frame/scene_choice.cpp).
layout(constant_id = 2) const bool kGrid = true;
layout(constant_id = 3) const bool kShadows = true;

layout(location = 0) in vec3 in_screen;

layout(location = 0) out vec4 out_colour;

// Returns the strength of the grid at a point, 0 to 1: anti-aliased over one pixel and fading where lines would crowd.
float grid(vec2 p, float cell_m, float width_m) {
    vec2 pixel = fwidth(p);
    vec2 to_line = abs(fract(p / cell_m - 0.5) - 0.5) * cell_m;
    vec2 half_width = max(vec2(0.5 * width_m), 0.7 * pixel);
    vec2 on = 1.0 - smoothstep(half_width - 0.5 * pixel, half_width + 0.5 * pixel, to_line);
    on *= clamp(width_m / max(pixel, vec2(1e-5)), 0.35, 1.0);             // thinner than a pixel: fainter
    on *= 1.0 - smoothstep(vec2(0.15 * cell_m), vec2(0.45 * cell_m), pixel);  // crowded: gone
    return max(on.x, on.y);
}

// Returns the shadow of a ball far above, with an edge as wide as the gap times the light's size.
float ball_shadow(vec3 world, vec4 ball) {
    if (ball.w <= 0.0) return 0.0;
    vec3 to_ball = ball.xyz - world;
    float along = dot(to_ball, frame.light.xyz);
    if (along <= 0.0) return 0.0;
    float miss = length(to_ball - along * frame.light.xyz);
    float soft = max(2.2 * frame.light.w * along, 0.01);
    float full = min(1.0, ball.w * ball.w / (soft * soft));  // a small ball does not cover the lamp
    return full * (1.0 - smoothstep(ball.w - soft, ball.w + soft, miss));
}

// Returns the shadow of the upright plinth on the floor: the discs from its base to its top, projected along the light,
// form a capsule.
float pedestal_shadow(vec3 world) {
    if (frame.pedestal.w <= 0.0) return 0.0;
    vec2 reach = -frame.light.xz / frame.light.y * frame.pedestal.y;
    vec2 from_base = world.xz - frame.pedestal.xz;
    float t = clamp(dot(from_base, reach) / max(dot(reach, reach), 1e-6), 0.0, 1.0);
    float soft = 0.012 + 2.2 * frame.light.w * t * frame.pedestal.y;
    float away = length(from_base - t * reach);
    return 1.0 - smoothstep(frame.pedestal.w - soft, frame.pedestal.w + soft, away);
}

// Shape of the environment in y and z: the floor y = 0 from the front to kBend_m, a quarter circle, and the wall
// behind.
const float kBend_m = -2.4, kRadius_m = 1.6;

// Returns where the line of sight along d meets the environment, and in `level` how level it is there: 1 on the floor,
// 0 on the wall.
vec3 place_in_room(vec3 eye, vec3 d, out float level) {
    level = 1.0;
    float to_floor = d.y < 0.0 ? -eye.y / d.y : 1e9;
    if (d.y < 0.0 && eye.z + to_floor * d.z >= kBend_m) return eye + to_floor * d;
    level = 0.0;
    if (d.z >= -1e-4) return eye + d * (30.0 / length(d));  // does not meet the wall: a point 30 m away
    float to_wall = (kBend_m - kRadius_m - eye.z) / d.z;
    if (eye.y + to_wall * d.y >= kRadius_m) return eye + to_wall * d;
    // The far side of the circle around (kRadius_m, kBend_m) in (y, z).
    vec2 from = eye.yz - vec2(kRadius_m, kBend_m);
    float a = dot(d.yz, d.yz), b = dot(from, d.yz), c = dot(from, from) - kRadius_m * kRadius_m;
    vec3 p = eye + d * ((-b + sqrt(max(b * b - a * c, 0.0))) / a);
    level = clamp((kRadius_m - p.y) / kRadius_m, 0.0, 1.0);
    return p;
}

// Equals srgb_of(frame.background.rgb * share), with one power instead of three.
vec3 srgb_of_background(float share) {
    vec3 light = frame.background.rgb * share;
    vec3 bright = 1.055 * pow(share, 1.0 / 2.4) * frame.background_root.rgb - 0.055;
    return mix(light * 12.92, bright, greaterThan(light, vec3(0.0031308)));
}

void main() {
    vec3 eye = frame.eye_world[gl_ViewIndex].xyz;
    float level;
    vec3 world = place_in_room(eye, in_screen - eye, level);
    // Brightest around the work, falling off to the sides: this leads the eye to the middle without any edge.
    float away = length((world - vec3(0.0, 0.9, -2.2)) * vec3(0.75, 1.0, 0.55));
    float c = mix(1.25, 0.60, smoothstep(0.2, 4.2, away));  // share of the background's light

    if (kGrid) {
        float floor_part = smoothstep(0.975, 1.0, level);  // the grid fades where the floor begins to rise
        float lines = 0.16 * grid(world.xz, 1.0, 0.010) + 0.10 * grid(world.xz, 0.25, 0.005);
        c *= 1.0 - floor_part * min(lines, 0.2);
    }
    if (kShadows) {
        float dark = 1.0 - (1.0 - 0.55 * ball_shadow(world, frame.workpiece)) * (1.0 - 0.62 * pedestal_shadow(world));
#ifdef BURIN_SHADOW_MAP
        dark = max(dark, 0.62 * object_shadow(world, vec3(0.0, 1.0, 0.0)));
#endif
        c *= 1.0 - dark * max(level, 0.25);
        if (frame.pedestal.w > 0.0) {  // ambient light kept off by the foot of the plinth
            float from_foot = max(length(world.xz - frame.pedestal.xz) - frame.pedestal.w, 0.0) + world.y;
            c *= 1.0 - 0.35 * exp(-from_foot / 0.09) * (1.0 - smoothstep(0.7 * kFootDarkens, kFootDarkens, from_foot));
        }
    }
    out_colour = vec4(kEncodes ? srgb_of_background(c) + dither_step() : finished(frame.background.rgb * c), 1.0);
}
