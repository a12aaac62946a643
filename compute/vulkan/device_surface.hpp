// SPDX-License-Identifier: MIT
// The surface of a solid on the Vulkan device: meshed there from the rays that a cut has changed, kept there for drawing.
//
// Data flow of a frame, all of it one submission that nobody waits for: sweeps -> cut_rays.comp lists the changed rays ->
// mesh_mark: dirty tiles -> mesh_tiles: signs, cells and edges of each -> mesh_edges: crossings -> mesh_pieces: how many
// vertices -> mesh_sizes, mesh_places: a range of the vertex and the index pool for each tile -> mesh_vertices, mesh_quads ->
// gather_ball, gather_corners: the triangles near the tool, the only thing that goes back. The rules of the mesh are those of
// tile_mesher.hpp, and so are its vertices and triangles; where a device rounds as the host does they are equal bit for bit.
//
// Ranges have powers of two as sizes; those given back are remembered by size on the device. A tile that finds no room, here or
// in a list of an earlier stage, is put on a list and keeps waiting; finish(), or the next frame, grows what was too small,
// with its contents, and meshes what waits. Nothing is lost, only late.
//
// The host's solid is behind the device's until VulkanEngine::read_back. Thread: one, that of the engine, which must outlive
// the surface; between carve and finish the engine is not to be called. Frame: the object frame, relative to the lattice's
// origin, metres. Failure: after an Error the next call meshes everything anew.
// Memory: 40 bytes a tile of the lattice, 28 bytes a vertex and 4 an index, rounded up to powers of two for each tile.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compute/tile_mesher.hpp"
#include "compute/vulkan_engine.hpp"
#include "geometry/local_surface.hpp"
#include "shaders/shared/mesh_job.h"

namespace burin {

// Sizes to start with; all but the slots grow when needed. Tests choose small ones to reach that.
struct DeviceSurfaceOptions {
    std::uint32_t slots = 512;          // tiles meshed in one submission; more take more of them
    std::uint32_t cells = 1u << 17;     // with surface, of these tiles
    std::uint32_t edges = 1u << 18;     // crossed, of these tiles
    std::uint32_t vertices = 1u << 18;  // of the whole surface
    std::uint32_t indices = 1u << 20;
};

// What the surface has done since it was made.
struct DeviceSurfaceCounts {
    std::uint64_t submissions = 0;
    std::uint64_t tiles = 0;      // meshed
    std::uint64_t cells = 0;      // whose vertices were computed
    std::uint64_t triangles = 0;  // made
    std::uint64_t growths = 0;    // of any buffer, because a tile had to wait
};

// The device's time since the last carve or update; nothing where it cannot tell.
struct DeviceTimes {
    double cut_s = 0.0, mesh_s = 0.0, gather_s = 0.0;
};

class DeviceSurface {
public:
    // The ball whose triangles are wanted (object frame).
    struct Ball {
        Vec3 center_object{0.0};
        double radius_m = 0.0;
    };

    // Meshes the whole solid.
    [[nodiscard]] static Result<std::unique_ptr<DeviceSurface>> create(VulkanEngine& engine,
                                                                       const DeviceSurfaceOptions& options = {});

    // Carves and brings the surface up to date: submitted, not waited for. What local_surface will be asked for is gathered
    // with it. Waits for the frame before, if that is not done.
    [[nodiscard]] Result<void> carve(std::span<const BallSweep> sweeps, const std::optional<Ball>& touched = {});
    // After changes that the host knows of: VulkanEngine::assign, carve, take_changes.
    [[nodiscard]] Result<void> update(const Changes& changes);
    // Waits until the surface is that of the solid.
    [[nodiscard]] Result<void> finish();

    // The triangles of the ball as loose ones, ready to be touched; of a smaller ball when there are more than the device
    // keeps room for (kBallTriangles). Does not touch sequence and made_ns. Finishes first; one more submission where the ball
    // is not the one that carve was told.
    [[nodiscard]] Result<void> local_surface(const Vec3& center_object, double radius_m, LocalSurface& out);
    // The vertices, indices and disagreeing edges of every tile, for tests and reports. Finishes first.
    [[nodiscard]] Result<std::vector<TileMesh>> download();

    // For drawing: ranges() holds a TileRange for each tile, which begins with the five words of an indexed indirect draw.
    [[nodiscard]] const gpu::Buffer& vertices() const { return vertices_; }
    [[nodiscard]] const gpu::Buffer& indices() const { return indices_; }
    [[nodiscard]] const gpu::Buffer& ranges() const { return ranges_; }
    [[nodiscard]] std::size_t tile_count() const { return grid_.count(); }
    [[nodiscard]] const DeviceSurfaceCounts& counts() const { return counts_; }
    [[nodiscard]] const std::optional<DeviceTimes>& times() const { return times_; }
    [[nodiscard]] const CarveStats& carved() const {
        return engine_.deferred_stats();
    }  // of the last carve, when finished

private:
    enum Stage {
        mark,
        tiles,
        edges,
        pieces,
        sizes,
        places,
        vertex_stage,
        hard_vertices,
        quads,
        fans,
        ball,
        bound_ball,  // where a binding shows all vertices
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
    [[nodiscard]] shared::MeshParameters parameters() const;

    VulkanEngine& engine_;
    DeviceSurfaceOptions options_;  // grows
    Lattice lattice_;
    TileGrid grid_;
    DeviceSurfaceCounts counts_;
    std::array<gpu::ComputePipeline, kStages> stages_;
    gpu::Buffer ranges_, jobs_, cells_, edges_, free_, tables_, waiting_, vertices_, indices_, members_;
    SharedBuffer counters_{"mesh counters", SharedBuffer::Traffic::both};
    SharedBuffer dirty_{"tiles to mesh", SharedBuffer::Traffic::to_device};
    SharedBuffer host_changes_{"changes to mesh", SharedBuffer::Traffic::to_device};
    SharedBuffer host_counters_{"number of changes", SharedBuffer::Traffic::to_device};
    SharedBuffer ball_places_{"places near the tool", SharedBuffer::Traffic::from_device};
    SharedBuffer ball_triangles_{"triangles near the tool", SharedBuffer::Traffic::from_device};

    std::optional<gpu::Submission> under_way_;
    std::array<gpu::Stamp, 4> stamps_{};  // its start, and the ends of cut, mesh and gathering
    std::optional<DeviceTimes> times_;
    bool cut_under_way_ = false;                // it has a pass of the engine
    bool all_stale_ = true;                     // everything has to be meshed anew
    std::vector<std::uint32_t> waiting_tiles_;  // for the next submission
    std::uint32_t sent_tiles_ = 0;              // of them, in the last one
    std::uint32_t vertices_used_ = 0, indices_used_ = 0, stamp_ = 0, most_free_ = 0;
    std::optional<Ball> touched_;  // what the last submission has gathered
};

}  // namespace burin
