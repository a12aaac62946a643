// SPDX-License-Identifier: MIT
// Measures how different two pictures look when shown alternately at one place: LDR-FLIP (Andersson, Nilsson,
// Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM
// Comput. Graph. Interact. Tech. 3(2)).
//
// The value of a pixel is 0 (looks the same) to 1. It combines a difference of
// colour, after filtering out what the eye cannot resolve at that distance, with a
// difference of edges and points. Symmetric in its two pictures except for rounding.
// Pictures are sRGB, 8 bits (base/image.hpp). 67 pixels per degree is the paper's default: a 3840-pixel screen 0.7 m
// wide seen from 0.7 m. The paper's authors recommend the mean of the map if a single number is wanted.
// Thread: any; allocates. Cost: about 0.3 s of processor time for 1280 x 720.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"
#include "base/space.hpp"

namespace burin::bench {

struct FlipMap {
    ImageSize size;
    std::vector<float> error;  // one value a pixel, 0 to 1, rows from the top
    double mean = 0.0;
    double largest = 0.0;
};

inline constexpr double kFlipPixelsPerDegree = 67.0;

// Returns an Error when the pictures are empty or differ in size, or the resolution is not between 1 and 1000.
[[nodiscard]] Result<FlipMap> flip(const Image& reference, const Image& test,
                                   double pixels_per_degree = kFlipPixelsPerDegree);

// Convert between the colour spaces that FLIP uses, for values 0 to 1 under D65.
[[nodiscard]] double linear_of_srgb8(std::uint8_t value);
[[nodiscard]] Vec3 xyz_of_linear(const Vec3& rgb);
[[nodiscard]] Vec3 lab_of_linear(const Vec3& rgb);  // CIELab: L 0 to 100

}  // namespace burin::bench
