// SPDX-License-Identifier: MIT
// Test pictures that show whether a stereo display is set up right;
// shown instead of the scene, through the same output stage.
//
//   eye_order  closing one eye leaves the open eye's own word: LEFT, RIGHT. A frame stands before the screen when the
//              eyes are in order, and behind it when they are exchanged.
//   ghosting   for each eye a row of pairs: one half is a grey of known light in this eye alone, the other half is
//              white in the other eye alone. Close the other eye: the pair whose halves look alike gives the leakage
//              in percent.
//   geometry   squares of a known size in millimetres, circles, a line along the outermost pixels, a mark in each
//              corner. The same for both eyes: it lies in the plane of the screen.
// Pure; any thread. Cost: some milliseconds a megapixel.
#pragma once

#include "base/image.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::renderer {

struct PatternScreen {
    ImageSize pixels;                              // of one eye's picture
    double width_mm = 3048.0, height_mm = 2286.0;  // of the screen
};

// pattern is not none; pixels is at least 1 by 1 and the lengths are positive (BURIN_CHECK).
[[nodiscard]] StereoImage draw_test_pattern(wall::TestPattern pattern, const PatternScreen& screen);

// Returns the side of the geometry pattern's squares: the largest of 1, 2, 5, 10, 20, 50 ... mm that fits at least six
// times into the shorter side of the screen.
[[nodiscard]] double grid_spacing_mm(const PatternScreen& screen);

// Returns the light of the ghosting pattern's greys, as shares of white.
[[nodiscard]] std::span<const double> ghosting_steps();

}  // namespace burin::renderer
