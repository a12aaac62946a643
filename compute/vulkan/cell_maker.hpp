// SPDX-License-Identifier: MIT
// Makes on a Vulkan device the cells of the surface that a cut can have altered, from the rays that the device holds,
// equal to those of compute/mesher/tile_mesher.hpp to the bit. The host puts them into its tiles
// (compute/mesher/made_cells.hpp), which touch, light, pictures and files read. So nothing of the surface is kept on
// the device, and what the host changes it need not be told of.
//
// Data flow, behind the passes of a cut in the same submission: the rays that they changed -> mark_cells: the cells
// around these rays, by tile -> list_cells: signs of each tile, those of its marked cells that have surface, and their
// crossed edges -> find_crossings -> make_cells: vertices, twice where some cells have no closed form. Tiles, cells,
// crossings and vertices are written into the host's memory, in the order of the tile's columns. How much there is to
// do is known only to the device, so stages are dispatched indirectly.
//
//   maker->send(commands, host);                                           // before the cut, and a barrier behind it
//   maker->record(commands, solid, cut_counters, changed, most_changed);   // behind the cut
//   ... submit, wait ...
//   std::optional<MadeCells> made = maker->take();
//
// What finds no room in a list is left to the host: a tile, or all of them where tiles themselves found none. The lists
// then grow for the next time.
// Memory: 8.5 KB a tile of one update, 60 bytes a cell and 40 bytes a crossed edge. Thread and failure: as gpu::Device.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "compute/mesher/made_cells.hpp"
#include "compute/mesher/tile_grid.hpp"
#include "compute/rays/solid.hpp"
#include "compute/vulkan/vulkan_engine_memory.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "gpu/pipelines.hpp"
#include "shaders/shared/cell_job.h"

namespace burin::compute {

// Initial sizes; all of them grow when needed. Tests choose small ones so that growth happens.
struct CellMakerOptions {
    std::uint32_t tiles = 256;  // of one update
    std::uint32_t cells = 1u << 14;
    std::uint32_t edges = 1u << 15;
    std::uint32_t vertices = 1u << 14;
};

// Counts the work done since the maker was made.
struct CellMakerCounts {
    std::uint64_t updates = 0, tiles = 0, cells = 0, vertices = 0;
    std::uint64_t left_tiles = 0;    // to the host
    std::uint64_t left_updates = 0;  // to the host as a whole
};

class CellMaker {
public:
    // Says whether a device lays out buffers without gaps, and binds as many at once as the shaders take.
    [[nodiscard]] static bool suits(const gpu::Device& device);
    // Fails on a device that does not suit, or lacks the memory.
    [[nodiscard]] static Result<std::unique_ptr<CellMaker>> create(const gpu::Device& device,
                                                                   const CellMakerOptions& options = {});

    // Makes room, and records the sending of what the stages begin with: `host` has the lattice and the materials.
    [[nodiscard]] Result<void> send(gpu::Commands& commands, const Solid& host);
    // Records the making of cells around the rays listed in `changed`, ChangedRay[], of which `cut_counters`
    // (CutCounters) holds the number: most_changed at most. The cut comes before, with a barrier.
    void record(gpu::Commands& commands, const Solid& host, const DeviceSolid& solid, const gpu::Buffer& cut_counters,
                const gpu::Buffer& changed, std::uint32_t most_changed);
    // Returns what was made, once the commands are done; nothing where tiles found no room.
    [[nodiscard]] std::optional<MadeCells> take();

    [[nodiscard]] const CellMakerCounts& counts() const { return counts_; }

private:
    enum Stage { mark, list, cross, make, make_hard, kStages };
    CellMaker(const gpu::Device& device, const CellMakerOptions& options) : device_(device), options_(options) {}
    [[nodiscard]] Result<void> compile();
    [[nodiscard]] Result<void> reserve();
    [[nodiscard]] shared::CellParameters parameters(const Solid& host, const DeviceSolid& solid) const;
    void grow(const shared::CellCounters& counters);
    void count(const MadeCells& made);

    gpu::Device device_;
    CellMakerOptions options_;  // its sizes grow with the lists
    CellMakerCounts counts_;
    std::array<gpu::ComputePipeline, kStages> stages_;
    std::uint32_t mask_rows_ = 0;
    bool masks_are_stale_ = true;  // marks of cells may be left of an earlier update
    std::size_t materials_ = 0;    // whose colours the device has
    SharedBuffer counters_{"cell counters", SharedBuffer::Traffic::both};
    SharedBuffer tables_{"cell table", SharedBuffer::Traffic::to_device};
    SharedBuffer tiles_{"tiles", SharedBuffer::Traffic::none}, masks_{"marked cells", SharedBuffer::Traffic::none};
    SharedBuffer cells_{"cells", SharedBuffer::Traffic::none}, edges_{"crossed edges", SharedBuffer::Traffic::none};
    SharedBuffer hard_{"cells without a closed form", SharedBuffer::Traffic::none};
    SharedBuffer made_tiles_{"made tiles", SharedBuffer::Traffic::in_place};
    SharedBuffer made_cells_{"made cells", SharedBuffer::Traffic::in_place};
    SharedBuffer made_edges_{"made crossings", SharedBuffer::Traffic::in_place};
    SharedBuffer made_vertices_{"made vertices", SharedBuffer::Traffic::in_place};
};

}  // namespace burin::compute
