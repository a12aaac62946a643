// SPDX-License-Identifier: MIT
#include "compute/rays/room.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "compute/rays/memory_need.hpp"

namespace burin::compute {
namespace {

// Returns a ray's ends, each deeper by so many units.
void append_shifted(std::span<const shared::DexelEnd> ends, int by_units, std::vector<shared::DexelEnd>& to) {
    for (const shared::DexelEnd& end : ends)
        to.push_back(shared::make_end(shared::depth_of(end) + by_units, shared::material_of(end), end.normal));
}

DexelSet with_room(const DexelSet& held, int cells) {
    DexelSet roomy(held.rays_u() + 2 * cells, held.rays_v() + 2 * cells);
    std::vector<std::uint32_t> counts(roomy.ray_count(), 0);
    std::vector<shared::DexelEnd> ends;
    ends.reserve(held.end_count());
    for (int v = 0; v < held.rays_v(); ++v) {
        const std::size_t row = static_cast<std::size_t>(v + cells) * static_cast<std::size_t>(roomy.rays_u()) +
                                static_cast<std::size_t>(cells);
        for (int u = 0; u < held.rays_u(); ++u) {
            const auto ray = held.ends(u, v);
            counts[row + static_cast<std::size_t>(u)] = static_cast<std::uint32_t>(ray.size());
            append_shifted(ray, cells * shared::kUnitsPerCell, ends);
        }
    }
    roomy.assign(counts, ends);
    return roomy;
}

}  // namespace

int most_room_cells(const Lattice& lattice) {
    return std::max(0, (shared::kMaxCells - *std::ranges::max_element(lattice.cells)) / 2);
}

Result<Solid> with_room(Solid solid, int cells) {
    if (cells == 0) return solid;
    Solid roomy{solid.lattice, {}, std::move(solid.materials)};
    for (int& along : roomy.lattice.cells) along += 2 * cells;
    roomy.lattice.origin_object -= Vec3(cells * solid.lattice.spacing_m);
    const auto rays = static_cast<std::uint64_t>(roomy.lattice.rays(0) + roomy.lattice.rays(1) + roomy.lattice.rays(2));
    const auto available = memory_available();
    // Memory of a ray, at most: 4 bytes in its page, 4 of counts while rays are assigned, 8 on a device.
    constexpr std::uint64_t kBytesARay = 16;
    if (available && rays * kBytesARay > *available)
        return fail("--room", "takes more memory than there is", "give less, or lower --resolution");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        roomy.sets.at(axis) = with_room(solid.sets.at(axis), cells);
        solid.sets.at(axis) = DexelSet();
    }
    return roomy;
}

}  // namespace burin::compute
