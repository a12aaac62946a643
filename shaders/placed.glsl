// SPDX-License-Identifier: MIT
// The vertex transform of everything in the scene: projects a point of the world frame for this eye, with its parallax
// faded towards the screen's edges if kFades is set.
#include "shaders/shared/parallax_fade.h"

vec4 placed(vec4 world) {
    vec4 clip = frame.clip_from_world[gl_ViewIndex] * world;
    if (!kFades) return clip;
    float guard = frame.fade.w;  // a power of two, so the scaling is exact
    vec4 faded = parallax_faded(vec4(clip.xy * guard, clip.zw), frame.clip_from_world_middle * world, frame.fade.z,
                                frame.fade.x, frame.fade.y);
    return vec4(faded.xy / guard, faded.zw);
}
