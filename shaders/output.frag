// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shaders/shared/output_rules.h"
// Shows the two layers of a picture in one of the stereo modes, by the rules of output_rules.h. Only fetching texels,
// and limiting each pipeline to what its mode needs, is done here. renderer/output/compose.cpp does the same on the
// CPU.

layout(set = 0, binding = 0) uniform texture2DArray eyes;  // an sRGB view: texels arrive linear
layout(set = 0, binding = 1) uniform texture2D overlay;    // premultiplied
layout(push_constant, std430) uniform Constants { OutputConstants c; };
layout(location = 0) out vec4 out_colour;
// Specialisation constants: a software driver executes both sides of every branch, so a pipeline must not even contain
// what its mode does not need.
layout(constant_id = 0) const int kMode = 0;
layout(constant_id = 1) const int kBuiltIn = 0;

bool is_built_in(int flag) { return (kBuiltIn & flag) != 0; }

vec3 over_picture(vec3 light, ivec2 p) {
    if (!is_built_in(kOutputOverlay)) return light;
    const ivec2 at = p - c.overlay.xy;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, c.overlay.zw))) return light;
    const ivec2 size = textureSize(overlay, 0);
    vec4 panel = texelFetch(overlay, ivec2(fitted(at.x, c.overlay.z, size.x), fitted(at.y, c.overlay.w, size.y)), 0);
    if (is_built_in(kOutputCodedOverlay)) panel.rgb = light_of_coded(panel.rgb, panel.a);
    return laid_over(panel.rgb, panel.a, light);
}

// Returns the light of the stored value without the error of the driver's approximate sRGB curve, which would show in
// dark tones once they are mixed.
vec3 as_stored(vec3 light) { return linear_of(round(255.0 * srgb_of(light)) / 255.0); }

vec3 eye_pixel(int eye, ivec2 p, bool mixed) {
    vec3 light = texelFetch(eyes, ivec3(p, eye), 0).rgb;
    if (mixed) light = as_stored(light);
    return over_picture(light, p);
}

// The pixels that a tap reads: one, or the four around a position; beyond the picture is black.
struct Footprint {
    ivec2 first;
    vec2 behind;
    int pixels;
};

Footprint footprint_of(OutputCell cell, ivec2 tap) {
    if (is_built_in(kOutputSamePixels) && !is_built_in(kOutputWarp))
        return Footprint(ivec2(cell.x, cell.y), vec2(0.0), 1);
    if (!is_built_in(kOutputWarp)) {
        return Footprint(ivec2(copied_pixel(cell.x, cell.width, cell.taps_x, tap.x, c.eye_size.x),
                               copied_pixel(cell.y, cell.height, cell.taps_y, tap.y, c.eye_size.y)),
                         vec2(0.0), 1);
    }
    const ivec2 taps = ivec2(cell.taps_x, cell.taps_y);
    const vec2 uv = (vec2(ivec2(cell.x, cell.y) * taps + tap) + 0.5) / vec2(ivec2(cell.width, cell.height) * taps);
    const vec2 q =
        warped_place(c.picture_from_output[0].xyz, c.picture_from_output[1].xyz, c.picture_from_output[2].xyz, uv);
    const vec2 place = vec2(between_pixels(q.x, c.eye_size.x), between_pixels(q.y, c.eye_size.y));
    return Footprint(ivec2(floor(place)), place - floor(place), 4);
}

// Uses loops, so that the compiler sees each fetch once: software drivers take seconds to compile unrolled code.
vec3 light_of(OutputCell cell, int eye) {
    const int taps = cell.taps_x * cell.taps_y;
    const bool mixed = taps > 1 || is_anaglyph_mode(kMode) ||
                       (kBuiltIn & (kOutputWarp | kOutputBlend | kOutputOverlay)) != 0;
    vec3 sum = vec3(0.0);
    for (int t = 0; t < taps; ++t) {
        const Footprint at = footprint_of(cell, cell.taps_x > 1 ? ivec2(t, 0) : ivec2(0, t));
        for (int k = 0; k < at.pixels; ++k) {
            const ivec2 corner = ivec2(k & 1, k >> 1), p = at.first + corner;
            if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, c.eye_size))) continue;
            const float weight = weight_between(at.behind.x, corner.x) * weight_between(at.behind.y, corner.y);
            sum += weight * eye_pixel(eye, p, mixed);
        }
    }
    return sum / float(taps);
}

vec3 shown_light(OutputCell cell) {
    const bool anaglyph = is_anaglyph_mode(kMode);
    vec3 light = vec3(0.0);
    for (int i = 0; i < (anaglyph ? 2 : 1); ++i) {
        const int eye = anaglyph ? (has_flag(c.flags, kOutputSwap) ? 1 - i : i) : cell.eye;
        const vec3 own = light_of(cell, eye);
        light += anaglyph ? anaglyph_light(kMode, i, own) : own;
    }
    return clamp(light, 0.0, 1.0);
}

void main() {
    const OutputCell cell = output_cell(kMode, c.flags, int(gl_FragCoord.x), int(gl_FragCoord.y), c.target_size.x,
                                        c.target_size.y);
    out_colour = vec4(0.0, 0.0, 0.0, 1.0);
    if (!cell.shown) return;
    vec3 light = shown_light(cell);
    if (is_built_in(kOutputBlend)) {
        // Applies the blend with the projector's own gamma, since it is the light of the projectors that has to add up.
        const vec2 uv = (vec2(cell.x, cell.y) + 0.5) / vec2(cell.width, cell.height);
        const float share =
            blended_share(uv, c.blend.x, c.blend.y, c.blend.z, c.blend.w, c.picture_from_output[1].w);
        const vec3 value = srgb_of(light) * pow(share, c.picture_from_output[0].w);
        out_colour.rgb = is_built_in(kOutputEncode) ? value : linear_of(value);
        return;
    }
    out_colour.rgb = is_built_in(kOutputEncode) ? srgb_of(light) : light;
}
