// SPDX-License-Identifier: MIT
// The surfaces of a study's world as triangles: the tube's wall, the funnels at its ends, and the caps that close the
// funnels. Wall and funnels are sheets without thickness, to be felt from both sides. Frame: the world's, metres. Pure;
// any thread; allocates. Wall and funnels wind counter-clockwise seen from within: where they are drawn they are open
// towards the eye, which looks at the inside of their far half.
//
// Wall: sections of kTubeSides corners across the spine, at each of its points as many as the bend there needs, and
// between them; corners lie outside the circle as far as the middles of the sides lie inside it (0.03 mm of 45). Where
// the spine bends more sharply than the tube is wide the sections cross each other on the inner side, and their inner
// corners are moved out to the wall, so that no sheet crosses the tube; along the edge that the wall has there its
// triangles lie up to a millimetre outside. Funnel: square, from funnel_half_width at the tube's mouth straight to
// cap_half_width at cap_depth away from the tube. Cap: a box kDrawnCap_m thick beyond that.
#pragma once

#include "geometry/mesh/triangle_mesh.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

inline constexpr std::size_t kTubeSides = 64;
inline constexpr double kDrawnCap_m = 0.002;

enum class WorldEnd { start, end };

[[nodiscard]] geometry::TriangleMesh tube_mesh(const StudyWorld& world);
// To be seen alone: a section at each point of the spine, and nothing mended; and hoops around it, seen from all sides.
// A wand in the tube stands before the far half and behind the near half's hoops, one out of it before them.
[[nodiscard]] geometry::TriangleMesh drawn_tube_mesh(const StudyWorld& world);
// Empty where the world has no funnels.
[[nodiscard]] geometry::TriangleMesh funnel_mesh(const StudyWorld& world, WorldEnd end);
[[nodiscard]] geometry::TriangleMesh cap_mesh(const StudyWorld& world, WorldEnd end);

}  // namespace burin::study
