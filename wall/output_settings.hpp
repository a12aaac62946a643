// SPDX-License-Identifier: MIT
// Output settings of a screen, shared by the CPU reference (renderer/output/compose.hpp) and the GPU stage
// (renderer/output/output_stage.hpp), and the warping and blending of projector pictures that they set: homographies
// and the weights of edge blending. Plain data and pure functions; any thread.
// Positions on a picture are in uv: u from 0 at its left edge to 1 at its right one, v from 0 at the top to 1 at the
// bottom.
#pragma once

#include <array>
#include <optional>

#include "base/error.hpp"
#include "base/space.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::wall {

// A projective map that corrects for a projector at a slant. Homogeneous, column by column as in GLM.
using Homography = glm::dmat3;

// Where two projectors' pictures overlap, each fades towards its edge so that their light adds up to that of one.
struct EdgeFade {
    // Widths of the overlaps as fractions of the picture's width (left, right) and height (top, bottom), 0 to 1.
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
    double gamma = 2.2;  // the projector's own: its light is (value / 255)^gamma; is_projector_gamma()
    double curve = 2.0;  // steepness of the fade in its middle; 1: a straight line

    bool operator==(const EdgeFade&) const = default;
    [[nodiscard]] bool in_use() const { return left > 0.0 || right > 0.0 || top > 0.0 || bottom > 0.0; }
};

// The gammas that projectors have, which wall files and output settings accept alike. Below 1 a fade would begin with
// a step of light.
inline constexpr double kLeastGamma = 1.0, kMostGamma = 4.0;
[[nodiscard]] constexpr bool is_projector_gamma(double gamma) { return gamma >= kLeastGamma && gamma <= kMostGamma; }

struct OutputSettings {
    StereoMode mode = StereoMode::mono;
    bool swap_eyes = false;  // for exchanged cables and glasses; no effect on mono
    TestPattern test_pattern = TestPattern::none;
    // Interlaced: the eye of the monitor's row (column, pixel) 0. Frame sequential: the eye of even refreshes.
    Eye first_eye = Eye::left;
    // picture_from_output: maps a position in an eye's share of the output to the position in the eye's picture that is
    // shown there. Outside the picture the output is black. Without a homography pixels are copied, not filtered.
    std::optional<Homography> homography;
    EdgeFade blend;

    bool operator==(const OutputSettings&) const = default;
};

// Where a picture is output: a window's image, or one eye's.
struct OutputPlace {
    ImageSize size;       // pixels of the target
    Eye eye = Eye::left;  // for modes that show one eye at a time: which one
    int monitor_x = 0,
        monitor_y = 0;  // the target's upper left pixel on its monitor (interlaced modes); may be negative
};

// Placement of a panel over both eyes' pictures, at zero parallax (on the screen itself), in pixels of an eye's picture
// before the mode arranges the eyes, so that it is right in every mode. May reach beyond the picture.
struct OverlayPlace {
    int x = 0, y = 0;
    // 0: no overlay; the overlay's image is scaled to it by whole pixels.
    int width = 0, height = 0;
};

// Encoding of an overlay's colours. Both kinds are premultiplied by alpha; alpha itself is always linear.
enum class OverlayColour : std::uint8_t {
    linear,  // in linear light: drawn into an R8G8B8A8_SRGB image
    coded    // as sRGB values: drawn by a toolkit into an R8G8B8A8_UNORM image
};

// The homography (picture_from_output) that shows the picture's upper left, upper right, lower right and lower left
// corner at these positions of the output, in uv. Heckbert, "Fundamentals of Texture Mapping and Image Warping" (1989),
// 2.2.3: a quad from the unit square, inverted. An Error when three corners lie on a line, or the corners go round the
// wrong way or cross over.
[[nodiscard]] Result<Homography> homography_onto(const std::array<Vec2, 4>& corners_uv);

// Inverts a matrix given by rows, which maps the picture to the output as in wall files. An Error when it has no
// inverse.
[[nodiscard]] Result<Homography> homography_from_rows(const std::array<std::array<double, 3>, 3>& output_from_picture);

// Applies a homography. Points behind the picture's horizon map far outside it.
[[nodiscard]] Vec2 warped(const Homography& picture_from_output, const Vec2& output_uv);

// The share of light that a picture contributes at a position, 0 to 1. One edge alone: at a fraction t across the
// overlap,
//   w(t) = (2t)^c / 2 for t below a half, 1 - (2(1 - t))^c / 2 above,   so w(t) + w(1 - t) = 1
// (Bourke, "Edge blending using commodity projectors", 2004). Overlaps of two edges multiply.
[[nodiscard]] double light_share(const EdgeFade& blend, const Vec2& uv);

// Checks widths, gamma and curve of an edge fade and the homography; the Error names the setting.
[[nodiscard]] Result<void> check_output(const OutputSettings& settings);

}  // namespace burin::wall
