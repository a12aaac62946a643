// SPDX-License-Identifier: MIT
// Capacities of a DeviceSurface's buffers on the device: initial allocation and growth.
#include <algorithm>
#include <bit>

#include "base/try.hpp"
#include "compute/mesher/cell_table.hpp"
#include "compute/vulkan/device_surface.hpp"
#include "compute/vulkan/device_surface_buffers.hpp"
#include "shaders/shared/cell_row.h"

namespace burin::compute {
namespace {

using shared::MeshCounters;
using shared::SurfaceVertex;
using shared::TileJob;
using shared::TileRange;

constexpr std::uint32_t kMemberBytes = 8, kTriangleBytes = 12, kKeptBytes = 16;
constexpr std::uint32_t kQuadBytes = 8;
constexpr std::uint32_t kListBytes = 4;
constexpr std::uint32_t kTableWords = 4 * 256;
constexpr std::uint32_t kMostFree = 65536;
constexpr std::uint32_t kLists = 2 * shared::kRangeClasses;

// Packs cell_table.hpp and the colours of the materials for the device (shaders/shared/cell_row.h).
std::vector<std::uint32_t> table_words(std::span<const geometry::Material> materials) {
    std::vector<std::uint32_t> words(kTableWords, 0);
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
    return words;
}

}  // namespace

Result<void> DeviceSurface::allocate() {
    gpu::Device& device = engine_.device();
    constexpr auto kStorage = gpu::BufferUse::device_storage, kAddressed = gpu::BufferUse::addressed;
    const std::size_t tile_count = grid_.count();
    options_.slots = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        {options_.slots, tile_count, device.capabilities().max_storage_buffer_bytes / sizeof(TileJob)}));
    mask_rows_ = std::bit_ceil(2 * options_.slots);
    most_free_ = static_cast<std::uint32_t>(std::min<std::size_t>(tile_count, kMostFree));
    const std::size_t free_words = kLists + std::size_t{kLists} * most_free_;
    auto done = create_into(ranges_, device, kStorage, tile_count * sizeof(TileRange), "tile ranges");
    if (done) done = create_into(jobs_, device, kStorage, options_.slots * sizeof(TileJob), "tile jobs");
    if (done) done = create_into(cells_, device, kStorage, options_.cells * sizeof(shared::MeshCell), "cells");
    if (done) done = create_into(edges_, device, kStorage, options_.edges * sizeof(shared::MeshEdge), "crossed edges");
    if (done) done = create_into(lists_, device, kStorage, options_.cells * kListBytes, "lists of cells");
    if (done) done = create_into(hard_, device, kStorage, options_.cells * kListBytes, "cells without a closed form");
    if (done) done = create_into(kept_quads_, device, kStorage, options_.edges * kQuadBytes, "quads to copy");
    if (done) done = create_into(masks_, device, kStorage, mask_rows_ * sizeof(shared::TileMask), "marked cells");
    if (done) done = create_into(free_, device, kStorage, free_words * sizeof(std::uint32_t), "free ranges");
    if (done) done = create_into(tables_, device, kStorage, kTableWords * sizeof(std::uint32_t), "cell table");
    if (done) done = create_into(vertices_, device, kAddressed, options_.vertices * sizeof(SurfaceVertex), "vertices");
    if (done) done = create_into(members_, device, kAddressed, options_.vertices * kMemberBytes, "vertex numbers");
    if (done) done = create_into(kept_, device, kAddressed, options_.vertices * kKeptBytes, "cells of ranges");
    if (done) done = create_into(indices_, device, kAddressed, options_.indices * sizeof(std::uint32_t), "indices");
    if (done) done = counters_.reserve(device, sizeof(MeshCounters));
    if (done) done = dirty_.reserve(device, options_.slots * sizeof(std::uint32_t));
    if (done) done = create_into(waiting_, device, kStorage, tile_count * sizeof(std::uint32_t), "waiting tiles");
    if (done) done = ball_places_.reserve(device, options_.ball_vertices * sizeof(Vec3f));
    if (done) done = ball_triangles_.reserve(device, options_.ball_triangles * kTriangleBytes);
    TileRange none{};
    none.vertex_class = none.index_class = shared::kNoClass;
    if (done) done = fill_buffer(device, ranges_, std::vector<TileRange>(tile_count, none));
    if (done) done = fill_buffer(device, free_, std::vector<std::uint32_t>(kLists, 0));
    if (done) done = fill_buffer(device, tables_, table_words(engine_.solid().materials));
    if (done) done = fill_buffer(device, members_, std::vector<std::uint32_t>(std::size_t{2} * options_.vertices, 0));
    return done;
}

Result<void> DeviceSurface::grow(const MeshCounters& counters) {
    gpu::Device& device = engine_.device();
    const auto grow_list = [&](gpu::Buffer& list, std::size_t element_bytes, std::uint32_t& held, std::uint32_t wanted,
                               const char* name) -> Result<void> {
        if (wanted <= held) return {};
        const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes / element_bytes;
        const auto more = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted + wanted / 2, limit));
        if (more == held) {  // limit of a binding reached: mesh fewer tiles at once
            options_.slots = std::max(1u, options_.slots / 2);
            return {};
        }
        ++counts_.growths;
        held = more;
        return create_into(list, device, gpu::BufferUse::device_storage, more * element_bytes, name);
    };
    const auto follow = [&](gpu::Buffer& list, std::uint32_t held, std::uint32_t element_bytes, const char* name) {
        return create_into(list, device, gpu::BufferUse::device_storage, std::uint64_t{held} * element_bytes, name);
    };
    const std::uint32_t cells = options_.cells, edges = options_.edges;
    auto done = grow_list(cells_, sizeof(shared::MeshCell), options_.cells, counters.cells, "cells");
    if (done && options_.cells > cells) {
        done = follow(lists_, options_.cells, kListBytes, "lists of cells");
        if (done) done = follow(hard_, options_.cells, kListBytes, "cells without a closed form");
    }
    if (!done) options_.cells = cells;  // which all of these lists still hold
    const std::uint32_t more_edges = std::max(counters.edges, counters.kept_quads);
    if (done) {
        done = grow_list(edges_, sizeof(shared::MeshEdge), options_.edges, more_edges, "crossed edges");
        if (done && options_.edges > edges) done = follow(kept_quads_, options_.edges, kQuadBytes, "quads to copy");
        if (!done) options_.edges = edges;
    }
    if (done && counters.vertices_used > options_.vertices) {
        std::uint32_t members = options_.vertices;
        done = grow_pool(members_, kMemberBytes, members, counters.vertices_used, "vertex numbers");
        std::uint32_t kept = options_.vertices;
        if (done) done = grow_pool(kept_, kKeptBytes, kept, counters.vertices_used, "cells of ranges");
        if (done) {
            done = grow_pool(vertices_, sizeof(SurfaceVertex), options_.vertices, counters.vertices_used, "vertices");
        }
    }
    if (done && counters.indices_used > options_.indices) {
        done = grow_pool(indices_, sizeof(std::uint32_t), options_.indices, counters.indices_used, "indices");
    }
    return done;
}

bool DeviceSurface::holds_ball(const MeshCounters& counters) const {
    return counters.ball_triangles <= options_.ball_triangles && counters.ball_vertices <= options_.ball_vertices;
}

Result<bool> DeviceSurface::grow_ball(const MeshCounters& counters) {
    gpu::Device& device = engine_.device();
    const std::uint64_t shown_bytes =
        std::min(device.capabilities().max_storage_buffer_bytes, device.core()->max_allocation_bytes);
    const auto enlarge = [&](SharedBuffer& buffer, std::uint32_t& held, std::uint32_t wanted,
                             std::uint32_t bytes) -> Result<bool> {
        if (wanted <= held) return true;
        const auto more = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(wanted + std::uint64_t{wanted} / 4, shown_bytes / bytes));
        if (more < wanted) return false;
        if (const auto made = buffer.reserve(device, std::uint64_t{more} * bytes); !made) {
            return std::unexpected(made.error());
        }
        ++counts_.growths;
        held = more;
        return true;
    };
    // The vertices of triangles that found no room were not counted. A closed surface has half as many as triangles.
    const std::uint32_t vertices =
        counters.ball_triangles > options_.ball_triangles ? counters.ball_triangles / 2 + 1 : counters.ball_vertices;
    const auto room = enlarge(ball_triangles_, options_.ball_triangles, counters.ball_triangles, kTriangleBytes);
    if (!room || !*room) return room;
    return enlarge(ball_places_, options_.ball_vertices, vertices, sizeof(Vec3f));
}

// Enlarges a pool and keeps its contents; the rest is zero.
Result<void> DeviceSurface::grow_pool(gpu::Buffer& pool, std::size_t element_bytes, std::uint32_t& held,
                                      std::uint32_t wanted, const char* name) {
    gpu::Device& device = engine_.device();
    const std::uint32_t more = wanted + wanted / 2;
    gpu::Buffer larger;
    if (const auto made = create_into(larger, device, gpu::BufferUse::addressed, more * element_bytes, name); !made) {
        return made;
    }
    BURIN_TRY(commands, gpu::Commands::begin(device));
    const std::uint64_t bytes = held * element_bytes;
    commands.copy(pool, 0, larger, 0, bytes);
    commands.fill(larger, bytes, larger.size_bytes() - bytes, 0);
    commands.keep_alive(std::exchange(pool, std::move(larger)));
    BURIN_TRY(submission, std::move(commands).submit());
    ++counts_.growths;
    held = more;
    return {};
}

}  // namespace burin::compute
