// SPDX-License-Identifier: MIT
// The sRGB transfer functions (IEC 61966-2-1), components in
// 0..1, by shaders/shared/srgb.h. Pure functions; any thread.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "shaders/shared/srgb.h"

namespace burin::renderer {

[[nodiscard]] inline double srgb_to_linear(double value) { return shared::linear_of_component(value); }

[[nodiscard]] inline double linear_to_srgb(double light) { return shared::srgb_of_component(light); }

// Returns the linear light of a pixel's three sRGB bytes: red, green, blue.
[[nodiscard]] inline Vec3 light_of_bytes(const std::uint8_t* pixel) {
    return {srgb_to_linear(pixel[0] / 255.0), srgb_to_linear(pixel[1] / 255.0), srgb_to_linear(pixel[2] / 255.0)};
}

}  // namespace burin::renderer
