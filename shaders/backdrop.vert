// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The room.
#include "shaders/frame.glsl"
#include "shaders/vertex_stage.glsl"
