// SPDX-License-Identifier: MIT
// Brings a mesh to another place and size, as burin convert --center, --place and --scale ask.
//   p -> (p - middle) * scale + place   where a place is given; `middle` is that of the box around all triangles
//   p -> p * scale                      where none is: about the origin of the mesh's frame
// So where the box ends up does not depend on the scale. A negative scale mirrors at a point; triangles are then wound
// the other way round, so that what faced outwards still does.
// Metres, object frame; all in double, before any rounding to the numbers of a file. Pure; any thread.
#pragma once

#include <optional>

#include "base/error.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// How much smaller and larger --scale makes a mesh at most, mirrored or not.
inline constexpr double kSmallestScale = 1e-6, kLargestScale = 1e6;

struct Placing {
    std::optional<Vec3> middle_m;  // where the middle of the box goes
    double scale = 1.0;

    [[nodiscard]] bool changes_nothing() const { return !middle_m && scale == 1.0; }
    [[nodiscard]] bool mirrors() const { return scale < 0.0; }
};

// Checks that the scale is not 0, nor beyond the limits above.
[[nodiscard]] Result<void> check_scale(double scale);
// Returns the box around all triangles: a stray vertex does not enlarge it.
[[nodiscard]] Box bounds_of(const TriangleMesh& mesh);
// Winds all triangles the other way round.
void turn_over(TriangleMesh& mesh);
void place_mesh(TriangleMesh& mesh, const Placing& placing);

}  // namespace burin::geometry
