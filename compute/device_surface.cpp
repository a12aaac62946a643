// SPDX-License-Identifier: MIT
#include "compute/device_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <utility>

#include "compute/cell_table.hpp"
#include "shaders/gather_ball.comp.spv.hpp"
#include "shaders/gather_corners.comp.spv.hpp"
#include "shaders/mesh_edges.comp.spv.hpp"
#include "shaders/mesh_mark.comp.spv.hpp"
#include "shaders/mesh_pieces.comp.spv.hpp"
#include "shaders/mesh_places.comp.spv.hpp"
#include "shaders/mesh_quads.comp.spv.hpp"
#include "shaders/mesh_sizes.comp.spv.hpp"
#include "shaders/mesh_tiles.comp.spv.hpp"
#include "shaders/mesh_vertices.comp.spv.hpp"

namespace burin {
namespace {

using shared::ChangedRay;
using shared::CutCounters;
using shared::GatherParameters;
using shared::MeshCounters;
using shared::MeshParameters;
using shared::SurfaceVertex;
using shared::TileJob;
using shared::TileRange;

static_assert(shared::kMeshTile == kTileCells && shared::kMeshCells == kSeenCells);

constexpr std::uint32_t kMemberBytes = 8;
constexpr std::uint32_t kTableWords = 4 * 256;
constexpr std::uint32_t kMostFree = 65536;
constexpr std::uint32_t kLists = 2 * shared::kRangeClasses;

template <typename T>
Result<void> fill_buffer(gpu::Device& device, const gpu::Buffer& buffer, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    if (buffer.mapped().empty()) return gpu::write(device, buffer, 0, bytes);
    std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());
    return {};
}

template <typename T>
Result<std::vector<T>> read_buffer(gpu::Device& device, const gpu::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count == 0) return values;
    if (!buffer.mapped().empty()) {
        std::memcpy(values.data(), buffer.mapped().data(), count * sizeof(T));
        return values;
    }
    const auto bytes = gpu::read(device, buffer, 0, count * sizeof(T));
    if (!bytes) return std::unexpected(bytes.error());
    std::memcpy(values.data(), bytes->data(), bytes->size());
    return values;
}

Result<void> create_into(gpu::Buffer& to, gpu::Device& device, gpu::BufferUse use, std::uint64_t size_bytes,
                         const char* name) {
    auto made = gpu::Buffer::create(device, use, size_bytes, name);
    if (!made) return std::unexpected(made.error());
    to = std::move(*made);
    return {};
}

// cell_table.hpp and the colours of the materials, as mesh_buffers.glsl reads them.
std::vector<std::uint32_t> table_words(std::span<const Material> materials) {
    std::vector<std::uint32_t> words(kTableWords, 0);
    for (std::size_t pattern = 0; pattern < 256; ++pattern) {
        const CellCase& c = cell_table()[pattern];
        std::uint32_t* word = &words[4 * pattern];
        for (std::size_t i = 0; i < 12; ++i) word[i / 8] |= std::uint32_t{c.edges[i]} << (4 * (i % 8));
        for (std::size_t loop = 1; loop < 5; ++loop) word[1] |= std::uint32_t{c.first_edge[loop]} << (12 + 4 * loop);
        word[2] = c.loops | std::uint32_t{c.twice_faces} << 4;
    }
    for (std::size_t m = 0; m < materials.size() && m < 256; ++m) {
        const auto& colour = materials[m].colour;
        words[4 * m + 3] = std::uint32_t{colour[0]} | std::uint32_t{colour[1]} << 8 | std::uint32_t{colour[2]} << 16;
    }
    return words;
}

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

DeviceSurface::DeviceSurface(VulkanEngine& engine, const DeviceSurfaceOptions& options)
    : engine_(engine), options_(options), lattice_(engine.solid().lattice), grid_(lattice_) {}

Result<void> DeviceSurface::compile() {
    if (!engine_.device().capabilities().scalar_block_layout) {
        return fail("Vulkan engine", engine_.device().info().name + " cannot lay out buffers without gaps",
                    "use --engine cpu");
    }
    struct Program {
        std::span<const std::uint32_t> spirv;
        std::uint32_t buffers, push_bytes;
        const char* name;
        std::uint32_t variant = 0;
    };
    const std::uint32_t mesh = sizeof(MeshParameters), gather = sizeof(GatherParameters);
    const std::array<Program, kStages> programs{{{k_mesh_mark_comp, 12, mesh, "mark tiles"},
                                                 {k_mesh_tiles_comp, 10, mesh, "list cells"},
                                                 {k_mesh_edges_comp, 10, mesh, "find crossings"},
                                                 {k_mesh_pieces_comp, 10, mesh, "count vertices"},
                                                 {k_mesh_sizes_comp, 10, mesh, "number vertices"},
                                                 {k_mesh_places_comp, 10, mesh, "place tiles"},
                                                 {k_mesh_vertices_comp, 10, mesh, "make vertices"},
                                                 {k_mesh_vertices_comp, 10, mesh, "make hard vertices", 1},
                                                 {k_mesh_quads_comp, 10, mesh, "make triangles"},
                                                 {k_mesh_quads_comp, 10, mesh, "make fans", 1},
                                                 {k_gather_ball_comp, 4, gather, "gather triangles"},
                                                 {k_gather_corners_comp, 4, gather, "gather corners"}}};
    for (std::size_t i = 0; i < programs.size(); ++i) {
        auto made = gpu::ComputePipeline::create(engine_.device(), {.spirv = programs[i].spirv,
                                                                    .storage_buffers = programs[i].buffers,
                                                                    .push_constant_bytes = programs[i].push_bytes,
                                                                    .constants = std::span(&programs[i].variant, 1),
                                                                    .name = programs[i].name});
        if (!made) return std::unexpected(made.error());
        stages_[i] = std::move(*made);
    }
    return {};
}

Result<void> DeviceSurface::allocate() {
    gpu::Device& device = engine_.device();
    constexpr auto kStorage = gpu::BufferUse::device_storage, kAddressed = gpu::BufferUse::addressed;
    const std::size_t tile_count = grid_.count();
    options_.slots = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        {options_.slots, tile_count, device.capabilities().max_storage_buffer_bytes / sizeof(TileJob)}));
    most_free_ = static_cast<std::uint32_t>(std::min<std::size_t>(tile_count, kMostFree));
    const std::size_t free_words = kLists + std::size_t{kLists} * most_free_;
    auto done = create_into(ranges_, device, kStorage, tile_count * sizeof(TileRange), "tile ranges");
    if (done) done = create_into(jobs_, device, kStorage, options_.slots * sizeof(TileJob), "tile jobs");
    if (done) done = create_into(cells_, device, kStorage, options_.cells * sizeof(shared::MeshCell), "cells");
    if (done) done = create_into(edges_, device, kStorage, options_.edges * sizeof(shared::MeshEdge), "crossed edges");
    if (done) done = create_into(free_, device, kStorage, free_words * sizeof(std::uint32_t), "free ranges");
    if (done) done = create_into(tables_, device, kStorage, kTableWords * sizeof(std::uint32_t), "cell table");
    if (done) done = create_into(vertices_, device, kAddressed, options_.vertices * sizeof(SurfaceVertex), "vertices");
    if (done) done = create_into(members_, device, kAddressed, options_.vertices * kMemberBytes, "vertex numbers");
    if (done) done = create_into(indices_, device, kAddressed, options_.indices * sizeof(std::uint32_t), "indices");
    if (done) done = counters_.reserve(device, sizeof(MeshCounters));
    if (done) done = dirty_.reserve(device, options_.slots * sizeof(std::uint32_t));
    if (done) done = create_into(waiting_, device, kStorage, tile_count * sizeof(std::uint32_t), "waiting tiles");
    if (done) done = ball_places_.reserve(device, shared::kBallVertices * sizeof(Vec3f));
    if (done) done = ball_triangles_.reserve(device, shared::kBallTriangles * 3 * sizeof(std::uint32_t));
    TileRange none{};
    none.vertex_class = none.index_class = shared::kNoClass;
    if (done) done = fill_buffer(device, ranges_, std::vector<TileRange>(tile_count, none));
    if (done) done = fill_buffer(device, free_, std::vector<std::uint32_t>(kLists, 0));
    if (done) done = fill_buffer(device, tables_, table_words(engine_.solid().materials));
    if (done) done = fill_buffer(device, members_, std::vector<std::uint32_t>(std::size_t{2} * options_.vertices, 0));
    return done;
}

// ---- Frames

Result<void> DeviceSurface::carve(std::span<const BallSweep> sweeps, const std::optional<Ball>& touched) {
    if (const auto done = finish(); !done) return done;
    if (const auto begun = engine_.defer(sweeps); !begun) return begun;
    touched_ = touched;
    times_ = DeviceTimes{};
    if (!engine_.deferred_left() && !touched) return {};
    return submit({});
}

Result<void> DeviceSurface::update(const Changes& changes) {
    if (const auto done = finish(); !done) return done;
    touched_.reset();
    times_ = DeviceTimes{};
    const std::size_t most =
        static_cast<std::size_t>(engine_.device().capabilities().max_storage_buffer_bytes) / sizeof(ChangedRay);
    for (std::size_t from = 0; from < changes.rays.size(); from += most) {
        const auto some = std::span(changes.rays).subspan(from, std::min(most, changes.rays.size() - from));
        if (const auto sent = submit(some); !sent) return sent;
        if (const auto done = finish(); !done) return done;
    }
    return {};
}

Result<void> DeviceSurface::finish() {
    const auto failed = [&](const Error& error) {
        all_stale_ = true;
        waiting_tiles_.clear();
        under_way_.reset();
        return std::unexpected(error);
    };
    for (;;) {
        if (under_way_) {
            if (const auto settled = settle(); !settled) return failed(settled.error());
        }
        if (all_stale_) {
            if (const auto sent = engine_.synchronize(); !sent) return failed(sent.error());
            waiting_tiles_.resize(grid_.count());
            std::iota(waiting_tiles_.rbegin(), waiting_tiles_.rend(), 0u);  // taken from the back
            all_stale_ = false;
        }
        if (waiting_tiles_.empty() && !engine_.deferred_left()) return {};
        if (const auto sent = submit({}); !sent) return failed(sent.error());
    }
}

// What there is to do: a pass of the engine, changes that the host knows, tiles that wait.
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
    auto commands = gpu::Commands::begin(device);
    if (!commands) return std::unexpected(commands.error());
    stamps_[0] = commands->stamp();
    cut_under_way_ = engine_.deferred_left();
    if (cut_under_way_) engine_.record_pass(*commands);
    stamps_[1] = commands->stamp();
    send_counters(*commands);
    if (!host_changes.empty()) {
        host_changes_.send(*commands, host_changes.size_bytes());
        host_counters_.send(*commands, sizeof(CutCounters));
    }
    commands->barrier();
    if (cut_under_way_) {
        record_mesh(*commands, &engine_.counters(), &engine_.changed_rays(), engine_.passed_rays());
    } else if (!host_changes.empty()) {
        record_mesh(*commands, &host_counters_.buffer(), &host_changes_.buffer(),
                    static_cast<std::uint32_t>(host_changes.size()));
    } else if (sent_tiles_ > 0) {
        record_mesh(*commands, nullptr, nullptr, 0);
    }
    stamps_[2] = commands->stamp();
    if (touched_) record_gather(*commands, *touched_);
    stamps_[3] = commands->stamp();
    commands->barrier();
    counters_.fetch(*commands, sizeof(MeshCounters));
    auto submission = std::move(*commands).submit();
    if (!submission) return std::unexpected(submission.error());
    under_way_.emplace(std::move(*submission));
    ++counts_.submissions;
    return {};
}

// The tiles that wait are the first to be meshed, as many as there are slots.
void DeviceSurface::send_counters(gpu::Commands& commands) {
    sent_tiles_ = static_cast<std::uint32_t>(std::min<std::size_t>(waiting_tiles_.size(), options_.slots));
    std::copy_n(waiting_tiles_.rbegin(), sent_tiles_, dirty_.to_device<std::uint32_t>().begin());
    waiting_tiles_.resize(waiting_tiles_.size() - sent_tiles_);
    MeshCounters counters{};
    counters.tile_groups[0] = counters.tiles = sent_tiles_;
    for (std::uint32_t* groups : {counters.tile_groups, counters.edge_groups, counters.cell_groups,
                                  counters.hard_groups, counters.fan_groups}) {
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
                                          tables_};
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
                            kFans = offsetof(MeshCounters, fan_groups);
    const std::pair<Stage, std::uint64_t> order[] = {{tiles, kTiles},        {edges, kEdges},  {pieces, kCells},
                                                     {sizes, kTiles},        {places, kTiles}, {vertex_stage, kCells},
                                                     {hard_vertices, kHard}, {quads, kEdges},  {fans, kFans}};
    for (const auto& [stage, groups] : order) {
        commands.dispatch_indirect(stages_[stage], buffers, gpu::bytes_of(p), counters_.buffer(), groups);
        commands.barrier();
    }
}

// Takes in what the device has counted, when it is done, and grows what was too small.
Result<void> DeviceSurface::settle() {
    if (const auto waited = under_way_->wait(); !waited) return waited;
    const auto cut = under_way_->seconds_between(stamps_[0], stamps_[1]),
               mesh = under_way_->seconds_between(stamps_[1], stamps_[2]),
               gather = under_way_->seconds_between(stamps_[2], stamps_[3]);
    if (!cut || !mesh || !gather) times_.reset();
    if (times_) times_ = DeviceTimes{times_->cut_s + *cut, times_->mesh_s + *mesh, times_->gather_s + *gather};
    under_way_.reset();
    if (cut_under_way_) {
        if (const auto ended = engine_.end_pass(); !ended) return ended;
    }
    const MeshCounters counters = counters_.from_device<MeshCounters>()[0];
    counts_.tiles += std::min(counters.tiles, options_.slots) - std::min(counters.waiting, counters.tiles);
    counts_.cells += std::min(counters.cells, options_.cells);
    counts_.triangles += counters.triangles;
    vertices_used_ = std::min(counters.vertices_used, options_.vertices);
    indices_used_ = std::min(counters.indices_used, options_.indices);
    const auto late = read_buffer<std::uint32_t>(engine_.device(), waiting_, counters.waiting);  // rarely any
    if (!late) return std::unexpected(late.error());
    waiting_tiles_.insert(waiting_tiles_.end(), late->begin(), late->end());
    return grow(counters);
}

Result<void> DeviceSurface::grow(const MeshCounters& counters) {
    gpu::Device& device = engine_.device();
    const auto grow_list = [&](gpu::Buffer& list, std::size_t element_bytes, std::uint32_t& held, std::uint32_t wanted,
                               const char* name) -> Result<void> {
        if (wanted <= held) return {};
        const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes / element_bytes;
        const auto more = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted + wanted / 2, limit));
        if (more == held) {  // all that a binding shows: fewer tiles at once
            options_.slots = std::max(1u, options_.slots / 2);
            return {};
        }
        ++counts_.growths;
        held = more;
        return create_into(list, device, gpu::BufferUse::device_storage, more * element_bytes, name);
    };
    auto done = grow_list(cells_, sizeof(shared::MeshCell), options_.cells, counters.cells, "cells");
    if (done) done = grow_list(edges_, sizeof(shared::MeshEdge), options_.edges, counters.edges, "crossed edges");
    if (done && counters.vertices_used > options_.vertices) {
        std::uint32_t members = options_.vertices;
        done = grow_pool(members_, kMemberBytes, members, counters.vertices_used, "vertex numbers");
        if (done) {
            done = grow_pool(vertices_, sizeof(SurfaceVertex), options_.vertices, counters.vertices_used, "vertices");
        }
    }
    if (done && counters.indices_used > options_.indices) {
        done = grow_pool(indices_, sizeof(std::uint32_t), options_.indices, counters.indices_used, "indices");
    }
    return done;
}

// Larger, with what it holds.
Result<void> DeviceSurface::grow_pool(gpu::Buffer& pool, std::size_t element_bytes, std::uint32_t& held,
                                      std::uint32_t wanted, const char* name) {
    gpu::Device& device = engine_.device();
    const std::uint32_t more = wanted + wanted / 2;
    gpu::Buffer larger;
    if (const auto made = create_into(larger, device, gpu::BufferUse::addressed, more * element_bytes, name); !made) {
        return made;
    }
    auto commands = gpu::Commands::begin(device);
    if (!commands) return std::unexpected(commands.error());
    const std::uint64_t bytes = held * element_bytes;
    commands->copy(pool, 0, larger, 0, bytes);
    commands->fill(larger, bytes, larger.size_bytes() - bytes, 0);
    commands->keep_alive(std::exchange(pool, std::move(larger)));
    auto submission = std::move(*commands).submit();
    if (!submission) return std::unexpected(submission.error());
    ++counts_.growths;
    held = more;
    return {};
}

// ---- Near the tool

void DeviceSurface::record_gather(gpu::Commands& commands, const Ball& ball) {
    GatherParameters p{};
    p.vertex_address = vertices_.address();
    p.index_address = indices_.address();
    p.member_address = members_.address();
    p.radius_m = static_cast<float>(ball.radius_m);
    p.stamp = ++stamp_;
    p.spacing_m = static_cast<float>(lattice_.spacing_m);
    const Vec3 center = ball.center_object - lattice_.origin_object;
    const double tile_m = lattice_.spacing_m * kTileCells;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        p.center[k] = center[a];
        p.center_float[k] = static_cast<float>(center[a]);
        p.tiles[k] = grid_.tiles[k];
        // A tile's triangles reach up to two cells beyond its own.
        const double last = grid_.tiles[k] - 1, reach = ball.radius_m + 2.0 * lattice_.spacing_m;
        p.from[k] = static_cast<int>(std::clamp(std::floor((center[a] - reach) / tile_m), 0.0, last));
        p.count[k] = static_cast<int>(std::clamp(std::floor((center[a] + reach) / tile_m), 0.0, last)) - p.from[k] + 1;
    }
    const std::array<gpu::BufferRange, 4> buffers{counters_.buffer(), ranges_, ball_places_.buffer(),
                                                  ball_triangles_.buffer()};
    const auto groups = static_cast<std::uint32_t>(p.count[0] * p.count[1] * p.count[2]);
    commands.dispatch(stages_[Stage::ball], buffers, gpu::bytes_of(p), {groups, 1, 1});
    commands.barrier();
    constexpr std::uint32_t kCornerGroups = 64;
    commands.dispatch(stages_[corners], buffers, gpu::bytes_of(p), {kCornerGroups, 1, 1});
    commands.barrier();
    ball_places_.fetch(commands, ball_places_.size_bytes());
    ball_triangles_.fetch(commands, ball_triangles_.size_bytes());
}

Result<void> DeviceSurface::gather_alone(const Ball& ball) {
    touched_ = ball;
    if (const auto sent = submit({}); !sent) return sent;
    return finish();
}

Result<void> DeviceSurface::local_surface(const Vec3& center_object, double radius_m, LocalSurface& out) {
    if (const auto done = finish(); !done) return done;
    for (double radius = radius_m;; radius *= 0.7) {
        if (!touched_ || touched_->center_object != center_object || touched_->radius_m != radius) {
            if (const auto done = gather_alone({center_object, radius}); !done) return done;
        }
        const MeshCounters counters = counters_.from_device<MeshCounters>()[0];
        if (counters.ball_triangles > std::uint32_t{shared::kBallTriangles} ||
            counters.ball_vertices > std::uint32_t{shared::kBallVertices}) {
            continue;
        }
        auto loose = std::make_shared<GriddedTriangles>();
        loose->positions_m.resize(counters.ball_vertices);
        loose->triangles.resize(counters.ball_triangles);
        std::memcpy(loose->positions_m.data(), ball_places_.from_device<Vec3f>().data(),
                    loose->positions_m.size() * sizeof(Vec3f));
        std::memcpy(loose->triangles.data(), ball_triangles_.from_device<std::uint32_t>().data(),
                    loose->triangles.size() * sizeof(loose->triangles[0]));
        build_search(*loose);
        out.center_object = out.origin_object = center_object;
        out.radius_m = radius;
        out.tiles = {};
        out.loose = std::move(loose);
        return {};
    }
}

Result<std::vector<TileMesh>> DeviceSurface::download() {
    if (const auto done = finish(); !done) return std::unexpected(done.error());
    const auto ranges = read_buffer<TileRange>(engine_.device(), ranges_, grid_.count());
    if (!ranges) return std::unexpected(ranges.error());
    const auto vertices = read_buffer<SurfaceVertex>(engine_.device(), vertices_, vertices_used_);
    if (!vertices) return std::unexpected(vertices.error());
    const auto indices = read_buffer<std::uint32_t>(engine_.device(), indices_, indices_used_);
    if (!indices) return std::unexpected(indices.error());
    std::vector<TileMesh> tiles(grid_.count());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const TileRange& range = (*ranges)[t];
        if (range.index_count == 0) continue;
        const auto of_tile = std::span(*vertices).subspan(static_cast<std::size_t>(range.first_vertex), range.vertices);
        const auto corners = std::span(*indices).subspan(range.first_index, range.index_count);
        tiles[t].vertices.assign(of_tile.begin(), of_tile.end());
        tiles[t].indices.assign(corners.begin(), corners.end());
        tiles[t].disagreeing_edges = range.disagreeing;
    }
    return tiles;
}

}  // namespace burin
