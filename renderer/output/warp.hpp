// SPDX-License-Identifier: MIT
// Fitting pictures to screens: homographies and the weights of edge blending. Pure functions; any thread.
#pragma once

#include <array>

#include "renderer/output/output_settings.hpp"

namespace burin {

// The homography (picture_from_output) that shows the picture's upper left, upper right, lower right and lower left corner at
// these places of the output, in uv. Heckbert, "Fundamentals of Texture Mapping and Image Warping" (1989), 2.2.3: a quad from
// the unit square, inverted. An Error when three corners lie on a line or the corners go round the wrong way or cross over.
[[nodiscard]] Result<Homography> homography_onto(const std::array<Vec2, 4>& corners_uv);

// The inverse, given by rows: how wall files write the place on the output of a place of the picture. An Error when it has no
// inverse.
[[nodiscard]] Result<Homography> homography_from_rows(const std::array<std::array<double, 3>, 3>& output_from_picture);

// The place that a homography leads to. Places behind the picture's horizon are far outside it.
[[nodiscard]] Vec2 warped(const Homography& picture_from_output, const Vec2& output_uv);

// The share of the light that a picture gives at a place, 0 to 1. One edge alone: at a fraction t across the overlap,
//   w(t) = (2t)^c / 2 for t below a half, 1 - (2(1 - t))^c / 2 above,   so w(t) + w(1 - t) = 1
// (Bourke, "Edge blending using commodity projectors", 2004). Overlaps of two edges multiply.
[[nodiscard]] double light_share(const EdgeFade& blend, const Vec2& uv);

// An Error for widths, gamma and curve that make no sense: names the setting.
[[nodiscard]] Result<void> check_output(const OutputSettings& settings);

}  // namespace burin
