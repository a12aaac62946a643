// SPDX-License-Identifier: MIT
// Tools by their distance, and sweeps by searching for the nearest pose: slow, plain, and nothing like the closed
// forms.
#pragma once

#include <type_traits>
#include <variant>

#include "compute/rays/lattice.hpp"
#include "compute/tools/tool.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {

// Of a point in the tool's frame from its surface, metres; below zero inside. All but MeshTool.
[[nodiscard]] double signed_distance(const ToolShape& shape, const Vec3& p_tool);

// Distance of a point from the tool on a straight way at fixed orientation, zero inside: the least over the way, by
// golden section, since it is convex along it.
[[nodiscard]] double distance_from_sweep(const ToolSweep& sweep, const Vec3& p_object);

// The least signed distance over `poses` + 1 poses of a turning sweep, by textbook slerp.
[[nodiscard]] double signed_distance_from_poses(const ToolSweep& sweep, const Vec3& p_object, int poses);
[[nodiscard]] Pose pose_at(const ToolSweep& sweep, double share);

// Where a ray runs through a straight sweep, in lattice units: the distance along a ray is convex too. `misses` when
// even the nearest point of the ray stays outside; then `clearance` is how far.
struct ReferenceSpan {
    bool misses = true;
    double clearance = 0.0, lo = 0.0, hi = 0.0;
};
[[nodiscard]] ReferenceSpan reference_span(const Lattice& lattice, const ToolSweep& sweep, int axis, int u, int v);

[[nodiscard]] Quat any_orientation(Random& random);
// Number of the kinds of ToolShape but the last, the mesh, which has no parts to draw. Tests that draw tools draw from
// all of these, so that a new kind is tested by each.
inline constexpr int kDrawnKinds = static_cast<int>(std::variant_size_v<ToolShape>) - 1;
static_assert(std::is_same_v<std::variant_alternative_t<kDrawnKinds, ToolShape>, MeshTool>);

// Number of a kind in ToolShape.
template <typename Tool, int first = 0>
consteval int kind_of() {
    if constexpr (std::is_same_v<std::variant_alternative_t<first, ToolShape>, Tool>) {
        return first;
    } else {
        return kind_of<Tool, first + 1>();
    }
}
template <typename Tool>
inline constexpr int kKindOf = kind_of<Tool>();

// A tool of the kind with this number below kDrawnKinds, or of any of them, with parts between lo and hi metres.
[[nodiscard]] ToolShape any_shape(Random& random, double lo, double hi, int kind);
[[nodiscard]] inline ToolShape any_shape(Random& random, double lo, double hi) {
    return any_shape(random, lo, hi, random.small(0, kDrawnKinds - 1));
}

}  // namespace burin::compute::test
