// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// Opaque surfaces on which objects cast shadows (renderer/frame/shadow_map.hpp).
#define BURIN_SHADOW_MAP
#include "shaders/solid_stage.glsl"
