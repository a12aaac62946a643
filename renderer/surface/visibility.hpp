// SPDX-License-Identifier: MIT
// Which parts of a surface an eye cannot see: beside its frustum, turned away from it altogether, or behind solid material.
//
// Each test is exact in one direction: what it calls hidden is hidden, from where the eye is, whatever the frustum's shape; what is left may
// still be hidden. Nothing here is projected: off-axis frusta, however extreme, are planes through the eye and the screen's edges.
// Frame: that of the patches (the object frame relative to the lattice's origin), metres. Pure functions; any thread.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/space.hpp"
#include "renderer/image.hpp"
#include "renderer/scene.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

// What is asked of a patch when it is looked for, worked out once from its triangles.
struct PatchShape {
    Box bounds;
    Vec3 center{0.0};
    double radius_m = 0.0;  // of a ball around the centre that holds the bounds
    // All its triangles' normals lie within an angle of the axis; its sine, or 2 where there is no such angle below a right one.
    Vec3 cone_axis{0.0, 0.0, 1.0};
    double cone_sine = 2.0;
    double edge_m = 0.0;  // root mean square of its triangles' edges
};
[[nodiscard]] PatchShape shape_of(std::span<const shared::SurfaceVertex> vertices,
                                  std::span<const std::uint32_t> indices);

// One eye and the pyramid of what it sees through a part of the screen.
struct EyeFrustum {
    Vec3 eye{0.0};
    // Left, right, lower, upper: unit normals pointing inside, and the distance of the origin from the plane.
    std::array<glm::dvec4, 4> planes{};
};
// Where the fade of parallax (shaders/shared/parallax_fade.h) bends the picture: what is in front of the screen and near its edges is
// drawn between where the eye sees it and where the point midway between the eyes does.
struct FadedEdges {
    EyeFrustum middle;
    std::array<Mat4, 3> clip_from_patch;  // of the left and the right eye and of the middle; -1 to 1 over the screen
    double middle_to_screen_m = 0.0, band = 0.0;
};
struct EyePair {
    std::array<EyeFrustum, 2> eyes;                 // left, right
    std::optional<FadedEdges> fade = std::nullopt;  // when there is one
};
// Through the pixels of `part`, and kPad_px more on each side for what touches them.
[[nodiscard]] EyePair eye_frusta(const Scene& scene, ImageSize size, const PixelRect& part);

// Whether the fade may move some of what is in the box; never, without a fade.
[[nodiscard]] bool bent(const EyePair& eyes, const Box& box);

[[nodiscard]] bool beside(const EyeFrustum& eye, const Box& box);
// Beyond the same edge for both: then so is all that is drawn between where the two see it.
[[nodiscard]] bool beside(const EyeFrustum& eye, const EyeFrustum& middle, const Box& box);
// Every triangle turns its back to the eye: the distance of the eye from a ball's cone of normals (as meshoptimizer's cluster
// cones: f(p) = (p - eye).axis - sine |p - eye| changes by at most its argument's step where it is positive).
[[nodiscard]] bool turned_away(const EyeFrustum& eye, const PatchShape& patch);
// The box lies wholly in the shadow that the occluder, a box of solid material, casts from the eye. What lies in a convex body's shadow is
// convex, so its eight corners tell.
[[nodiscard]] bool behind(const Vec3& eye, const Box& box, const Box& occluder);

enum class Hidden : std::uint8_t { no, beside, turned_away, behind };
// Why neither eye can see it; the reason of the last eye asked. A patch that is bent() is drawn where no single eye sees it: it is hidden
// only beside. Occluders hide as long as no patch of the workpiece is bent: bent patches may uncover what lies behind them.
[[nodiscard]] Hidden hidden(const EyePair& eyes, const PatchShape& patch, std::span<const Box> occluders);

}  // namespace burin
