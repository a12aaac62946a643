// SPDX-License-Identifier: MIT
// The number by which a scene, its hands and its records know an object. Pure.
#pragma once

#include <cstdint>

namespace burin::scene {

// From 1, unique in a scene. Also the name of the body by which the tick knows an object that moves.
using ObjectId = std::uint64_t;

// The object of contacts with what has no number of its own, the carved workpiece: geometry::LocalSurface::kUnnumbered.
inline constexpr ObjectId kCarvedObject = 0xffffffffu;

}  // namespace burin::scene
