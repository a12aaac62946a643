// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The vertex shader of the haptic workspace's boxes.
#define BURIN_WITH_LOCAL
#include "shaders/frame.glsl"
#include "shaders/vertex_stage.glsl"
