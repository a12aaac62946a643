// SPDX-License-Identifier: MIT
// Finds what the mesh cannot represent: solid thinner than a cell that passes between the lattice's nodes, and gaps as
// thin. The rays keep both, and later cuts work on them; the mesher sees only whether nodes are inside
// (tile_samples.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

// An interval of a ray that contains no node; place_object_m is its midpoint.
struct Sliver {
    Vec3 place_object_m{0.0};
    double thickness_m = 0.0;  // along the ray; the true thickness may be less
    int axis = 0;              // direction of the ray
    bool is_gap = false;
};

struct SliverReport {
    std::array<std::uint64_t, 3> solid{}, gaps{};  // number of intervals, by the rays' axis x, y, z
    double thinnest_m = 0.0;                       // the smallest of all; 0 when there are none
    // Half of them are thinner. Where a curved surface grazes rays some are as thin as one likes, at any resolution; a
    // wall or a gap shows in most of them.
    double median_m = 0.0;
    Box bounds_object_m;        // bounds of their midpoints
    std::vector<Sliver> first;  // the first kSliversNamed, ordered by axis, row and ray

    [[nodiscard]] std::uint64_t count() const { return solid[0] + solid[1] + solid[2] + gaps[0] + gaps[1] + gaps[2]; }
};

inline constexpr std::size_t kSliversNamed = 8;

// Returns the resolution from which on a lattice around the same bounds shows the thicker half of them: its cells are
// as wide as median_m, so that each of these holds a node. Nothing where no lattice is so fine.
[[nodiscard]] std::optional<int> resolution_that_shows(const SliverReport& slivers, const Lattice& lattice);

// Scans every ray once. The result does not depend on the number of threads.
[[nodiscard]] SliverReport find_slivers(const Solid& solid, WorkerPool& pool);

}  // namespace burin::compute
