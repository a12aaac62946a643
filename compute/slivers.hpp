// SPDX-License-Identifier: MIT
// What the mesh cannot show: solid thinner than a cell that passes between the lattice's nodes, and gaps as thin. The rays
// keep both, and later cuts work on them; the mesher sees only whether nodes are inside (tile_samples.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"

namespace burin {

// One interval of a ray without a node in it, by its middle and its length.
struct Sliver {
    Vec3 place_object_m{0.0};
    double thickness_m = 0.0;  // along the ray: what it measures across may be less
    int axis = 0;              // of the ray
    bool is_gap = false;
};

struct SliverReport {
    std::array<std::uint64_t, 3> solid{}, gaps{};  // intervals of the rays along x, y, z
    double thinnest_m = 0.0;                       // of all of them; 0 when there are none
    Box bounds_object_m;                           // of their middles
    std::vector<Sliver> first;                     // the first few, in the order of axis, row and ray

    [[nodiscard]] std::uint64_t count() const { return solid[0] + solid[1] + solid[2] + gaps[0] + gaps[1] + gaps[2]; }
};

inline constexpr std::size_t kSliversNamed = 8;

// Looks at every ray once. The result does not depend on the number of threads.
[[nodiscard]] SliverReport find_slivers(const Solid& solid, WorkerPool& pool);

}  // namespace burin
