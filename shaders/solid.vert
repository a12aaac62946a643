// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The vertex shader of the workpiece where it is lit at every pixel, and of the shapes of primitives.hpp.
#define BURIN_WITH_LIGHT
#include "shaders/frame.glsl"
#include "shaders/vertex_stage.glsl"
