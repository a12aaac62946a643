// SPDX-License-Identifier: MIT
// Fades parallax towards a screen's edges. What stands in front of a screen and is cut by its edge is cut at different
// places for the two eyes: the edge, which is behind, seems to occlude it (a window violation). Per vertex, parallax is
// faded to zero there, as Dynparity does on a head-tracked wall (Schroeder-Dering, Zachmann, Weller 2022, doi
// 10.1002/cav.2099).
//
// With e the vertex on the screen as this eye sees it, m as the point midway between the eyes sees it (both -1 to 1
// over the screen), d = e - m (half the parallax):
//   drawn at   m + (1 - s) d
//   s = strength n [1 - (1 - s_x)(1 - s_y)] in front of the screen, 0 at it and behind it,
//   s_x = S((b_x - (1 - |m_x|)) / b_x), S(t) = t t (3 - 2 t) for t in 0..1, else 0 or 1; b_x = max(band, 9/8 |d_x|),
//   n rises from 0 to 1 while the vertex's distance along the screen's normal, from the eye or from the midpoint,
//   whichever is less, goes from 1/20 to 1/10 of the screen's: nobody fuses what is nearer, and at the eye it has no
//   position on the screen.
// Consequences (tests/wall/parallax_fade_unit.cpp):
// - Farther than b from an edge, and at or behind the screen, the result is the input, bit for bit.
// - It is continuous: at the screen's plane d is 0, so s may jump there.
// - At the edge of the midpoint's view, strength 1, n 1: no parallax.
// - Strength 1, n 1: a vertex that the midpoint sees within the screen is drawn within it for both eyes, and one that
//   it does not see is outside for both: no part is seen by one eye alone. For with u = (1 - |m|) / b,
//   1 - s <= u u (3 - 2 u) and u (3 - 2 u) <= 9/8, so (1 - s) |d| <= 9/8 u |d| <= u b = 1 - |m|.
// Depth is unchanged, so each eye hides surfaces as before. A vertex outside an eye's frustum may be drawn inside it:
// what is culled must lie outside the midpoint's frustum too.
#ifndef BURIN_SHARED_PARALLAX_FADE_H
#define BURIN_SHARED_PARALLAX_FADE_H
#include "shaders/shared/portable.h"

#include "shaders/shared/glm_names.h"

BURIN_SHARED_BEGIN

BURIN_FN float fade_size(float a) { return a < 0.0f ? -a : a; }

// Evaluates S(t).
BURIN_FN float fade_step(float t) {
    float c = t < 0.0f ? 0.0f : (t > 1.0f ? 1.0f : t);
    return c * c * (3.0f - 2.0f * c);
}

// Evaluates s_x or s_y: m is the position that the midpoint between the eyes sees, d half the parallax.
BURIN_FN float fade_near_edge(float m, float d, float band) {
    float least = 1.125f * fade_size(d);
    float b = band > least ? band : least;
    return b > 0.0f ? fade_step((b - (1.0f - fade_size(m))) / b) : (fade_size(m) >= 1.0f ? 1.0f : 0.0f);
}

// Evaluates n.
BURIN_FN float fade_far_enough(float nearest_m, float screen_m) {
    float n = 20.0f * nearest_m / screen_m - 1.0f;
    return n < 0.0f ? 0.0f : (n > 1.0f ? 1.0f : n);
}

// Returns the value of gl_Position for the vertex stage.
//   clip_eye            off_axis_projection() of the screen and this eye, applied to the vertex
//   clip_middle         the same for the point midway between the eyes; any near and far plane, only x, y, w are read
//   middle_to_screen_m  distance of that point from the screen's plane
//   strength            0 (returns the input) to 1
//   band                how far from the edge the fade begins, 1 = half the screen; 0.2 is a good value
// w of either clip position is the vertex's distance from the eye along the screen's normal, as off_axis_projection()
// makes it.
BURIN_FN vec4 parallax_faded(vec4 clip_eye, vec4 clip_middle, float middle_to_screen_m, float strength, float band) {
    float nearest_m = clip_eye.w < clip_middle.w ? clip_eye.w : clip_middle.w;
    float n = fade_far_enough(nearest_m, middle_to_screen_m);
    if (strength <= 0.0f || n <= 0.0f || clip_middle.w >= middle_to_screen_m) return clip_eye;
    float m_x = clip_middle.x / clip_middle.w;
    float m_y = clip_middle.y / clip_middle.w;
    float keep_x = 1.0f - fade_near_edge(m_x, clip_eye.x / clip_eye.w - m_x, band);
    float keep_y = 1.0f - fade_near_edge(m_y, clip_eye.y / clip_eye.w - m_y, band);
    float s = strength * n * (1.0f - keep_x * keep_y);
    if (s <= 0.0f) return clip_eye;
    return vec4(clip_eye.x + s * (m_x * clip_eye.w - clip_eye.x), clip_eye.y + s * (m_y * clip_eye.w - clip_eye.y),
                clip_eye.z, clip_eye.w);
}

BURIN_SHARED_END
#endif
