// SPDX-License-Identifier: MIT
// The surface of a carved solid, tile by tile: updated where the solid changed, read by rendering, haptics and export.
// To be used from one thread; re-meshing is distributed over the pool, and the result does not depend on the number of
// threads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/length_unit.hpp"
#include "base/work_watch.hpp"
#include "base/worker_pool.hpp"
#include "compute/mesher/dirty_cells.hpp"
#include "compute/mesher/tile_mesher.hpp"
#include "compute/rays/ray_batch.hpp"
#include "geometry/contact/local_surface.hpp"

namespace burin::compute {

struct RemeshStats {
    std::uint64_t tiles = 0;      // tiles whose mesh was rebuilt
    std::uint64_t cells = 0;      // cells whose vertices were recomputed
    std::uint64_t triangles = 0;  // triangles rebuilt because a cell at one of their corners was
};

class Surface {
public:
    explicit Surface(const Lattice& lattice)
        : lattice_(lattice), grid_(lattice), dirty_(lattice), tiles_(grid_.count()) {}

    // Meshes all tiles from scratch. Where the watch wants no more the tiles that are left stay empty.
    RemeshStats mesh_all(const Solid& solid, WorkerPool& pool, WorkWatch* watch = nullptr);
    // Updates the surface after the changes; re-meshes only the cells whose data changed. The result equals that of
    // mesh_all bit for bit. Takes the cells that a device has made after the same changes, where given: the result and
    // the statistics are the same. Makes those tiles itself that the device has left or whose numbers cannot be right
    // (compose_tile), and all where it names a tile twice or none of this surface; the solid's rays are read, and the
    // changes sorted, for these alone.
    RemeshStats update(const Solid& solid, const Changes& changes, WorkerPool& pool, const MadeCells* made = nullptr);
    // Returns the tiles that the last mesh_all or update re-meshed, in increasing order.
    [[nodiscard]] std::span<const std::uint32_t> changed_tiles() const { return changed_tiles_; }

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] const TileMesh& tile(std::uint32_t index) const {
        static const TileMesh empty;
        return tiles_[index] ? *tiles_[index] : empty;
    }
    // Shares ownership of a tile's mesh, which stays unchanged while carving goes on. Null for a tile without surface.
    [[nodiscard]] const std::shared_ptr<const TileMesh>& shared_tile(std::uint32_t index) const {
        return tiles_[index];
    }
    [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::uint64_t disagreeing_edges() const { return disagreeing_edges_; }

    // Computes the enclosed volume by the divergence theorem, m^3.
    [[nodiscard]] double volume_m3() const;
    // Returns one closed two-manifold mesh in the object frame: vertices are shared across sharp edges and tile
    // borders, sorted by key, with the mean colour of the surfaces that meet there. Its positions are numbers in
    // `unit`, rounded as a file in that unit holds them: to floats if the lattice fits_floats(), else relative to its
    // origin. No two vertices have the same position.
    [[nodiscard]] geometry::TriangleMesh welded(LengthUnit unit = LengthUnit::m) const;

private:
    template <typename MaskOf>
    RemeshStats mesh_tiles(const Solid& solid, MaskOf&& mask_of, WorkerPool& pool, WorkWatch* watch = nullptr);
    RemeshStats compose_tiles(const Solid& solid, const Changes& changes, const MadeCells& made, WorkerPool& pool);
    // Sorts the tiles into changed_tiles_ and made_order_. Returns false where they are not tiles of this surface.
    [[nodiscard]] bool list_tiles(const MadeCells& made);
    // Make the mesh of changed_tiles_[i] anew, for several i at once. compose() returns false, and changes nothing,
    // where the device's cells do not make it.
    void mesh(std::size_t i, const Solid& solid, const CellMask& dirty);
    [[nodiscard]] bool compose(std::size_t i, const Solid& solid, const MadeCells& made);
    void replace(std::size_t i, TileWork work, std::shared_ptr<TileMesh> fresh);
    // Takes the changed tiles out of the sums before they are replaced, and adds them afterwards.
    void subtract_changed();
    RemeshStats add_changed();

    Lattice lattice_;
    TileGrid grid_;
    DirtyCells dirty_;
    std::vector<std::shared_ptr<const TileMesh>> tiles_;  // null for a tile without surface
    std::vector<std::uint32_t> changed_tiles_;
    std::vector<TileWork> work_;
    std::vector<std::uint64_t> made_order_;  // the tile's number, then its index in MadeCells::tiles in the lower half
    std::uint64_t triangles_ = 0, disagreeing_edges_ = 0;
};

// Fills `out` with the ball and with references to the tiles that may have triangles within radius_m of center_object;
// earlier references are released. Copies no triangle, and allocates only where the block of places grows. Leaves
// sequence and made_ns untouched.
void gather_local_surface(const Surface& surface, const Vec3& center_object, double radius_m,
                          geometry::LocalSurface& out);

}  // namespace burin::compute
