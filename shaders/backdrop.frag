// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The room of a scene whose objects cast no shadow.
#include "shaders/backdrop_stage.glsl"
