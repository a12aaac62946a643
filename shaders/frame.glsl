// SPDX-License-Identifier: MIT
// The resources that all graphics shaders share.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#define BURIN_NO_INT64
#include "shaders/shared/frame_uniforms.h"
#include "shaders/shared/octahedral.h"

layout(std140, set = 0, binding = 0) uniform Frame { FrameUniforms frame; };
#ifdef BURIN_SHADOW_MAP
layout(set = 0, binding = 1) uniform sampler2DShadow shadow_map;
layout(set = 0, binding = 2) uniform sampler2D shadow_depths;  // the same without comparison
#endif
layout(push_constant) uniform Draw { DrawConstants draw; };

// Whether the shader writes sRGB values (true), or the device encodes its linear output (false).
layout(constant_id = 0) const bool kEncodes = false;
// Whether parallax fades towards the screen's edges; if not, the fade is not even compiled.
layout(constant_id = 1) const bool kFades = false;
// Whether there are capsules that keep light off; if not, they are not even compiled.
layout(constant_id = 4) const bool kCapsules = false;
// How many look-ups in the shadow map find how far off what is between a point and the lamp is (0: nobody asks), and
// how many look through its edge.
layout(constant_id = 5) const int kFinders = 8;
layout(constant_id = 6) const int kTaps = 16;
