// SPDX-License-Identifier: MIT
#include "renderer/output/anaglyph.hpp"

#include "shaders/shared/output_rules.h"

namespace burin::renderer {

bool is_anaglyph(wall::StereoMode mode) {
    return mode == wall::StereoMode::anaglyph_red_cyan || mode == wall::StereoMode::anaglyph_green_magenta ||
           mode == wall::StereoMode::anaglyph_amber_blue;
}

AnaglyphMatrices anaglyph_matrices(wall::StereoMode mode) {
    BURIN_CHECK(is_anaglyph(mode));
    const auto matrix = [&](int picture) {
        const int row = shared::anaglyph_row(static_cast<int>(mode), picture);
        return glm::transpose(
            glm::dmat3(shared::kAnaglyphRows[row], shared::kAnaglyphRows[row + 1], shared::kAnaglyphRows[row + 2]));
    };
    return {matrix(0), matrix(1)};
}

}  // namespace burin::renderer
