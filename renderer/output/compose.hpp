// SPDX-License-Identifier: MIT
// What a display shows in each stereo mode, pixel by pixel on the CPU: the plain reference for the GPU stage
// (output_stage.hpp), and good enough for a picture on disk. Modes that copy give the very pixels of the eyes' pictures; where
// light is mixed (half sizes, anaglyphs, warping, blending, overlays) it is mixed in linear light and in double precision.
// Pure; any thread. Cost: microseconds a pixel.
#pragma once

#include "renderer/image.hpp"
#include "renderer/output/output_settings.hpp"

namespace burin {

struct Overlay {
    Image image;  // premultiplied, with its alpha
    OverlayPlace place;
    OverlayColour colour = OverlayColour::linear;
};

// Both pictures are of one size, at least a pixel each way (BURIN_CHECK). A place of another size than output_size() gets them
// fitted by leaving out or doubling whole pixels. The test pattern of the settings is not drawn here: it takes the place of
// the pictures (test_pattern.hpp).
[[nodiscard]] Image compose(const Image& left, const Image& right, const OutputSettings& settings,
                            const OutputPlace& place, const Overlay* overlay = nullptr);

// The same, for a whole picture file: two windows or layers side by side.
[[nodiscard]] Image compose_all(const Image& left, const Image& right, const OutputSettings& settings);

// The parts of a target that change when an eye's picture changes within a rectangle (in both eyes): at most two, without
// overlap; one with everything where pixels are not copied one by one (warping, another size). They hold every pixel that
// changes, and nothing that is not there.
struct ChangedParts {
    PixelRect parts[2];
    int count = 0;
};
[[nodiscard]] ChangedParts changed_parts(const PixelRect& changed_in_eye, ImageSize eye, const OutputSettings& settings,
                                         const OutputPlace& place);

}  // namespace burin
