// SPDX-License-Identifier: MIT
#include "tests/compute/random_solids.hpp"

#include <algorithm>

namespace burin::compute::test {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;

struct Signs {
    std::array<int, 3> nodes;
    std::vector<bool> inside;

    [[nodiscard]] std::size_t index(const std::array<int, 3>& n) const {
        return static_cast<std::size_t>((n[2] * nodes[1] + n[1]) * nodes[0] + n[0]);
    }
};

Signs random_signs(const std::array<int, 3>& cells, double p, Random& random) {
    Signs signs{{cells[0] + 1, cells[1] + 1, cells[2] + 1}, {}};
    signs.inside.resize(static_cast<std::size_t>(signs.nodes[0] * signs.nodes[1] * signs.nodes[2]));
    for (int z = 1; z < cells[2]; ++z)
        for (int y = 1; y < cells[1]; ++y)
            for (int x = 1; x < cells[0]; ++x) signs.inside[signs.index({x, y, z})] = random.chance(p);
    return signs;
}

DexelEnd random_end(int depth, Random& random) {
    return shared::make_end(depth, random.chance(0.5) ? 1u : 0u, static_cast<std::uint32_t>(random.bits()));
}

std::vector<DexelEnd> ray_of(const Signs& signs, std::size_t axis, int u, int v, Random& random) {
    std::vector<DexelEnd> ends;
    bool before = false;
    for (int s = 0; s < signs.nodes[axis]; ++s) {
        std::array<int, 3> node{};
        node[axis] = s;
        node[(axis + 1) % 3] = u;
        node[(axis + 2) % 3] = v;
        const bool now = signs.inside[signs.index(node)];
        // A node at depth d is inside when lo <= d < hi: the end lies above the lower node and not above the upper one.
        if (now != before) ends.push_back(random_end((s - 1) * kUnitsPerCell + random.small(1, kUnitsPerCell), random));
        before = now;
    }
    return ends;
}

void disturb(std::vector<DexelEnd>& ends, int deepest, Random& random) {
    std::vector<int> depths;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        if (random.chance(0.15)) continue;
        for (std::size_t k = i; k < i + 2; ++k) {
            int depth = depth_of(ends[k]);
            if (random.chance(0.3)) depth += random.small(-3 * kUnitsPerCell, 3 * kUnitsPerCell);
            if (random.chance(0.1)) depth = depth / kUnitsPerCell * kUnitsPerCell;
            depths.push_back(std::clamp(depth, 0, deepest));
        }
    }
    std::ranges::sort(depths);
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    if (depths.size() % 2 != 0) depths.pop_back();
    ends.clear();
    for (const int depth : depths) ends.push_back(random_end(depth, random));
}

}  // namespace

Solid noise_solid(const std::array<int, 3>& cells, double p, Rays rays, std::uint64_t seed) {
    Random random(seed);
    Solid solid{{Vec3(-0.3, 0.2, 0.1), 0.01, cells}, {}, {{"one", {200, 100, 0}}, {"other", {0, 50, 250}}}};
    const Signs signs = random_signs(cells, p, random);
    const Signs others = random_signs(cells, p, random);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        std::vector<std::uint32_t> counts;
        std::vector<DexelEnd> all;
        for (int v = 0; v < solid.lattice.rays_v(axis); ++v) {
            for (int u = 0; u < solid.lattice.rays_u(axis); ++u) {
                auto ends = ray_of(rays == Rays::unrelated && axis != 2 ? others : signs, a, u, v, random);
                if (rays == Rays::disturbed && axis != 2) disturb(ends, cells[a] * kUnitsPerCell, random);
                counts.push_back(static_cast<std::uint32_t>(ends.size()));
                all.insert(all.end(), ends.begin(), ends.end());
            }
        }
        solid.sets[a] = DexelSet(solid.lattice.rays_u(axis), solid.lattice.rays_v(axis));
        solid.sets[a].assign(counts, all);
    }
    return solid;
}

}  // namespace burin::compute::test
