// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shaders/shared/output_constants.h"
// Shows the two layers of a picture in one of the stereo modes. All mixing is done in linear light. The same arithmetic in
// plain C++, written apart from this: renderer/output/compose.cpp.

layout(set = 0, binding = 0) uniform texture2DArray eyes;  // an sRGB view: texels arrive linear
layout(set = 0, binding = 1) uniform texture2D overlay;    // premultiplied
layout(push_constant, std430) uniform Constants { OutputConstants c; };
layout(location = 0) out vec4 out_colour;
// Fixed when the pipeline is made: a software driver works through both sides of every branch, so what a mode does not need
// must not be there at all.
layout(constant_id = 0) const int kMode = 0;
layout(constant_id = 1) const int kBuiltIn = 0;

// Dubois' least-squares anaglyphs; sources in renderer/output/anaglyph.hpp. Columns are what each source channel gives. Red-cyan,
// green-magenta, amber-blue; of each the left picture's, then the right one's.
const mat3 kAnaglyphs[6] =
    mat3[6](mat3(0.437, -0.062, -0.048, 0.449, -0.062, -0.050, 0.164, -0.024, -0.017),
            mat3(-0.011, 0.377, -0.026, -0.032, 0.761, -0.093, -0.007, 0.009, 1.234),
            mat3(-0.062, 0.284, -0.015, -0.158, 0.668, -0.027, -0.039, 0.143, 0.021),
            mat3(0.529, -0.016, 0.009, 0.705, -0.015, 0.075, 0.024, -0.065, 0.937),
            mat3(1.062, -0.026, -0.038, -0.205, 0.908, -0.173, 0.299, 0.068, 0.022),
            mat3(-0.016, 0.006, 0.094, -0.123, 0.062, 0.185, -0.017, -0.017, 0.911));

// An eye's share of the target, and this pixel's place in it.
struct Cell {
    ivec2 at;
    ivec2 size;
    ivec2 taps;  // how many of the eye's pixels become one, each way
    int eye;
    bool shown;
};

bool has(int flag) { return (c.flags & flag) != 0; }
bool is_built_in(int flag) { return (kBuiltIn & flag) != 0; }

// IEC 61966-2-1.
vec3 encoded(vec3 light) {
    const vec3 bright = 1.055 * pow(max(light, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(bright, 12.92 * light, lessThanEqual(light, vec3(0.0031308)));
}

vec3 decoded(vec3 value) {
    const vec3 bright = pow(max(value + 0.055, vec3(0.0)) / 1.055, vec3(2.4));
    return mix(bright, value / 12.92, lessThanEqual(value, vec3(0.04045)));
}

Cell cell_of(ivec2 p) {
    Cell cell = Cell(p, c.target_size, ivec2(1), 0, true);
    switch (kMode) {
        case kModeSideBySide:
        case kModeSideBySideHalf:
            cell.size.x = max(1, c.target_size.x / 2);
            cell.eye = p.x / cell.size.x;
            cell.at.x = p.x - cell.eye * cell.size.x;
            cell.shown = cell.eye < 2;
            if (kMode == kModeSideBySideHalf) cell.taps.x = 2;
            break;
        case kModeTopBottom:
        case kModeTopBottomHalf:
            cell.size.y = max(1, c.target_size.y / 2);
            cell.eye = p.y / cell.size.y;
            cell.at.y = p.y - cell.eye * cell.size.y;
            cell.shown = cell.eye < 2;
            if (kMode == kModeTopBottomHalf) cell.taps.y = 2;
            break;
        case kModeRows: cell.eye = (p.y + (has(kOutputPhaseY) ? 1 : 0)) & 1; break;
        case kModeColumns: cell.eye = (p.x + (has(kOutputPhaseX) ? 1 : 0)) & 1; break;
        case kModeCheckerboard:
            cell.eye = (p.x + p.y + (has(kOutputPhaseX) ? 1 : 0) + (has(kOutputPhaseY) ? 1 : 0)) & 1;
            break;
        case kModeOneEye: cell.eye = has(kOutputRightEye) ? 1 : 0; break;
    }
    if (has(kOutputSwap)) cell.eye = 1 - cell.eye;
    return cell;
}

// Pixel p of n, fitted to m: the one in whose middle third it falls, by whole numbers; p itself when n is m.
ivec2 fitted(ivec2 p, ivec2 n, ivec2 m) { return ((2 * p + 1) * m) / (2 * n); }

vec3 over_picture(vec3 light, ivec2 p) {
    if (!is_built_in(kOutputOverlay)) return light;
    const ivec2 at = p - c.overlay.xy;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, c.overlay.zw))) return light;
    vec4 panel = texelFetch(overlay, fitted(at, c.overlay.zw, textureSize(overlay, 0)), 0);
    if (is_built_in(kOutputCodedOverlay) && panel.a > 0.0) panel.rgb = decoded(min(panel.rgb / panel.a, 1.0)) * panel.a;
    return panel.rgb + (1.0 - panel.a) * light;
}

// The light of a stored value without the driver's approximation of the sRGB curve, which shows in the dark when it is mixed.
vec3 as_stored(vec3 light) { return decoded(round(255.0 * encoded(light)) / 255.0); }

vec3 eye_pixel(int eye, ivec2 p, bool mixed) {
    vec3 light = texelFetch(eyes, ivec3(p, eye), 0).rgb;
    if (mixed) light = as_stored(light);
    return over_picture(light, p);
}

// Where a tap reads: one pixel, or between four of them, beyond the picture black.
struct Footprint {
    ivec2 first;
    vec2 f;
    int pixels;
};

Footprint footprint_of(Cell cell, ivec2 tap) {
    if (!is_built_in(kOutputWarp)) {
        const ivec2 groups = max(ivec2(1), c.eye_size / cell.taps);
        const ivec2 p = fitted(cell.at, cell.size, groups) * cell.taps + tap;
        return Footprint(min(p, c.eye_size - 1), vec2(0.0), 1);
    }
    const vec2 uv = (vec2(cell.at * cell.taps + tap) + 0.5) / vec2(cell.size * cell.taps);
    const vec3 q = mat3(c.picture_from_output[0].xyz, c.picture_from_output[1].xyz, c.picture_from_output[2].xyz) *
                   vec3(uv, 1.0);
    if (q.z < 1e-9) return Footprint(ivec2(-2), vec2(0.0), 0);
    const vec2 place = clamp(q.xy / q.z * vec2(c.eye_size) - 0.5, vec2(-2.0), vec2(c.eye_size) + 1.0);
    return Footprint(ivec2(floor(place)), place - floor(place), 4);
}

// Loops, so that the compiler sees each fetch once: software drivers compile what is written out for seconds.
vec3 light_of(Cell cell, int eye) {
    const int taps = cell.taps.x * cell.taps.y;
    const bool mixed = taps > 1 || kMode >= kModeRedCyan && kMode <= kModeAmberBlue ||
                       (kBuiltIn & (kOutputWarp | kOutputBlend | kOutputOverlay)) != 0;
    vec3 sum = vec3(0.0);
    for (int t = 0; t < taps; ++t) {
        const Footprint at = footprint_of(cell, cell.taps.x > 1 ? ivec2(t, 0) : ivec2(0, t));
        for (int k = 0; k < at.pixels; ++k) {
            const ivec2 corner = ivec2(k & 1, k >> 1), p = at.first + corner;
            if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, c.eye_size))) continue;
            const vec2 weight = mix(1.0 - at.f, at.f, vec2(corner));
            sum += weight.x * weight.y * eye_pixel(eye, p, mixed);
        }
    }
    return sum / float(taps);
}

vec3 shown_light(Cell cell) {
    const bool anaglyph = kMode >= kModeRedCyan && kMode <= kModeAmberBlue;
    vec3 light = vec3(0.0);
    for (int i = 0; i < (anaglyph ? 2 : 1); ++i) {
        const int eye = anaglyph ? (has(kOutputSwap) ? 1 - i : i) : cell.eye;
        const vec3 own = light_of(cell, eye);
        light += anaglyph ? kAnaglyphs[2 * (kMode - kModeRedCyan) + i] * own : own;
    }
    return clamp(light, 0.0, 1.0);
}

float one_edge(float distance, float width) {
    if (width <= 0.0 || distance >= width) return 1.0;
    const float t = max(0.0, distance / width), curve = c.picture_from_output[1].w;
    return t < 0.5 ? 0.5 * pow(2.0 * t, curve) : 1.0 - 0.5 * pow(2.0 * (1.0 - t), curve);
}

float light_share(vec2 uv) {
    return one_edge(uv.x, c.blend.x) * one_edge(1.0 - uv.x, c.blend.y) * one_edge(uv.y, c.blend.z) *
           one_edge(1.0 - uv.y, c.blend.w);
}

void main() {
    const Cell cell = cell_of(ivec2(gl_FragCoord.xy));
    out_colour = vec4(0.0, 0.0, 0.0, 1.0);
    if (!cell.shown) return;
    vec3 light = shown_light(cell);
    if (is_built_in(kOutputBlend)) {
        // By the projector's own gamma, as it is the projectors' light that has to add up.
        const float share = light_share((vec2(cell.at) + 0.5) / vec2(cell.size));
        const vec3 value = encoded(light) * pow(share, c.picture_from_output[0].w);
        out_colour.rgb = is_built_in(kOutputEncode) ? value : decoded(value);
        return;
    }
    out_colour.rgb = is_built_in(kOutputEncode) ? encoded(light) : light;
}
