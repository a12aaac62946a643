// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_store.hpp"

#include <algorithm>
#include <utility>

#include "renderer/surface/patch_change.hpp"

namespace burin {

namespace {

// Ranges are rounded up so that a patch that grows by a few triangles keeps its place; padding indices are all the same
// vertex, triangles without area.
constexpr std::uint32_t kVertexStep = 32;
constexpr std::uint32_t kIndexStep = 96;
constexpr std::uint64_t kRestingFlushes = 12;  // after so many frames without a change a patch is worth its levels

std::uint32_t round_up(std::size_t count, std::uint32_t step) {
    return static_cast<std::uint32_t>((count + step - 1) / step * step);
}

struct ElementKind {
    gpu::BufferUse use;
    std::uint64_t bytes;
};
constexpr ElementKind kVertexKind{gpu::BufferUse::vertex, sizeof(shared::SurfaceVertex)};
constexpr ElementKind kLightKind{gpu::BufferUse::vertex, sizeof(VertexLight)};
constexpr ElementKind kIndexKind{gpu::BufferUse::index, sizeof(std::uint32_t)};
constexpr std::uint32_t kFirstVertices = 1 << 16, kFirstIndices = 3 << 17;

// A larger buffer with what was in the old one.
Result<void> enlarge(gpu::Device& device, gpu::Commands& commands, gpu::Buffer& buffer, const ElementKind& kind,
                     std::uint64_t capacity) {
    auto larger = gpu::Buffer::create(device, kind.use, capacity * kind.bytes, "surface");
    if (!larger) return std::unexpected(larger.error());
    if (buffer.size_bytes() > 0) {
        commands.barrier();
        commands.copy(buffer, 0, *larger, 0, buffer.size_bytes());
        commands.barrier();
        commands.keep_alive(std::move(buffer));
    }
    buffer = std::move(*larger);
    return {};
}

// By doubling, and at the last step to what a buffer may hold.
std::uint64_t grown_capacity(const gpu::Device& device, const RangeAllocator& ranges, std::uint64_t first,
                             std::uint64_t more, const ElementKind& kind) {
    const std::uint64_t needed = ranges.capacity() + more;
    const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes / kind.bytes;
    std::uint64_t capacity = std::max<std::uint64_t>(first, ranges.capacity());
    while (capacity < needed) capacity *= 2;
    return capacity > limit && needed <= limit ? limit : capacity;
}

}  // namespace

void PatchStore::set(std::uint32_t id, std::shared_ptr<const SurfaceTile> surface) {
    pending_light_.erase(id);
    if (!surface || surface->indices.empty()) {
        pending_[id] = {};
        return;
    }
    const auto inside = [&](std::uint32_t i) { return i < surface->vertices.size(); };
    const bool whole = surface->indices.size() % 3 == 0 && std::ranges::all_of(surface->indices, inside);
    BURIN_CHECK(whole);
    pending_[id] = {whole ? std::move(surface) : nullptr, {}};
}

void PatchStore::set_light(std::uint32_t id, std::span<const VertexLight> light) {
    if (const auto coming = pending_.find(id); coming != pending_.end()) {
        coming->second.light.assign(light.begin(), light.end());
    } else {
        pending_light_[id].assign(light.begin(), light.end());
    }
}

void PatchStore::clear() {
    pending_.clear();
    pending_light_.clear();
    cleared_ = true;
}

void PatchStore::release_levels(Patch& patch, std::size_t keep) {
    for (std::size_t i = keep; i < patch.levels.size(); ++i)
        index_ranges_.release(patch.levels[i].first_index, patch.levels[i].index_count);
    patch.levels.resize(keep);
    patch.ready.clear();
    patch.refined = false;
    if (patch.drawn.level >= keep) patch.drawn.level = 0;
}

void PatchStore::release(std::uint32_t id) {
    const auto found = placed_.find(id);
    if (found == placed_.end()) return;
    leave(found->second);
    release_levels(found->second, 0);
    vertex_ranges_.release(found->second.first_vertex, found->second.vertex_count);
    placed_.erase(found);
}

Result<PatchStore::Flushed> PatchStore::flush(gpu::Device& device, gpu::Commands& commands) {
    Flushed flushed;
    bytes_ = 0;
    ++flushes_;
    if (!cleared_ && pending_.empty() && pending_light_.empty() && !levels_ready_) return flushed;
    if (cleared_) {
        if (!bounds_.empty()) flushed.changed.push_back(bounds_);
        placed_.clear();
        in_order_.clear();
        triangles_ = 0;
        measured_ = false;
        vertex_ranges_ = RangeAllocator(vertex_ranges_.capacity());
        index_ranges_ = RangeAllocator(index_ranges_.capacity());
        cleared_ = false;
    }
    std::map<std::uint32_t, Patch> before;
    for (const auto& [id, patch] : pending_) {
        if (const auto known = placed_.find(id); known != placed_.end()) before[id] = known->second;
        release(id);
    }
    Result<void> done = make_room(device, commands);
    for (auto& [id, patch] : pending_) {
        if (!done) break;
        const auto was = before.find(id);
        if (patch.surface) done = place(device, commands, id, patch);
        if (!done) break;
        const auto now = placed_.find(id);
        if (was != before.end() && now != placed_.end()) {
            note_change(was->second, now->second, flushed.changed);
            // It goes on as it was drawn, but for its level.
            now->second.changed_at = flushes_;
            now->second.drawn.rate = was->second.drawn.rate;
            now->second.wanted = true;
        } else if (was != before.end() || now != placed_.end()) {
            flushed.changed.push_back((was != before.end() ? was : now)->second.shape.bounds);
        }
    }
    for (auto& [id, light] : pending_light_) {
        const auto known = placed_.find(id);
        if (!done || known == placed_.end()) continue;
        if (light.size() != known->second.surface->vertices.size() || light == known->second.light) continue;
        Patch& patch = known->second;
        const Patch was = patch;
        if (!patch.light.empty()) patch.changed_at = flushes_;
        patch.light = std::move(light);
        release_levels(patch, 1);
        upload_finest(commands, patch);
        upload_light(commands, patch);
        note_change(was, patch, flushed.changed);
    }
    if (done) done = place_ready_levels(device, commands);
    pending_.clear();
    pending_light_.clear();
    measure();
    if (!done) return std::unexpected(done.error());
    flushed.bytes = bytes_;
    return flushed;
}

void PatchStore::note_change(const Patch& was, const Patch& now, std::vector<Box>& changed) {
    if (was.drawn.level > 0) {  // nearly all triangles were others
        changed.insert(changed.end(), {was.shape.bounds, now.shape.bounds});
        return;
    }
    const auto look = [](const Patch& p) { return PatchLook{p.surface->vertices, p.surface->indices, p.light}; };
    const Box box = changed_bounds(look(was), look(now));
    if (!box.empty()) changed.push_back(box);
}

// Grows at most once for all that is new, instead of by doubling along the way.
Result<void> PatchStore::make_room(gpu::Device& device, gpu::Commands& commands) {
    std::uint64_t vertices = 0, indices = 0;
    for (const auto& [id, patch] : pending_) {
        if (!patch.surface) continue;
        vertices += round_up(patch.surface->vertices.size(), kVertexStep);
        indices += round_up(patch.surface->indices.size(), kIndexStep);
    }
    if (vertices > vertex_ranges_.free_elements()) {
        const std::uint64_t capacity = grown_capacity(device, vertex_ranges_, kFirstVertices,
                                                      vertices - vertex_ranges_.free_elements(), kVertexKind);
        if (const auto done = enlarge(device, commands, vertices_, kVertexKind, capacity); !done) return done;
        if (const auto done = enlarge(device, commands, lights_, kLightKind, capacity); !done) return done;
        vertex_ranges_.grow(static_cast<std::uint32_t>(capacity));
    }
    if (indices > index_ranges_.free_elements()) {
        const std::uint64_t capacity =
            grown_capacity(device, index_ranges_, kFirstIndices, indices - index_ranges_.free_elements(), kIndexKind);
        if (const auto done = enlarge(device, commands, indices_, kIndexKind, capacity); !done) return done;
        index_ranges_.grow(static_cast<std::uint32_t>(capacity));
    }
    return {};
}

Result<void> PatchStore::place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& pending) {
    Patch patch;
    patch.surface = std::move(pending.surface);
    patch.light = std::move(pending.light);
    if (patch.light.size() != patch.surface->vertices.size()) patch.light.clear();
    patch.shape = shape_of(patch.surface->vertices, patch.surface->indices);
    patch.vertex_count = round_up(patch.surface->vertices.size(), kVertexStep);
    auto first = vertex_ranges_.allocate(patch.vertex_count);
    if (!first) {  // the free ranges are too scattered
        const std::uint64_t capacity =
            grown_capacity(device, vertex_ranges_, kFirstVertices, patch.vertex_count, kVertexKind);
        if (const auto done = enlarge(device, commands, vertices_, kVertexKind, capacity); !done) return done;
        if (const auto done = enlarge(device, commands, lights_, kLightKind, capacity); !done) return done;
        vertex_ranges_.grow(static_cast<std::uint32_t>(capacity));
        first = vertex_ranges_.allocate(patch.vertex_count).value();
    }
    patch.first_vertex = *first;
    const auto bytes = std::as_bytes(std::span(patch.surface->vertices));
    commands.upload(vertices_, std::uint64_t{patch.first_vertex} * kVertexKind.bytes, bytes);
    bytes_ += bytes.size();
    upload_light(commands, patch);
    if (const auto done = place_finest(device, commands, patch); !done) {
        vertex_ranges_.release(patch.first_vertex, patch.vertex_count);
        return done;
    }
    enter(placed_.emplace(id, std::move(patch)).first->second);
    return {};
}

void PatchStore::upload_light(gpu::Commands& commands, const Patch& patch) {
    std::vector<VertexLight> light = patch.light;
    light.resize(patch.vertex_count);
    const auto bytes = std::as_bytes(std::span(light));
    commands.upload(lights_, std::uint64_t{patch.first_vertex} * kLightKind.bytes, bytes);
    bytes_ += bytes.size();
}

// A place in the index buffer; nothing where it is full, but not needed.
Result<std::optional<std::uint32_t>> PatchStore::room_for(gpu::Device& device, gpu::Commands& commands,
                                                          std::uint32_t indices, bool needed) {
    if (const auto first = index_ranges_.allocate(indices)) return first;
    const std::uint64_t capacity = grown_capacity(device, index_ranges_, kFirstIndices, indices, kIndexKind);
    if (!needed && capacity * kIndexKind.bytes > device.capabilities().max_storage_buffer_bytes) return std::nullopt;
    if (const auto done = enlarge(device, commands, indices_, kIndexKind, capacity); !done)
        return std::unexpected(done.error());
    index_ranges_.grow(static_cast<std::uint32_t>(capacity));
    return index_ranges_.allocate(indices);
}

Result<void> PatchStore::place_finest(gpu::Device& device, gpu::Commands& commands, Patch& patch) {
    const std::uint32_t count = round_up(patch.surface->indices.size(), kIndexStep);
    const auto first = room_for(device, commands, count, true);
    if (!first) return std::unexpected(first.error());
    patch.levels.push_back({.first_index = **first, .index_count = count});
    upload_finest(commands, patch);
    return {};
}

void PatchStore::upload_finest(gpu::Commands& commands, Patch& patch) {
    const SmoothFirst sorted = smooth_first(patch.surface->vertices, patch.surface->indices, patch.light);
    Level& level = patch.levels.front();
    level.smooth_count =
        sorted.smooth == sorted.indices.size() ? level.index_count : static_cast<std::uint32_t>(sorted.smooth);
    std::vector<std::uint32_t> absolute(level.index_count, patch.first_vertex);
    std::ranges::transform(sorted.indices, absolute.begin(), [&](std::uint32_t i) { return i + patch.first_vertex; });
    upload_indices(commands, level.first_index, absolute);
}

void PatchStore::upload_indices(gpu::Commands& commands, std::uint32_t first, std::span<const std::uint32_t> indices) {
    const auto bytes = std::as_bytes(indices);
    commands.upload(indices_, std::uint64_t{first} * kIndexKind.bytes, bytes);
    bytes_ += bytes.size();
}

Result<void> PatchStore::place_ready(gpu::Device& device, gpu::Commands& commands, Patch& patch) {
    for (PatchLevel& level : std::exchange(patch.ready, {})) {
        const auto count = static_cast<std::uint32_t>(level.indices.size());
        const auto first = room_for(device, commands, count, false);
        if (!first) return std::unexpected(first.error());
        if (!*first) return {};
        patch.levels.push_back({**first, count, static_cast<std::uint32_t>(level.smooth), level.error_m});
        for (std::uint32_t& index : level.indices) index += patch.first_vertex;
        upload_indices(commands, **first, level.indices);
    }
    return {};
}

Result<void> PatchStore::place_ready_levels(gpu::Device& device, gpu::Commands& commands) {
    if (!levels_ready_) return {};
    levels_ready_ = false;
    for (auto& [id, patch] : placed_)
        if (const auto done = place_ready(device, commands, patch); !done) return done;
    return {};
}

std::optional<DetailJob> PatchStore::next_detail(bool resting) {
    const std::size_t count = placed_.size();
    auto at = placed_.lower_bound(refine_from_);
    for (std::size_t seen = 0; seen < count; ++seen, ++at) {
        if (at == placed_.end()) at = placed_.begin();
        Patch& patch = at->second;
        const bool changes = patch.changed_at > 0 && flushes_ < patch.changed_at + kRestingFlushes;
        if (patch.refined || !patch.wanted || (changes && !resting)) continue;
        patch.refined = true;
        refine_from_ = at->first + 1;
        return DetailJob{at->first, patch.surface, patch.light, patch.shape.edge_m};
    }
    return std::nullopt;
}

bool PatchStore::take(DetailDone done) {
    const auto found = placed_.find(done.job.patch);
    if (found == placed_.end()) return false;
    Patch& patch = found->second;
    if (patch.surface != done.job.surface || patch.light != done.job.light || patch.levels.size() > 1) return false;
    patch.ready = std::move(done.levels);
    levels_ready_ = levels_ready_ || !patch.ready.empty();
    return !patch.ready.empty();
}

// ---- What there is

namespace {

std::uint32_t place_of(const PatchStore::Patch* patch) { return patch->levels.front().first_index; }

double farthest_m(const Box& box, const Vec3& from) {
    return glm::length(glm::max(glm::abs(box.lo - from), glm::abs(box.hi - from)));
}

// Without it the bounds could be smaller.
bool holds_open(const Box& bounds, const Box& box) {
    for (int i = 0; i < 3; ++i)
        if (box.lo[i] <= bounds.lo[i] || box.hi[i] >= bounds.hi[i]) return true;
    return false;
}

}  // namespace

void PatchStore::enter(Patch& patch) {
    in_order_.insert(std::ranges::lower_bound(in_order_, place_of(&patch), {}, place_of), &patch);
    triangles_ += patch.surface->triangles();
    const Box before = bounds_;
    bounds_.include(patch.shape.bounds.lo);
    bounds_.include(patch.shape.bounds.hi);
    measured_ = measured_ && bounds_ == before;
    if (measured_) reach_m_ = std::max(reach_m_, farthest_m(patch.shape.bounds, bounds_.center()));
}

void PatchStore::leave(const Patch& patch) {
    in_order_.erase(std::ranges::lower_bound(in_order_, place_of(&patch), {}, place_of));
    triangles_ -= patch.surface->triangles();
    measured_ = measured_ && !holds_open(bounds_, patch.shape.bounds) &&
                farthest_m(patch.shape.bounds, bounds_.center()) < reach_m_;
}

// Seldom: carving takes from the inside of the bounds.
void PatchStore::measure() {
    if (measured_) return;
    measured_ = true;
    bounds_ = {};
    for (const Patch* patch : in_order_) {
        bounds_.include(patch->shape.bounds.lo);
        bounds_.include(patch->shape.bounds.hi);
    }
    reach_m_ = 0.0;
    for (const Patch* patch : in_order_)
        reach_m_ = std::max(reach_m_, farthest_m(patch->shape.bounds, bounds_.center()));
}

}  // namespace burin
