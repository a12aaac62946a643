// SPDX-License-Identifier: MIT
#include "compute/vulkan/cell_maker.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "compute/mesher/cell_table.hpp"
#include "shaders/find_crossings.comp.spv.hpp"
#include "shaders/list_cells.comp.spv.hpp"
#include "shaders/make_cells.comp.spv.hpp"
#include "shaders/mark_cells.comp.spv.hpp"
#include "shaders/shared/cell_row.h"

namespace burin::compute {
namespace {

using shared::CellCounters;
using shared::CellParameters;
using shared::MadeCell;
using shared::MadeEdge;
using shared::MadeTile;
using shared::SurfaceVertex;

constexpr std::uint32_t kMostBindings = 14;       // of mark_cells.comp
constexpr std::uint64_t kMostGroups = 65535;      // that every device takes in one dispatch
constexpr std::uint32_t kMostMarkGroups = 16384;  // beyond them each invocation marks around several rays
constexpr std::size_t kTableWords = std::size_t{4} * 256;

// Packs cell_table.hpp and the colours of the materials for the device (shaders/shared/cell_row.h).
void write_tables(std::span<const geometry::Material> materials, std::span<std::uint32_t> words) {
    std::ranges::fill(words, 0u);
    for (std::size_t pattern = 0; pattern < 256; ++pattern) {
        const CellCase& c = cell_table()[pattern];
        shared::uvec4 row(0u);
        for (std::uint32_t i = 0; i < 12; ++i) row = shared::row_with_edge(row, i, c.edges[i]);
        for (std::uint32_t loop = 1; loop < 5; ++loop) row = shared::row_with_first(row, loop, c.first_edge[loop]);
        row = shared::row_with_loops(row, c.loops, c.twice_faces);
        std::uint32_t* word = &words[4 * pattern];
        word[0] = row.x;
        word[1] = row.y;
        word[2] = row.z;
    }
    for (std::size_t m = 0; m < materials.size() && m < 256; ++m) {
        const auto& colour = materials[m].colour;
        words[4 * m + 3] = std::uint32_t{colour[0]} | std::uint32_t{colour[1]} << 8 | std::uint32_t{colour[2]} << 16;
    }
}

template <typename T>
std::vector<T> copied(const SharedBuffer& from, std::size_t count) {
    const auto all = from.from_device<T>().first(count);
    return {all.begin(), all.end()};
}

}  // namespace

bool CellMaker::suits(const gpu::Device& device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device.core()->physical, &properties);
    return device.capabilities().scalar_block_layout &&
           properties.limits.maxPerStageDescriptorStorageBuffers >= kMostBindings;
}

Result<std::unique_ptr<CellMaker>> CellMaker::create(const gpu::Device& device, const CellMakerOptions& options) {
    if (!suits(device)) {
        return fail(
            device.info().name,
            "cannot lay out buffers without gaps, or binds fewer than " + std::to_string(kMostBindings) + " at once",
            "");
    }
    std::unique_ptr<CellMaker> maker(new CellMaker(device, options));
    BURIN_TRY_DO(maker->compile());
    BURIN_TRY_DO(maker->reserve());
    return maker;
}

Result<void> CellMaker::compile() {
    struct Program {
        std::span<const std::uint32_t> spirv;
        std::uint32_t buffers;
        const char* name;
        std::uint32_t variant = 0;
    };
    const std::array<Program, kStages> programs{{{k_mark_cells_comp, kMostBindings, "mark cells"},
                                                 {k_list_cells_comp, 12, "list cells"},
                                                 {k_find_crossings_comp, 12, "find crossings"},
                                                 {k_make_cells_comp, 12, "make cells"},
                                                 {k_make_cells_comp, 12, "make hard cells", 1}}};
    for (std::size_t i = 0; i < programs.size(); ++i) {
        BURIN_TRY(made, gpu::ComputePipeline::create(device_, {.spirv = programs[i].spirv,
                                                               .storage_buffers = programs[i].buffers,
                                                               .push_constant_bytes = sizeof(CellParameters),
                                                               .constants = std::span(&programs[i].variant, 1),
                                                               .name = programs[i].name}));
        stages_[i] = std::move(made);
    }
    return {};
}

Result<void> CellMaker::reserve() {
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes;
    const auto bounded = [&](std::uint32_t& count, std::size_t element_bytes, std::uint64_t most) {
        count = static_cast<std::uint32_t>(std::min<std::uint64_t>({count, limit / element_bytes, most}));
    };
    bounded(options_.tiles, sizeof(shared::CellTile), kMostGroups);
    bounded(options_.cells, sizeof(MadeCell), kMostGroups * shared::kCellGroup);
    bounded(options_.edges, sizeof(shared::ListedEdge), kMostGroups * shared::kCellGroup);
    bounded(options_.vertices, sizeof(SurfaceVertex), limit);
    mask_rows_ = std::bit_ceil(2 * options_.tiles);
    const std::uint64_t masks_before = masks_.size_bytes();
    const std::pair<SharedBuffer*, std::uint64_t> sizes[] = {
        {&counters_, sizeof(CellCounters)},
        {&tables_, kTableWords * sizeof(std::uint32_t)},
        {&tiles_, options_.tiles * sizeof(shared::CellTile)},
        {&masks_, std::uint64_t{mask_rows_} * sizeof(shared::TileMask)},
        {&cells_, options_.cells * sizeof(shared::ListedCell)},
        {&edges_, options_.edges * sizeof(shared::ListedEdge)},
        {&hard_, options_.cells * sizeof(std::uint32_t)},
        {&made_tiles_, options_.tiles * sizeof(MadeTile)},
        {&made_cells_, options_.cells * sizeof(MadeCell)},
        {&made_edges_, options_.edges * sizeof(MadeEdge)},
        {&made_vertices_, options_.vertices * sizeof(SurfaceVertex)},
    };
    for (const auto& [buffer, size] : sizes) BURIN_TRY_DO(buffer->reserve(device_, size));
    masks_are_stale_ = masks_are_stale_ || masks_.size_bytes() != masks_before;
    return {};
}

CellParameters CellMaker::parameters(const Solid& host, const DeviceSolid& solid) const {
    CellParameters p{};
    p.store_address = solid.store().address();
    p.spacing_m = host.lattice.spacing_m;
    const TileGrid grid(host.lattice);
    for (std::size_t a = 0; a < 3; ++a) {
        p.nodes[a] = host.lattice.cells[a] + 1;
        p.tiles[a] = grid.tiles[a];
        p.first_ray[a] = solid.first_ray()[a];
    }
    p.slots = options_.tiles;
    p.most_cells = options_.cells;
    p.most_edges = p.most_own_edges = options_.edges;
    p.most_vertices = options_.vertices;
    p.mask_rows = mask_rows_;
    return p;
}

Result<void> CellMaker::send(gpu::Commands& commands, const Solid& host) {
    BURIN_TRY_DO(reserve());
    if (materials_ != host.materials.size()) {
        write_tables(host.materials, tables_.to_device<std::uint32_t>());
        materials_ = host.materials.size();
        tables_.send(commands, kTableWords * sizeof(std::uint32_t));
    }
    CellCounters counters{};
    for (std::uint32_t* groups :
         {counters.tile_groups, counters.edge_groups, counters.cell_groups, counters.hard_groups})
        groups[1] = groups[2] = 1;
    counters_.to_device<CellCounters>()[0] = counters;
    counters_.send(commands, sizeof(CellCounters));
    if (std::exchange(masks_are_stale_, false)) commands.fill(masks_.buffer(), 0, masks_.size_bytes(), 0);
    return {};
}

void CellMaker::record(gpu::Commands& commands, const Solid& host, const DeviceSolid& solid,
                       const gpu::Buffer& cut_counters, const gpu::Buffer& changed, std::uint32_t most_changed) {
    const CellParameters p = parameters(host, solid);
    std::vector<gpu::BufferRange> buffers{solid.rays(),         counters_.buffer(),   tiles_.buffer(),
                                          masks_.buffer(),      cells_.buffer(),      edges_.buffer(),
                                          tables_.buffer(),     hard_.buffer(),       made_tiles_.buffer(),
                                          made_cells_.buffer(), made_edges_.buffer(), made_vertices_.buffer()};
    auto with_changes = buffers;
    with_changes.emplace_back(cut_counters);
    with_changes.emplace_back(changed);
    constexpr std::uint32_t kGroup = shared::kCellGroup;
    commands.dispatch(stages_[mark], with_changes, gpu::bytes_of(p),
                      {std::min((most_changed + kGroup - 1) / kGroup, kMostMarkGroups), 1, 1});
    constexpr std::pair<Stage, std::size_t> kSteps[] = {{list, offsetof(CellCounters, tile_groups)},
                                                        {cross, offsetof(CellCounters, edge_groups)},
                                                        {make, offsetof(CellCounters, cell_groups)},
                                                        {make_hard, offsetof(CellCounters, hard_groups)}};
    for (const auto& [stage, groups] : kSteps) {
        commands.barrier();
        commands.dispatch_indirect(stages_[stage], buffers, gpu::bytes_of(p), counters_.buffer(), groups);
    }
    commands.barrier();
    counters_.fetch(commands, sizeof(CellCounters));
}

std::optional<MadeCells> CellMaker::take() {
    const CellCounters counters = counters_.from_device<CellCounters>()[0];
    ++counts_.updates;
    // A tile that got no slot has left its row of marked cells behind.
    masks_are_stale_ = masks_are_stale_ || counters.missed > 0;
    const bool is_whole = counters.missed == 0 && counters.tiles <= options_.tiles;
    std::optional<MadeCells> made;
    if (is_whole) {
        made.emplace();
        made->tiles = copied<MadeTile>(made_tiles_, counters.tiles);
        made->cells = copied<MadeCell>(made_cells_, std::min(counters.cells, options_.cells));
        made->edges = copied<MadeEdge>(made_edges_, std::min(counters.own_edges, options_.edges));
        made->vertices = copied<SurfaceVertex>(made_vertices_, std::min(counters.vertices, options_.vertices));
        count(*made);
    } else {
        ++counts_.left_updates;
    }
    grow(counters);
    return made;
}

void CellMaker::count(const MadeCells& made) {
    counts_.tiles += made.tiles.size();
    counts_.cells += made.cells.size();
    counts_.vertices += made.vertices.size();
    for (const MadeTile& tile : made.tiles) counts_.left_tiles += tile.left;
    device_.core()->count_written_to_host(made.tiles.size() * sizeof(MadeTile) + made.cells.size() * sizeof(MadeCell) +
                                          made.edges.size() * sizeof(MadeEdge) +
                                          made.vertices.size() * sizeof(SurfaceVertex));
}

// Lets the lists grow where they were too small; record() reserves them.
void CellMaker::grow(const CellCounters& counters) {
    const auto follow = [](std::uint32_t& held, std::uint32_t wanted) {
        if (wanted > held) held = wanted + wanted / 2;
    };
    follow(options_.tiles, counters.missed > 0 ? std::max(counters.tiles, options_.tiles + 1) : counters.tiles);
    follow(options_.cells, counters.cells);
    follow(options_.edges, std::max(counters.edges, counters.own_edges));
    follow(options_.vertices, counters.vertices);
}

}  // namespace burin::compute
