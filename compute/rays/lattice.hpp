// SPDX-License-Identifier: MIT
// The cubic lattice that a solid lives on: where it lies in the object frame and how coarse it is.
// Depths and coordinates in lattice units (shaders/shared/dexel.h) are whole numbers counted from the lattice origin.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "base/space.hpp"
#include "shaders/shared/dexel.h"

namespace burin::compute {

struct Lattice {
    Vec3 origin_object{0.0};            // metres
    double spacing_m = 1.0;             // h, the width of a cell
    std::array<int, 3> cells{0, 0, 0};  // along x, y, z; there is one more node than cells along each axis

    [[nodiscard]] double unit_m() const { return spacing_m / shared::kUnitsPerCell; }
    // Converts metres in the object frame to lattice units, not rounded, and back.
    [[nodiscard]] Vec3 units_from_object(const Vec3& p_object) const { return (p_object - origin_object) / unit_m(); }
    [[nodiscard]] Vec3 object_from_units(const Vec3& units) const { return origin_object + units * unit_m(); }

    // Number of rays along `axis`: u runs along axis + 1, v along axis + 2 (cyclic).
    [[nodiscard]] int rays_u(int axis) const { return cells[static_cast<std::size_t>((axis + 1) % 3)] + 1; }
    [[nodiscard]] int rays_v(int axis) const { return cells[static_cast<std::size_t>((axis + 2) % 3)] + 1; }
    [[nodiscard]] std::size_t rays(int axis) const {
        return static_cast<std::size_t>(rays_u(axis)) * static_cast<std::size_t>(rays_v(axis));
    }
    // Returns whether floats in the object frame resolve a thousandth of a cell. They do not where the lattice lies far
    // from the object's origin compared with its cells; formats that hold floats (STL, PLY) are then unusable.
    [[nodiscard]] bool fits_floats() const {
        const Vec3 far =
            glm::max(glm::abs(origin_object), glm::abs(origin_object + Vec3(cells[0], cells[1], cells[2]) * spacing_m));
        return std::max({far.x, far.y, far.z}) < 8192.0 * spacing_m;  // 2^24 / 8192 = 2048 floats a cell
    }
    bool operator==(const Lattice&) const = default;
};

// Returns the lattice with its lengths as numbers in `unit`, for meshes whose positions are such numbers.
[[nodiscard]] Lattice in_unit(const Lattice& lattice, LengthUnit unit);

inline constexpr int kMinResolution = 16, kMaxResolution = 2048;

// Returns a lattice of `resolution` cells along the longest side of `bounds` (h = longest side / resolution), with at
// least one empty cell around it. The bounds are placed symmetrically between nodes, so that none of their faces lies
// on a node: there, the sign would depend on rounding. Fails when the resolution is out of range or the bounds are
// empty, flat in every direction, not finite, outside 1e-9 to 1e9 m, or farther from the origin than 2^24 times their
// longest side.
[[nodiscard]] Result<Lattice> lattice_around(const Box& bounds, int resolution);

}  // namespace burin::compute
