// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The shadow map: an object as the lamp sees it, of which the depth alone is kept. The push constants' matrix leads
// from the mesh into the map.
#include "shaders/frame.glsl"

layout(location = 0) in vec3 in_position;

void main() { gl_Position = draw.world_from_local * vec4(in_position, 1.0); }
