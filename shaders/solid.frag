// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// Opaque surfaces in a scene whose objects cast no shadow.
#include "shaders/solid_stage.glsl"
