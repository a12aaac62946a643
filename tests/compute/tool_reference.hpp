// SPDX-License-Identifier: MIT
// Tools by their distance, and sweeps by searching for the nearest pose: slow, plain, and nothing like the closed forms.
#pragma once

#include "compute/lattice.hpp"
#include "compute/tool.hpp"
#include "tests/compute/effort.hpp"

namespace burin::test {

// Of a point in the tool's frame from its surface, metres; below zero inside. All but MeshTool.
[[nodiscard]] double signed_distance(const ToolShape& shape, const Vec3& p_tool);

// Distance of a point from the tool on a straight way at fixed orientation, zero inside: the least over the way, by golden
// section, since it is convex along it.
[[nodiscard]] double distance_from_sweep(const ToolSweep& sweep, const Vec3& p_object);

// The least signed distance over `poses` + 1 poses of a turning sweep, by textbook slerp.
[[nodiscard]] double signed_distance_from_poses(const ToolSweep& sweep, const Vec3& p_object, int poses);
[[nodiscard]] Pose pose_at(const ToolSweep& sweep, double share);

// Where a ray runs through a straight sweep, in lattice units: the distance along a ray is convex too. `misses` when even the
// nearest point of the ray stays outside; then `clearance` is how far.
struct ReferenceSpan {
    bool misses = true;
    double clearance = 0.0, lo = 0.0, hi = 0.0;
};
[[nodiscard]] ReferenceSpan reference_span(const Lattice& lattice, const ToolSweep& sweep, int axis, int u, int v);

[[nodiscard]] Quat any_orientation(Random& random);
// A ball, cylinder, cone, bull-nose or box with parts between lo and hi metres.
[[nodiscard]] ToolShape any_shape(Random& random, double lo, double hi, int kind);

}  // namespace burin::test
