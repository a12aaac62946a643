// SPDX-License-Identifier: MIT
// The resources of every graphics shader.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#define BURIN_NO_INT64
#include "shaders/shared/frame_uniforms.h"
#include "shaders/shared/octahedral.h"

layout(std140, set = 0, binding = 0) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 1) uniform sampler2DShadow shadow_compare;
layout(set = 0, binding = 2) uniform sampler2D shadow_depth;
layout(push_constant) uniform Draw { DrawConstants draw; };
