// SPDX-License-Identifier: MIT
// The surface of a carved solid, tile by tile: kept up to date where the solid changed, read by drawing, touching, export.
// One thread; re-meshing is dealt out to the pool, and the result does not depend on how many threads there are.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/dirty_cells.hpp"
#include "compute/ray_batch.hpp"
#include "compute/tile_mesher.hpp"
#include "geometry/local_surface.hpp"

namespace burin {

struct RemeshStats {
    std::uint64_t tiles = 0;      // looked at
    std::uint64_t cells = 0;      // whose vertices were computed anew
    std::uint64_t triangles = 0;  // made anew, because a cell at one of their corners was
};

class Surface {
public:
    explicit Surface(const Lattice& lattice)
        : lattice_(lattice), grid_(lattice), dirty_(lattice), tiles_(grid_.count()) {}

    // Meshes everything anew.
    RemeshStats mesh_all(const Solid& solid, WorkerPool& pool);
    // Brings the surface up to date after the changes; meshes anew only the cells whose data changed. The result is the
    // same, bit for bit, as mesh_all's.
    RemeshStats update(const Solid& solid, const Changes& changes, WorkerPool& pool);
    // The tiles that the last mesh_all or update meshed anew, in increasing order.
    [[nodiscard]] std::span<const std::uint32_t> changed_tiles() const { return changed_tiles_; }

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] const TileMesh& tile(std::uint32_t index) const {
        static const TileMesh empty;
        return tiles_[index] ? *tiles_[index] : empty;
    }
    // The same to keep: it stays as it is while carving goes on. Null for a tile without surface.
    [[nodiscard]] const std::shared_ptr<const TileMesh>& shared_tile(std::uint32_t index) const {
        return tiles_[index];
    }
    [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint64_t disagreeing_edges() const { return disagreeing_edges_; }

    // The enclosed volume by the divergence theorem, m^3.
    [[nodiscard]] double volume_m3() const;
    // One closed two-manifold mesh in the object frame: vertices shared across sharp edges and tile borders, sorted by key,
    // with the mean colour of the surfaces that meet there. No two vertices share a place, in float precision too if the
    // lattice fits_floats().
    [[nodiscard]] TriangleMesh welded() const;

private:
    template <typename MaskOf>
    RemeshStats mesh_tiles(const Solid& solid, MaskOf&& mask_of, WorkerPool& pool);

    Lattice lattice_;
    TileGrid grid_;
    DirtyCells dirty_;
    std::vector<std::shared_ptr<const TileMesh>> tiles_;  // none for a tile without surface
    std::vector<std::uint32_t> changed_tiles_;
    std::vector<TileWork> work_;
    std::uint64_t triangles_ = 0, disagreeing_edges_ = 0;
};

// Fills `out` with references to the tiles that may have triangles within radius_m of center_object, and with its ball; what
// it referred to before lapses. Copies no triangle, and allocates only where the block of places grows. Does not touch
// sequence and made_ns.
void gather_local_surface(const Surface& surface, const Vec3& center_object, double radius_m, LocalSurface& out);

}  // namespace burin
