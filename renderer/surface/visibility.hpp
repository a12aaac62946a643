// SPDX-License-Identifier: MIT
// Visibility tests for parts of a surface: outside an eye's frustum,
// facing away from it altogether, or behind solid material.
//
// Each test is conservative: what it reports as hidden is hidden from the eye, whatever the frustum's shape; what it
// does not report may still be hidden. Nothing is projected: off-axis frusta, however extreme, are planes through the
// eye and the screen's edges.
// Frame: that of the patches (the object frame relative to the lattice's origin), metres. Pure functions; any thread.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/image.hpp"
#include "base/space.hpp"
#include "picture/picture.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {

// Bounds of a patch for the visibility tests, computed once from its triangles.
struct PatchShape {
    Box bounds;
    Vec3 center{0.0};
    double radius_m = 0.0;  // of a ball around the centre that holds the bounds
    // All triangle normals lie within an angle of the axis; its sine, or 2 if that angle is not below 90 degrees.
    Vec3 cone_axis{0.0, 0.0, 1.0};
    double cone_sine = 2.0;
    double edge_m = 0.0;  // root mean square of the lengths of its triangles' edges
};
[[nodiscard]] PatchShape shape_of(std::span<const shared::SurfaceVertex> vertices,
                                  std::span<const std::uint32_t> indices);

// One eye and the pyramid that it sees through a part of the screen.
struct EyeFrustum {
    Vec3 eye{0.0};
    // Left, right, lower, upper: unit normals pointing inside, and the distance of the origin from the plane.
    std::array<glm::dvec4, 4> planes{};
};
// The fade of parallax (shaders/shared/parallax_fade.h), which bends the picture:
// what is in front of the screen and near its edges is drawn between its position
// as seen by the eye and its position as seen from midway between the eyes.
struct FadedEdges {
    EyeFrustum middle;
    std::array<Mat4, 3> clip_from_patch;  // of the left eye, the right eye and the middle; -1 to 1 over the screen
    // Of these the rows of x, y and w.
    std::array<std::array<glm::dvec4, 3>, 3> rows;
    double middle_to_screen_m = 0.0, band = 0.0;
};
struct EyePair {
    std::array<EyeFrustum, 2> eyes;                 // left, right
    std::optional<FadedEdges> fade = std::nullopt;  // present if parallax fades
};
// Returns the frusta through the pixels of `part`, with a margin of kPad_px on each side for what touches them.
[[nodiscard]] EyePair eye_frusta(const picture::Picture& picture, ImageSize size, const PixelRect& part);

// Returns whether the fade may move something in the box; false without a fade.
[[nodiscard]] bool bent(const EyePair& eyes, const Box& box);

[[nodiscard]] bool beside(const EyeFrustum& eye, const Box& box);
// Returns whether the box lies beyond the same edge for both, and so does all that is drawn between the two.
[[nodiscard]] bool beside(const EyeFrustum& eye, const EyeFrustum& middle, const Box& box);
// Returns whether every triangle faces away from the eye, by the distance of the eye
// from a ball's cone of normals (as meshoptimizer's cluster cones: f(p) = (p - eye).axis
// - sine |p - eye| changes by at most its argument's step where it is positive).
[[nodiscard]] bool turned_away(const EyeFrustum& eye, const PatchShape& patch);
// Returns whether the box lies wholly in the shadow that the occluder, a box of solid material, casts from the eye. The
// shadow of a convex body is convex, so testing the box's eight corners suffices.
[[nodiscard]] bool behind(const Vec3& eye, const Box& box, const Box& occluder);

enum class Hidden : std::uint8_t { no, beside, turned_away, behind };
// Returns why neither eye can see the patch; the reason of the last eye tested. A patch that is bent() is drawn where
// no single eye sees it: only `beside` can hide it. Occluders count as long as no patch of the workpiece is bent: bent
// patches may uncover what lies behind them.
[[nodiscard]] Hidden hidden(const EyePair& eyes, const PatchShape& patch, std::span<const Box> occluders);
// The same for a caller that has asked already whether the patch is bent().
[[nodiscard]] Hidden hidden(const EyePair& eyes, const PatchShape& patch, std::span<const Box> occluders, bool is_bent);

}  // namespace burin::renderer
