// SPDX-License-Identifier: MIT
// Drops loose crumbs from a mesh that leaves: small shells that carving has cut off and nobody can hold. Pure; any
// thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// Crumbs up to here are dropped where nothing else is asked for, in cells of the lattice: a crumb of so few cells has
// no shape of its own.
inline constexpr double kCrumbCells = 3.0;

struct DroppedCrumbs {
    std::size_t count = 0;
    double below_m = 0.0;  // that they are smaller than
};

// Drops the shells whose longest side is below this length, and the hollows within their boxes; returns how many shells
// that is. Hollows of what stays are kept, and so is always the shell of the longest side. Takes a closed mesh of
// numbers in the unit, whose shells share no vertex; 0 drops nothing.
DroppedCrumbs drop_crumbs(TriangleMesh& numbers, LengthUnit unit, double below_m);

// Says so in words: "dropped 7 crumbs smaller than 0.5 mm"; empty where there were none.
[[nodiscard]] std::string in_words(const DroppedCrumbs& dropped);

// Checks the length of --crumbs, which is finite and not negative.
[[nodiscard]] Result<void> check_crumbs(std::optional<double> below_m);

}  // namespace burin::geometry
