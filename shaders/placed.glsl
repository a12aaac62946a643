// SPDX-License-Identifier: MIT
// For the vertex stage of what stands in the room: where a point of the world is in this eye's picture, its parallax faded towards the
// screen's edges if that is asked for.
#include "shaders/shared/parallax_fade.h"

vec4 placed(vec4 world) {
    vec4 clip = frame.clip_from_world[gl_ViewIndex] * world;
    if (!kFades) return clip;
    float guard = frame.fade.w;  // a power of two: no bit is lost
    vec4 faded = parallax_faded(vec4(clip.xy * guard, clip.zw), frame.clip_from_world_middle * world, frame.fade.z,
                                frame.fade.x, frame.fade.y);
    return vec4(faded.xy / guard, faded.zw);
}
