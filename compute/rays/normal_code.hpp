// SPDX-License-Identifier: MIT
// Encoding of a direction given in doubles as a normal code, by the text that the device compiles too.
#pragma once

#include "base/space.hpp"
#include "shaders/shared/normal_code.h"

namespace burin::compute {

using shared::normal_code;

}  // namespace burin::compute
