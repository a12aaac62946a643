// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The workpiece where it is lit at every pixel, and the shapes of primitives.hpp.
#define BURIN_WITH_LIGHT
#include "shaders/frame.glsl"
#include "shaders/vertex_stage.glsl"
