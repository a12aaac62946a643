// SPDX-License-Identifier: MIT
// The coding of light in pictures (IEC 61966-2-1), in 0..1. Pure functions; any thread.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/space.hpp"

namespace burin {

[[nodiscard]] inline double srgb_to_linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

[[nodiscard]] inline double linear_to_srgb(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

// Red, green and blue of a pixel's bytes.
[[nodiscard]] inline Vec3 light_of_bytes(const std::uint8_t* pixel) {
    return {srgb_to_linear(pixel[0] / 255.0), srgb_to_linear(pixel[1] / 255.0), srgb_to_linear(pixel[2] / 255.0)};
}

}  // namespace burin
