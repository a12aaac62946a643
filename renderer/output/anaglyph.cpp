// SPDX-License-Identifier: MIT
#include "renderer/output/anaglyph.hpp"

namespace burin {

namespace {

// By rows, as published: red, green and blue of the result.
glm::dmat3 rows(const Vec3& red, const Vec3& green, const Vec3& blue) {
    return glm::transpose(glm::dmat3(red, green, blue));
}

}  // namespace

bool is_anaglyph(StereoMode mode) {
    return mode == StereoMode::anaglyph_red_cyan || mode == StereoMode::anaglyph_green_magenta ||
           mode == StereoMode::anaglyph_amber_blue;
}

AnaglyphMatrices anaglyph_matrices(StereoMode mode) {
    BURIN_CHECK(is_anaglyph(mode));
    if (mode == StereoMode::anaglyph_green_magenta) {
        return {rows({-0.062, -0.158, -0.039}, {0.284, 0.668, 0.143}, {-0.015, -0.027, 0.021}),
                rows({0.529, 0.705, 0.024}, {-0.016, -0.015, -0.065}, {0.009, 0.075, 0.937})};
    }
    if (mode == StereoMode::anaglyph_amber_blue) {
        return {rows({1.062, -0.205, 0.299}, {-0.026, 0.908, 0.068}, {-0.038, -0.173, 0.022}),
                rows({-0.016, -0.123, -0.017}, {0.006, 0.062, -0.017}, {0.094, 0.185, 0.911})};
    }
    return {rows({0.437, 0.449, 0.164}, {-0.062, -0.062, -0.024}, {-0.048, -0.050, -0.017}),
            rows({-0.011, -0.032, -0.007}, {0.377, 0.761, 0.009}, {-0.026, -0.093, 1.234})};
}

}  // namespace burin
