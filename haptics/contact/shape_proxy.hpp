// SPDX-License-Identifier: MIT
// The god-object (proxy) of a tool that is no ball: its shape follows the hand as far as the surface lets it.
//
// As god_object.hpp for a ball, with planes between convex pieces and triangles (separation.hpp) in place of a ball's
// nearest points. The tool turns as the hand turns it, by as much in a tick as brings its hulls into no triangle, and
// its place is what the surface holds off: the point nearest to the haptic interface point (HIP) at which it touches.
// In each step of a tick:
//   1. Each triangle that the rounded pieces touch gives a plane. A face that is touched gives its own plane, so that
//      the tool slides over it; an edge or a corner may sink in by kEdge of the rounding, so that it is rolled over. It
//      gives none where it lies behind a face that is touched, and pushes along its face's normal alone where another
//      face rises beside it: the edges of a flat or hollow surface are nothing to be felt.
//   2. The goal is the point nearest to the HIP beyond all these planes (half_spaces.hpp); friction holds it back.
//   3. The tool goes there, up to the first other triangle: a triangle whose own plane it stays beyond cannot be hit,
//      and others are approached by their distance along the plane between both (conservative advancement).
// Cost: among many triangles the faces that the tool lies on are found first, and whatever lies behind their planes is
// left out, whole groups of neighbours at once (geometry/contact/triangle_slab.hpp). So a flat tool on a flat surface
// costs the same however finely that is meshed. Where that does not suffice less is gathered, then vertices stand for
// triangles.
// Hulls that overlap the surface, after an edit
// or where contact begins, are pushed out along the triangles' normals for some ticks; until the tool fits there is no
// contact.
// Frame: object, metres. No heap, lock, throw; the work is counted and bounded (contact_work.hpp).
#pragma once

#include <optional>

#include "haptics/contact/god_object.hpp"
#include "haptics/contact/tool_shape.hpp"

namespace burin::haptics {

struct ShapeMotion {
    Vec3 hip_object_m{0.0};
    // object_from_tool: of the last tick, and as the hand holds the tool now
    Quat before{1.0, 0.0, 0.0, 0.0}, wanted{1.0, 0.0, 0.0, 0.0};
    double static_friction = 0.0, dynamic_friction = 0.0;
    std::optional<Vec3> cut_to_object_m = std::nullopt;  // where the tool has cut to, of which what touches falls short
};

struct ShapeResult {
    ProxyResult proxy;
    Quat orientation_object{1.0, 0.0, 0.0, 0.0};  // of the tool at its proxy
    Vec3 touched_object_m{0.0};                   // the middle of the places that bear it, weighted by what they bear
};

// Moves a tool's proxy towards the HIP for one tick. Requires what move_proxy() does, unit orientations, and a shape
// that touches.
[[nodiscard]] ShapeResult move_shape(const ProxyState& state, const ShapeMotion& motion, const ToolShape& shape,
                                     const geometry::PosedSurface& surface, const ProxyBudget& budget = {}) noexcept;

}  // namespace burin::haptics
