// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The workspace box.
#define BURIN_WITH_LOCAL
#include "shaders/frame.glsl"
#include "shaders/vertex_stage.glsl"
