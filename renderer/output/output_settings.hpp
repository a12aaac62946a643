// SPDX-License-Identifier: MIT
// How a screen is to be shown, and where: what the CPU reference (compose.hpp) and the GPU stage (output_stage.hpp) take.
// Places on a picture are in uv: u from 0 at its left edge to 1 at its right one, v from 0 at the top to 1 at the bottom.
#pragma once

#include <optional>

#include "base/space.hpp"
#include "renderer/output/stereo_mode.hpp"

namespace burin {

// Brings a picture onto a screen that a projector meets at a slant. Homogeneous, column by column as in GLM.
using Homography = glm::dmat3;

// Where two projectors' pictures overlap, each fades towards its edge so that their light adds up to that of one.
struct EdgeFade {
    // Widths of the overlaps as fractions of the picture's width (left, right) and height (top, bottom), 0 to 1.
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
    double gamma = 2.2;  // the projector's own: its light is (value / 255)^gamma
    double curve = 2.0;  // how steep the fade is in its middle; 1: a straight line

    bool operator==(const EdgeFade&) const = default;
    [[nodiscard]] bool in_use() const { return left > 0.0 || right > 0.0 || top > 0.0 || bottom > 0.0; }
};

struct OutputSettings {
    StereoMode mode = StereoMode::mono;
    bool swap_eyes = false;  // for exchanged cables and glasses; no effect on mono
    TestPattern test_pattern = TestPattern::none;
    // Interlaced: the eye of the monitor's row (column, pixel) 0. Frame sequential: the eye of even refreshes.
    Eye first_eye = Eye::left;
    // picture_from_output: from a place of an eye's share of the output to the place of the eye's picture that is shown
    // there. Outside the picture is black. Without it pixels are copied, not filtered.
    std::optional<Homography> homography;
    EdgeFade blend;

    bool operator==(const OutputSettings&) const = default;
};

// Where a picture is put: a window's image, or one eye's.
struct OutputPlace {
    ImageSize size;       // pixels of the target
    Eye eye = Eye::left;  // of the modes that show one eye at a time: which
    int monitor_x = 0,
        monitor_y = 0;  // the target's upper left pixel on its monitor (interlaced modes); may be negative
};

// A panel over both eyes' pictures, at zero parallax: on the screen itself. In pixels of an eye's picture, before the mode
// arranges the eyes, so that it is right in every mode. May reach beyond the picture.
struct OverlayPlace {
    int x = 0, y = 0;
    int width = 0, height = 0;  // 0: no overlay; the overlay's image is fitted into it by whole pixels
};

// How an overlay's colours are to be taken. Both kinds are premultiplied by alpha; alpha itself is never coded.
enum class OverlayColour : std::uint8_t {
    linear,  // in linear light: drawn into an R8G8B8A8_SRGB image
    coded    // as sRGB values: drawn by a toolkit into an R8G8B8A8_UNORM image
};

}  // namespace burin
