// SPDX-License-Identifier: MIT
#include "compute/vulkan/device_surface.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "compute/vulkan/device_surface_buffers.hpp"
#include "shaders/gather_ball.comp.spv.hpp"
#include "shaders/gather_corners.comp.spv.hpp"
#include "shaders/mesh_copy_cells.comp.spv.hpp"
#include "shaders/mesh_copy_quads.comp.spv.hpp"
#include "shaders/mesh_edges.comp.spv.hpp"
#include "shaders/mesh_give_back.comp.spv.hpp"
#include "shaders/mesh_mark.comp.spv.hpp"
#include "shaders/mesh_pieces.comp.spv.hpp"
#include "shaders/mesh_quads.comp.spv.hpp"
#include "shaders/mesh_sizes.comp.spv.hpp"
#include "shaders/mesh_tiles.comp.spv.hpp"
#include "shaders/mesh_vertices.comp.spv.hpp"

namespace burin::compute {
namespace {

constexpr std::uint32_t kMostBindings = 16;  // of mesh_mark.comp

using shared::ChangedRay;
using shared::CutCounters;
using shared::GatherParameters;
using shared::MeshCounters;
using shared::MeshParameters;

}  // namespace

Result<std::unique_ptr<DeviceSurface>> DeviceSurface::create(VulkanEngine& engine,
                                                             const DeviceSurfaceOptions& options) {
    std::unique_ptr<DeviceSurface> surface(new DeviceSurface(engine, options));
    auto done = surface->compile();
    if (done) done = surface->allocate();
    if (done) done = surface->finish();
    if (!done) return std::unexpected(done.error());
    return surface;
}

bool DeviceSurface::suits(const gpu::Device& device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device.core()->physical, &properties);
    return device.capabilities().scalar_block_layout &&
           properties.limits.maxPerStageDescriptorStorageBuffers >= kMostBindings;
}

DeviceSurface::DeviceSurface(VulkanEngine& engine, const DeviceSurfaceOptions& options)
    : engine_(engine), options_(options), lattice_(engine.solid().lattice), grid_(lattice_) {}

Result<void> DeviceSurface::compile() {
    if (!suits(engine_.device())) {
        return fail("Vulkan engine",
                    engine_.device().info().name + " cannot lay out buffers without gaps, or binds fewer than " +
                        std::to_string(kMostBindings) + " at once",
                    "use --engine cpu");
    }
    struct Program {
        std::span<const std::uint32_t> spirv;
        std::uint32_t buffers, push_bytes;
        const char* name;
        std::uint32_t variant = 0;
    };
    const std::uint32_t mesh = sizeof(MeshParameters), gather = sizeof(GatherParameters);
    const std::array<Program, kStages> programs{{{k_mesh_mark_comp, 16, mesh, "mark cells"},
                                                 {k_mesh_tiles_comp, 14, mesh, "list cells"},
                                                 {k_mesh_edges_comp, 14, mesh, "find crossings"},
                                                 {k_mesh_pieces_comp, 14, mesh, "count vertices"},
                                                 {k_mesh_sizes_comp, 14, mesh, "number vertices, place tiles"},
                                                 {k_mesh_vertices_comp, 14, mesh, "make vertices"},
                                                 {k_mesh_copy_cells_comp, 14, mesh, "copy vertices"},
                                                 {k_mesh_vertices_comp, 14, mesh, "make hard vertices", 1},
                                                 {k_mesh_quads_comp, 14, mesh, "make triangles"},
                                                 {k_mesh_copy_quads_comp, 14, mesh, "copy triangles"},
                                                 {k_mesh_quads_comp, 14, mesh, "make fans", 1},
                                                 {k_mesh_give_back_comp, 14, mesh, "give back ranges"},
                                                 {k_gather_ball_comp, 5, gather, "gather triangles"},
                                                 {k_gather_ball_comp, 5, gather, "gather bound triangles", 1},
                                                 {k_gather_corners_comp, 5, gather, "gather corners"}}};
    for (std::size_t i = 0; i < programs.size(); ++i) {
        BURIN_TRY(made, gpu::ComputePipeline::create(engine_.device(), {.spirv = programs[i].spirv,
                                                                        .storage_buffers = programs[i].buffers,
                                                                        .push_constant_bytes = programs[i].push_bytes,
                                                                        .constants = std::span(&programs[i].variant, 1),
                                                                        .name = programs[i].name}));
        stages_[i] = std::move(made);
    }
    return {};
}

// ---- Frames

Result<void> DeviceSurface::carve(std::span<const BallSweep> sweeps, const std::optional<Ball>& touched) {
    BURIN_TRY_DO(finish());
    BURIN_TRY_DO(engine_.defer(sweeps));
    touched_ = touched;
    times_ = Times{};
    if (!engine_.deferred_left() && !touched) return {};
    return submit({});
}

Result<void> DeviceSurface::update(const Changes& changes) {
    BURIN_TRY_DO(finish());
    touched_.reset();
    times_ = Times{};
    BURIN_TRY_DO(engine_.synchronize());
    const std::size_t most =
        static_cast<std::size_t>(engine_.device().capabilities().max_storage_buffer_bytes) / sizeof(ChangedRay);
    for (std::size_t from = 0; from < changes.rays.size(); from += most) {
        const auto some = std::span(changes.rays).subspan(from, std::min(most, changes.rays.size() - from));
        BURIN_TRY_DO(submit(some));
        BURIN_TRY_DO(finish());
    }
    return {};
}

Result<void> DeviceSurface::finish() {
    const auto failed = [&](const Error& error) {
        all_stale_ = masks_stale_ = true;
        waiting_tiles_.clear();
        under_way_.reset();
        return std::unexpected(error);
    };
    for (;;) {
        if (under_way_) {
            if (const auto settled = settle(); !settled) return failed(settled.error());
        }
        if (waiting_tiles_.empty()) unmarked_ = false;
        if (all_stale_) {
            if (const auto sent = engine_.synchronize(); !sent) return failed(sent.error());
            waiting_tiles_.resize(grid_.count());
            // In descending order, since tiles are taken from the back.
            std::iota(waiting_tiles_.rbegin(), waiting_tiles_.rend(), 0u);
            all_stale_ = false;
            unmarked_ = true;
        }
        if (waiting_tiles_.empty() && !engine_.deferred_left()) return {};
        if (const auto sent = submit({}); !sent) return failed(sent.error());
    }
}

// Submits the work that is pending: a pass of the engine or the changes that the host knows, then waiting tiles and the
// gather.
Result<void> DeviceSurface::submit(std::span<const ChangedRay> host_changes) {
    gpu::Device& device = engine_.device();
    if (!host_changes.empty()) {
        auto kept = host_changes_.reserve(device, host_changes.size_bytes());
        if (kept) kept = host_counters_.reserve(device, sizeof(CutCounters));
        if (!kept) return kept;
        std::ranges::copy(host_changes, host_changes_.to_device<ChangedRay>().begin());
        CutCounters counters{};
        counters.changed = static_cast<std::uint32_t>(host_changes.size());
        host_counters_.to_device<CutCounters>()[0] = counters;
    }
    BURIN_TRY(commands, gpu::Commands::begin(device));
    stamps_[0] = commands.stamp();
    cut_under_way_ = engine_.deferred_left() && !unmarked_;
    if (cut_under_way_) engine_.record_pass(commands);
    stamps_[1] = commands.stamp();
    send_counters(commands);
    if (std::exchange(masks_stale_, false)) commands.fill(masks_, 0, masks_.size_bytes(), 0);
    if (!host_changes.empty()) {
        host_changes_.send(commands, host_changes.size_bytes());
        host_counters_.send(commands, sizeof(CutCounters));
    }
    commands.barrier();
    if (cut_under_way_) {
        record_mesh(commands, &engine_.counters(), &engine_.changed_rays(), engine_.passed_rays());
    } else if (!host_changes.empty()) {
        record_mesh(commands, &host_counters_.buffer(), &host_changes_.buffer(),
                    static_cast<std::uint32_t>(host_changes.size()));
    } else if (sent_tiles_ > 0) {
        record_mesh(commands, nullptr, nullptr, 0);
    }
    stamps_[2] = commands.stamp();
    if (touched_) record_gather(commands, *touched_);
    stamps_[3] = commands.stamp();
    commands.barrier();
    counters_.fetch(commands, sizeof(MeshCounters));
    BURIN_TRY(submission, std::move(commands).submit());
    under_way_.emplace(std::move(submission));
    ++counts_.submissions;
    return {};
}

// Moves waiting tiles to the front of the list to mesh, as many as there are slots, and sends the initial counters.
void DeviceSurface::send_counters(gpu::Commands& commands) {
    sent_tiles_ = static_cast<std::uint32_t>(std::min<std::size_t>(waiting_tiles_.size(), options_.slots));
    std::copy_n(waiting_tiles_.rbegin(), sent_tiles_, dirty_.to_device<std::uint32_t>().begin());
    waiting_tiles_.resize(waiting_tiles_.size() - sent_tiles_);
    MeshCounters counters{};
    counters.tile_groups[0] = counters.tiles = sent_tiles_;
    for (std::uint32_t* groups :
         {counters.tile_groups, counters.edge_groups, counters.cell_groups, counters.hard_groups, counters.fan_groups,
          counters.copy_groups, counters.quad_groups}) {
        groups[1] = groups[2] = 1;
    }
    counters.vertices_used = vertices_used_;
    counters.indices_used = indices_used_;
    counters_.to_device<MeshCounters>()[0] = counters;
    counters_.send(commands, sizeof(MeshCounters));
    dirty_.send(commands, sent_tiles_ * sizeof(std::uint32_t));
}

MeshParameters DeviceSurface::parameters() const {
    MeshParameters p{};
    p.store_address = engine_.device_solid().store().address();
    p.vertex_address = vertices_.address();
    p.index_address = indices_.address();
    p.kept_address = kept_.address();
    p.spacing_m = lattice_.spacing_m;
    for (std::size_t a = 0; a < 3; ++a) {
        p.nodes[a] = lattice_.cells[a] + 1;
        p.tiles[a] = grid_.tiles[a];
        p.first_ray[a] = engine_.device_solid().first_ray()[a];
    }
    p.slots = options_.slots;
    p.most_cells = options_.cells;
    p.most_edges = options_.edges;
    p.most_vertices = options_.vertices;
    p.most_indices = options_.indices;
    p.most_free = most_free_;
    p.whole = sent_tiles_;
    p.mask_rows = mask_rows_;
    return p;
}

void DeviceSurface::record_mesh(gpu::Commands& commands, const gpu::Buffer* cut_counters, const gpu::Buffer* changed,
                                std::uint32_t most_changed) {
    const MeshParameters p = parameters();
    std::vector<gpu::BufferRange> buffers{engine_.device_solid().rays(),
                                          counters_.buffer(),
                                          ranges_,
                                          dirty_.buffer(),
                                          waiting_,
                                          jobs_,
                                          cells_,
                                          edges_,
                                          free_,
                                          tables_,
                                          lists_,
                                          kept_quads_,
                                          masks_,
                                          hard_};
    if (changed != nullptr) {
        auto with_changes = buffers;
        with_changes.emplace_back(*cut_counters);
        with_changes.emplace_back(*changed);
        const std::uint32_t groups = (most_changed + shared::kMeshGroup - 1) / shared::kMeshGroup;
        commands.dispatch(stages_[mark], with_changes, gpu::bytes_of(p), {groups, 1, 1});
        commands.barrier();
    }
    constexpr std::uint64_t kTiles = offsetof(MeshCounters, tile_groups), kEdges = offsetof(MeshCounters, edge_groups),
                            kCells = offsetof(MeshCounters, cell_groups), kHard = offsetof(MeshCounters, hard_groups),
                            kFans = offsetof(MeshCounters, fan_groups), kCopies = offsetof(MeshCounters, copy_groups),
                            kQuads = offsetof(MeshCounters, quad_groups);
    // Stages of one step do not depend on each other.
    struct Part {
        Stage stage;
        std::uint64_t groups;
        bool ends_step = true;
    };
    constexpr Part kParts[] = {{tiles, kTiles},
                               {edges, kEdges},
                               {pieces, kCells},
                               {sizes, kTiles},
                               {vertex_stage, kCells, false},
                               {copied_cells, kCopies, false},
                               {fans, kFans},
                               {hard_vertices, kHard},
                               {quads, kEdges, false},
                               {copied_quads, kQuads, false},
                               {given_back, kTiles}};
    for (const Part& part : kParts) {
        commands.dispatch_indirect(stages_[part.stage], buffers, gpu::bytes_of(p), counters_.buffer(), part.groups);
        if (part.ends_step) commands.barrier();
    }
}

// Waits for the submission, reads its counters and enlarges what was too small.
Result<void> DeviceSurface::settle() {
    BURIN_TRY_DO(under_way_->wait());
    const auto cut = under_way_->seconds_between(stamps_[0], stamps_[1]),
               mesh = under_way_->seconds_between(stamps_[1], stamps_[2]),
               gather = under_way_->seconds_between(stamps_[2], stamps_[3]);
    if (!cut || !mesh || !gather) times_.reset();
    if (times_) times_ = Times{times_->cut_s + *cut, times_->mesh_s + *mesh, times_->gather_s + *gather};
    under_way_.reset();
    const MeshCounters counters = counters_.from_device<MeshCounters>()[0];
    // Ranges are taken also in a submission whose cut fails.
    vertices_used_ = std::min(counters.vertices_used, options_.vertices);
    indices_used_ = std::min(counters.indices_used, options_.indices);
    if (cut_under_way_) {
        BURIN_TRY_DO(engine_.end_pass());
    }
    counts_.tiles += std::min(counters.tiles, options_.slots) - std::min(counters.waiting, counters.tiles);
    counts_.cells += counters.meshed_cells;
    counts_.triangles += counters.triangles;
    // A tile without a slot left its row of marked cells behind.
    masks_stale_ = masks_stale_ || counters.tiles > options_.slots;
    const auto late = read_buffer<std::uint32_t>(engine_.device(), waiting_, counters.waiting);  // rarely any tiles
    if (!late) return std::unexpected(late.error());
    waiting_tiles_.insert(waiting_tiles_.end(), late->begin(), late->end());
    return grow(counters);
}

}  // namespace burin::compute
