// SPDX-License-Identifier: MIT
// How far a triangle is from a tool's shape at least, as told by the tool's own sides.
//
// In its bed a tool's sides lie along the facets, which are as far as the clearance from them, so that one side tells
// for most of them that they are not touched. The triangle's own plane does not: a facet that is turned a little cuts
// into the far end of the tool.
// Frame: the tool's axes, metres. No heap, lock, throw.
#pragma once

#include "geometry/mesh/triangle.hpp"
#include "haptics/contact/tool_shape.hpp"

namespace burin::haptics {

// What a look at all sides costs, in looks (WorkCost::kLook_ns).
inline constexpr std::uint32_t kLooksOfSides = 3;

struct SideGap {
    double gap_m = 0.0;        // the least distance of triangle and hull; 0 or less: no side tells them apart
    double plane_gap_m = 0.0;  // between the planes square to the normal through the two; of a turned side less
    Vec3 normal{0.0};          // from the tool to the triangle, unit
};

// The side before which the triangle is the farthest. at: of the tool's origin.
[[nodiscard]] SideGap side_gap(const ToolShape& shape, const geometry::Triangle& triangle, const Vec3& at) noexcept;

}  // namespace burin::haptics
