// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// The room where objects cast shadows on its floor (renderer/frame/shadow_map.hpp).
#define BURIN_SHADOW_MAP
#include "shaders/backdrop_stage.glsl"
