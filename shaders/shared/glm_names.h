// SPDX-License-Identifier: MIT
// GLSL's names for vectors and matrices, in C++: GLM's types, which lie in memory as std140 has them.
#ifndef BURIN_SHARED_GLM_NAMES_H
#define BURIN_SHARED_GLM_NAMES_H
#ifdef __cplusplus

#include <glm/glm.hpp>

#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

using ivec2 = glm::ivec2;
using ivec3 = glm::ivec3;
using ivec4 = glm::ivec4;
using mat4 = glm::mat4;
using uvec2 = glm::uvec2;
using uvec4 = glm::uvec4;
using vec4 = glm::vec4;

BURIN_SHARED_END

#endif
#endif
