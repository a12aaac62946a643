// SPDX-License-Identifier: MIT
// The surface of a solid on the Vulkan device, meshed there from the rays that a cut has changed and kept there for
// drawing.
//
// Data flow of a frame, all in one submission without a wait: sweeps -> cut_rays.comp lists the changed rays ->
// mesh_mark: dirty tiles and cells -> mesh_tiles: signs of each tile, cells to make and to keep, edges of the former ->
// mesh_edges: crossings -> mesh_pieces: numbers of vertices -> mesh_sizes: a new range of the vertex and the index pool
// for each tile -> mesh_vertices, mesh_copy_cells -> mesh_quads, mesh_copy_quads, mesh_give_back -> gather_ball,
// gather_corners: the triangles near the tool, which are all that is read back. Rules, vertices and triangles of the
// mesh are those of tile_mesher.hpp; where a device rounds as the host does they are equal bit for bit.
//
// Ranges have sizes that are powers of two; the device keeps lists of free ranges by size. Whoever meshes a tile takes
// new ranges, since cells that did not change are copied from the old ones, and gives those back. A tile that finds no
// space, in a pool or in a list of an earlier stage, is put on a list of waiting tiles and stays as it was; finish() or
// the next frame enlarges what was too small, keeping the contents of the pools, and meshes the waiting tiles whole.
// So a tile that finds no space is late, and not lost.
//
// The host's solid lags behind the device's until VulkanEngine::read_back. Thread: that of the engine, which must
// outlive the surface and must not be called between carve and finish. Frame: the object frame, relative to the
// lattice's origin, metres. Failure: after an Error the next call meshes everything anew.
// Memory: 48 bytes a tile of the lattice, 44 bytes a vertex and 4 an index, rounded up to powers of two for each tile.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compute/mesher/tile_mesher.hpp"
#include "compute/vulkan/vulkan_engine.hpp"
#include "geometry/contact/local_surface.hpp"
#include "shaders/shared/mesh_job.h"

namespace burin::compute {

// Initial sizes; all but the slots grow when needed. Tests choose small ones so that growth happens.
struct DeviceSurfaceOptions {
    std::uint32_t slots = 512;          // tiles meshed in one submission; more tiles take several submissions
    std::uint32_t cells = 1u << 17;     // cells with surface in these tiles
    std::uint32_t edges = 1u << 18;     // crossed edges in these tiles
    std::uint32_t vertices = 1u << 18;  // of the whole surface
    std::uint32_t indices = 1u << 20;
    std::uint32_t ball_triangles = 1u << 16;  // near the tool
    std::uint32_t ball_vertices = 1u << 15;   // of these triangles
};

class DeviceSurface final : public MeshingDevice {
public:
    // Says whether a device lays out buffers without gaps, and binds as many at once as the mesher takes.
    [[nodiscard]] static bool suits(const gpu::Device& device);
    // Makes the surface of the engine's solid and meshes all of it.
    [[nodiscard]] static Result<std::unique_ptr<DeviceSurface>> create(VulkanEngine& engine,
                                                                       const DeviceSurfaceOptions& options = {});

    [[nodiscard]] Result<void> carve(std::span<const BallSweep> sweeps,
                                     const std::optional<Ball>& touched = {}) override;
    // Updates the surface after changes that the host knows: those of VulkanEngine::assign and carve, as returned by
    // take_changes.
    [[nodiscard]] Result<void> update(const Changes& changes);
    [[nodiscard]] Result<void> finish() override;

    // Only when the triangles exceed what a binding shows (capabilities().max_storage_buffer_bytes) is the ball made
    // smaller. Takes one more submission where the ball differs from the one given to carve, and one or two more where
    // it holds more than any before.
    [[nodiscard]] Result<void> local_surface(const Vec3& center_object, double radius_m,
                                             geometry::LocalSurface& out) override;
    [[nodiscard]] Result<void> read_back() override { return engine_.read_back(); }
    // Returns the vertices, indices and disagreeing edges of every tile, for tests and reports. Calls finish first.
    [[nodiscard]] Result<std::vector<TileMesh>> download();

    // Buffers for drawing. ranges() holds a TileRange for each tile, which begins with the five words of an indexed
    // indirect draw.
    [[nodiscard]] const gpu::Buffer& vertices() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& indices() const { return indices_; }
    [[nodiscard]] const gpu::Buffer& ranges() const { return ranges_; }
    [[nodiscard]] std::size_t tile_count() const { return grid_.count(); }
    [[nodiscard]] const Counts& counts() const override { return counts_; }
    [[nodiscard]] const std::optional<Times>& times() const override { return times_; }
    [[nodiscard]] const CarveStats& carved() const override { return engine_.deferred_stats(); }

private:
    enum Stage {
        mark,
        tiles,
        edges,
        pieces,
        sizes,
        vertex_stage,
        copied_cells,
        hard_vertices,
        quads,
        copied_quads,
        fans,
        given_back,
        ball,
        bound_ball,  // used where all vertices fit into one binding
        corners,
        kStages
    };
    DeviceSurface(VulkanEngine& engine, const DeviceSurfaceOptions& options);
    [[nodiscard]] Result<void> compile();
    [[nodiscard]] Result<void> allocate();
    void write_tables();
    [[nodiscard]] Result<void> mesh_all();
    [[nodiscard]] Result<void> submit(std::span<const shared::ChangedRay> host_changes);
    [[nodiscard]] Result<void> settle();
    [[nodiscard]] Result<void> grow(const shared::MeshCounters& counters);
    [[nodiscard]] Result<void> grow_pool(gpu::Buffer& pool, std::size_t element_bytes, std::uint32_t& held,
                                         std::uint32_t wanted, const char* name);
    void send_counters(gpu::Commands& commands);
    void record_mesh(gpu::Commands& commands, const gpu::Buffer* cut_counters, const gpu::Buffer* changed,
                     std::uint32_t most_changed);
    void record_gather(gpu::Commands& commands, const Ball& ball);
    [[nodiscard]] Result<void> gather_alone(const Ball& ball);
    [[nodiscard]] bool holds_ball(const shared::MeshCounters& counters) const;
    // Makes room for the ball that was counted; false where the device has none.
    [[nodiscard]] Result<bool> grow_ball(const shared::MeshCounters& counters);
    [[nodiscard]] shared::MeshParameters parameters() const;

    VulkanEngine& engine_;
    DeviceSurfaceOptions options_;  // its sizes grow with the buffers
    Lattice lattice_;
    TileGrid grid_;
    Counts counts_;
    std::array<gpu::ComputePipeline, kStages> stages_;
    gpu::Buffer ranges_, jobs_, cells_, edges_, free_, tables_, waiting_, vertices_, indices_, members_;
    gpu::Buffer lists_, kept_quads_, masks_, hard_, kept_;
    SharedBuffer counters_{"mesh counters", SharedBuffer::Traffic::both};
    SharedBuffer dirty_{"tiles to mesh", SharedBuffer::Traffic::to_device};
    SharedBuffer host_changes_{"changes to mesh", SharedBuffer::Traffic::to_device};
    SharedBuffer host_counters_{"number of changes", SharedBuffer::Traffic::to_device};
    SharedBuffer ball_places_{"places near the tool", SharedBuffer::Traffic::from_device};
    SharedBuffer ball_triangles_{"triangles near the tool", SharedBuffer::Traffic::from_device};

    std::optional<gpu::Submission> under_way_;
    std::array<gpu::Stamp, 4> stamps_{};  // start of under_way_ and ends of its cut, mesh and gather
    std::optional<Times> times_;
    bool cut_under_way_ = false;                // under_way_ contains a pass of the engine
    bool all_stale_ = true;                     // set when everything has to be meshed anew
    bool unmarked_ = false;                     // tiles wait that the device does not know of: no cut may list them
    bool masks_stale_ = true;                   // set when marks of cells are left of an earlier submission
    std::vector<std::uint32_t> waiting_tiles_;  // to be meshed by the next submissions
    std::uint32_t sent_tiles_ = 0;              // number of those in the last submission
    std::uint32_t vertices_used_ = 0, indices_used_ = 0, stamp_ = 0, most_free_ = 0, mask_rows_ = 0;
    std::optional<Ball> touched_;  // the ball of the last gather
};

}  // namespace burin::compute
