// SPDX-License-Identifier: MIT
// Composes what a display shows in each stereo mode, pixel by pixel on the CPU: the reference
// for the GPU stage (output_stage.hpp), and good enough for a picture on disk. Modes that copy
// give the very pixels of the eyes' pictures; where light is mixed (half sizes, anaglyphs,
// warping, blending, overlays) it is mixed in linear light and in double precision.
// Pure; any thread. Cost: microseconds a pixel.
#pragma once

#include "base/image.hpp"
#include "wall/output_settings.hpp"

namespace burin::renderer {

// Return a mode's number and its flags as named in shaders/shared/output_constants.h: which eye comes first, on which
// side, and which is shown. Column 0 of the target belongs to the second eye where its column on the monitor is odd, or
// where the right eye comes first.
[[nodiscard]] int mode_number(wall::StereoMode mode);
[[nodiscard]] int mode_flags(const wall::OutputSettings& settings, const wall::OutputPlace& place);

struct Overlay {
    Image image;  // premultiplied by alpha
    wall::OverlayPlace place;
    wall::OverlayColour colour = wall::OverlayColour::linear;
};

// Composes one target. Both pictures have the same size, at least a pixel each way (BURIN_CHECK). If the target's size
// is not output_size(), pictures are fitted by leaving out or doubling whole pixels. The test pattern of the settings
// is not drawn here: it replaces the pictures (test_pattern.hpp).
[[nodiscard]] Image compose(const Image& left, const Image& right, const wall::OutputSettings& settings,
                            const wall::OutputPlace& place, const Overlay* overlay = nullptr);

// Composes a whole picture file: where the mode has two windows or layers, they stand side by side.
[[nodiscard]] Image compose_all(const Image& left, const Image& right, const wall::OutputSettings& settings);

// The parts of a target that change when both eyes' pictures change within a rectangle: at most two, without overlap,
// which hold every changed pixel and lie within the target. One part with the whole target where pixels are not copied
// one by one (warping, another size).
struct ChangedParts {
    PixelRect parts[2];
    int count = 0;
};
[[nodiscard]] ChangedParts changed_parts(const PixelRect& changed_in_eye, ImageSize eye,
                                         const wall::OutputSettings& settings, const wall::OutputPlace& place);

}  // namespace burin::renderer
