// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_store.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "renderer/surface/drawn_patches.hpp"
#include "renderer/surface/patch_change.hpp"

namespace burin::renderer {

namespace {

// Ranges are rounded up so that a patch that grows by a few triangles stays in place; padding indices all refer to the
// same vertex, which makes triangles without area.
constexpr std::uint32_t kVertexStep = 32;
constexpr std::uint32_t kIndexStep = 96;
constexpr std::uint64_t kRestingFlushes = 12;  // frames without a change after which computing a patch's levels pays

std::uint32_t round_up(std::size_t count, std::uint32_t step) {
    return static_cast<std::uint32_t>((count + step - 1) / step * step);
}

struct ElementKind {
    gpu::BufferUse use;
    std::uint64_t bytes;
};
constexpr ElementKind kVertexKind{gpu::BufferUse::vertex, sizeof(shared::SurfaceVertex)};
constexpr ElementKind kLightKind{gpu::BufferUse::vertex, sizeof(geometry::VertexLight)};
constexpr ElementKind kIndexKind{gpu::BufferUse::index, sizeof(std::uint32_t)};
constexpr std::uint32_t kFirstVertices = 1 << 16, kFirstIndices = 3 << 17;

// Replaces the buffer by a larger one with the same contents.
Result<void> enlarge(gpu::Device& device, gpu::Commands& commands, gpu::Buffer& buffer, const ElementKind& kind,
                     std::uint64_t capacity) {
    BURIN_TRY(larger, gpu::Buffer::create(device, kind.use, capacity * kind.bytes, "surface"));
    if (buffer.size_bytes() > 0) {
        commands.barrier();
        commands.copy(buffer, 0, larger, 0, buffer.size_bytes());
        commands.barrier();
        commands.keep_alive(std::move(buffer));
    }
    buffer = std::move(larger);
    return {};
}

// Returns the capacity after doubling; the last step goes to the device's limit.
std::uint64_t grown_capacity(const gpu::Device& device, const RangeAllocator& ranges, std::uint64_t first,
                             std::uint64_t more, const ElementKind& kind) {
    const std::uint64_t needed = ranges.capacity() + more;
    const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes / kind.bytes;
    std::uint64_t capacity = std::max<std::uint64_t>(first, ranges.capacity());
    while (capacity < needed) capacity *= 2;
    return capacity > limit && needed <= limit ? limit : capacity;
}

}  // namespace

void PatchStore::set(std::uint32_t id, std::shared_ptr<const geometry::SurfaceTile> surface) {
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

void PatchStore::set_light(std::uint32_t id, std::span<const geometry::VertexLight> light) {
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
}

void PatchStore::release(std::uint32_t id) {
    const auto found = placed_.find(id);
    if (found == placed_.end()) return;
    leave(found->second);
    --found->second.group->patches;
    changed_group(*found->second.group);
    release_levels(found->second, 0);
    vertex_ranges_.release(found->second.first_vertex, found->second.vertex_count);
    placed_.erase(found);
}

Result<std::uint64_t> PatchStore::flush(gpu::Device& device, gpu::Commands& commands) {
    bytes_ = 0;
    ++flushes_;
    if (!cleared_ && pending_.empty() && pending_light_.empty() && !levels_ready_) return 0;
    if (std::exchange(cleared_, false)) remove_all();
    Result<void> done = place_pending(device, commands);
    if (done) relight_pending(commands);
    if (done) done = place_ready_levels(device, commands);
    pending_.clear();
    pending_light_.clear();
    measure();
    if (!done) return std::unexpected(done.error());
    return bytes_;
}

void PatchStore::remove_all() {
    for_each_picture([&](DrawnPatches& drawn) { drawn.all_removed(bounds_); });
    placed_.clear();
    groups_.clear();
    in_order_.clear();
    triangles_ = 0;
    measured_ = false;
    vertex_ranges_ = RangeAllocator(vertex_ranges_.capacity());
    index_ranges_ = RangeAllocator(index_ranges_.capacity());
    slots_ = 0;
    free_slots_.clear();
}

Result<void> PatchStore::place_pending(gpu::Device& device, gpu::Commands& commands) {
    std::map<std::uint32_t, Patch> before;
    for (const auto& [id, patch] : pending_) {
        if (const auto known = placed_.find(id); known != placed_.end()) before[id] = known->second;
        release(id);
    }
    Result<void> done = make_room(device, commands);
    for (auto& [id, patch] : pending_) {
        if (!done) break;
        const auto was = before.find(id);
        const bool known = was != before.end();
        if (patch.surface)
            done = place(device, commands, id, patch, known ? std::optional(was->second.slot) : std::nullopt);
        if (!done) break;
        const auto now = placed_.find(id);
        if (known && now != placed_.end()) {
            report_change(was->second, now->second, true);
            now->second.changed_at = flushes_;
        } else if (known || now != placed_.end()) {
            const Box& bounds = (known ? was : now)->second.shape.bounds;
            for_each_picture([&](DrawnPatches& drawn) { drawn.appeared_or_vanished(bounds); });
        }
    }
    for (const auto& [id, patch] : before)
        if (!placed_.contains(id)) free_slots_.push_back(patch.slot);
    return done;
}

void PatchStore::relight_pending(gpu::Commands& commands) {
    for (auto& [id, light] : pending_light_) {
        const auto known = placed_.find(id);
        if (known == placed_.end()) continue;
        if (light.size() != known->second.surface->vertices.size() || light == known->second.light) continue;
        Patch& patch = known->second;
        const Patch was = patch;
        if (!patch.light.empty()) patch.changed_at = flushes_;
        patch.light = std::move(light);
        release_levels(patch, 1);
        upload_finest(commands, patch);
        upload_light(commands, patch);
        report_change(was, patch, false);
    }
}

void PatchStore::report_change(const Patch& was, const Patch& now, bool replaced) const {
    const auto look = [](const Patch& p) { return PatchLook{p.surface->vertices, p.surface->indices, p.light}; };
    const Box changed = changed_bounds(look(was), look(now));
    for_each_picture([&](DrawnPatches& drawn) { drawn.changed({was, now, changed, replaced}); });
}

void PatchStore::for_each_picture(const std::function<void(DrawnPatches&)>& report) const {
    for (DrawnPatches* drawn : pictures_) report(*drawn);
}

std::uint32_t PatchStore::take_slot() {
    std::uint32_t slot = slots_;
    if (free_slots_.empty()) {
        ++slots_;
    } else {
        slot = free_slots_.back();
        free_slots_.pop_back();
    }
    for_each_picture([&](DrawnPatches& drawn) { drawn.slot_taken(slot); });
    return slot;
}

// Grows the buffers at most once for all new patches, instead of doubling along the way.
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
        BURIN_TRY_DO(enlarge(device, commands, vertices_, kVertexKind, capacity));
        BURIN_TRY_DO(enlarge(device, commands, lights_, kLightKind, capacity));
        vertex_ranges_.grow(static_cast<std::uint32_t>(capacity));
    }
    if (indices > index_ranges_.free_elements()) {
        const std::uint64_t capacity =
            grown_capacity(device, index_ranges_, kFirstIndices, indices - index_ranges_.free_elements(), kIndexKind);
        BURIN_TRY_DO(enlarge(device, commands, indices_, kIndexKind, capacity));
        index_ranges_.grow(static_cast<std::uint32_t>(capacity));
    }
    return {};
}

Result<void> PatchStore::place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& pending,
                               std::optional<std::uint32_t> slot) {
    Patch patch;
    patch.surface = std::move(pending.surface);
    patch.light = std::move(pending.light);
    if (patch.light.size() != patch.surface->vertices.size()) patch.light.clear();
    patch.shape = shape_of(patch.surface->vertices, patch.surface->indices);
    patch.vertex_count = round_up(patch.surface->vertices.size(), kVertexStep);
    auto first = vertex_ranges_.allocate(patch.vertex_count);
    if (!first) {  // the free ranges are too fragmented
        const std::uint64_t capacity =
            grown_capacity(device, vertex_ranges_, kFirstVertices, patch.vertex_count, kVertexKind);
        BURIN_TRY_DO(enlarge(device, commands, vertices_, kVertexKind, capacity));
        BURIN_TRY_DO(enlarge(device, commands, lights_, kLightKind, capacity));
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
    patch.slot = slot ? *slot : take_slot();
    patch.group = &groups_.of(patch.shape);
    ++patch.group->patches;
    changed_group(*patch.group);
    enter(placed_.emplace(id, std::move(patch)).first->second);
    return {};
}

void PatchStore::upload_light(gpu::Commands& commands, const Patch& patch) {
    std::vector<geometry::VertexLight> light = patch.light;
    light.resize(patch.vertex_count);
    const auto bytes = std::as_bytes(std::span(light));
    commands.upload(lights_, std::uint64_t{patch.first_vertex} * kLightKind.bytes, bytes);
    bytes_ += bytes.size();
}

// Allocates a range in the index buffer; nullopt where the buffer is full and the range is not needed.
Result<std::optional<std::uint32_t>> PatchStore::room_for(gpu::Device& device, gpu::Commands& commands,
                                                          std::uint32_t indices, bool needed) {
    if (const auto first = index_ranges_.allocate(indices)) return first;
    const std::uint64_t capacity = grown_capacity(device, index_ranges_, kFirstIndices, indices, kIndexKind);
    if (!needed && capacity * kIndexKind.bytes > device.capabilities().max_storage_buffer_bytes) return std::nullopt;
    BURIN_TRY_DO(enlarge(device, commands, indices_, kIndexKind, capacity));
    index_ranges_.grow(static_cast<std::uint32_t>(capacity));
    return index_ranges_.allocate(indices);
}

Result<void> PatchStore::place_finest(gpu::Device& device, gpu::Commands& commands, Patch& patch) {
    const std::uint32_t count = round_up(patch.surface->indices.size(), kIndexStep);
    BURIN_TRY(first, room_for(device, commands, count, true));
    patch.levels.push_back({.first_index = *first, .index_count = count});
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
        BURIN_TRY(first, room_for(device, commands, count, false));
        if (!first) return {};
        patch.levels.push_back({*first, count, static_cast<std::uint32_t>(level.smooth), level.error_m});
        for (std::uint32_t& index : level.indices) index += patch.first_vertex;
        upload_indices(commands, *first, level.indices);
    }
    return {};
}

Result<void> PatchStore::place_ready_levels(gpu::Device& device, gpu::Commands& commands) {
    if (!levels_ready_) return {};
    levels_ready_ = false;
    for (auto& [id, patch] : placed_) BURIN_TRY_DO(place_ready(device, commands, patch));
    return place_ready_groups(device, commands);
}

std::optional<DetailJob> PatchStore::next_detail(bool resting) {
    const std::size_t count = placed_.size();
    auto at = placed_.lower_bound(refine_from_);
    for (std::size_t seen = 0; seen < count; ++seen, ++at) {
        if (at == placed_.end()) at = placed_.begin();
        Patch& patch = at->second;
        const bool changes = patch.changed_at > 0 && flushes_ < patch.changed_at + kRestingFlushes;
        if (patch.refined || (changes && !resting) || !wanted(patch)) continue;
        patch.refined = true;
        refine_from_ = at->first + 1;
        return DetailJob{at->first, patch.surface, patch.light, patch.shape.edge_m};
    }
    return std::nullopt;
}

bool PatchStore::wanted(const Patch& patch) const {
    return std::ranges::any_of(pictures_, [&](const DrawnPatches* drawn) { return drawn->of(patch).wanted; });
}

const PatchStore::Patch* PatchStore::take(DetailDone done) {
    if (!done.job.members.empty()) {
        take_group(std::move(done));
        return nullptr;
    }
    const auto found = placed_.find(done.job.patch);
    if (found == placed_.end()) return nullptr;
    Patch& patch = found->second;
    if (patch.surface != done.job.surface || patch.light != done.job.light || patch.levels.size() > 1) return nullptr;
    patch.ready = std::move(done.levels);
    levels_ready_ = levels_ready_ || !patch.ready.empty();
    return patch.ready.empty() ? nullptr : &patch;
}

// ---- Groups

// Drops the levels of a group, one of whose patches has another mesh.
void PatchStore::changed_group(PatchGroup& group) {
    for (const PatchGroup::Level& level : group.levels) index_ranges_.release(level.first_index, level.index_count);
    group.levels.clear();
    group.ready.clear();
    ++group.version;
    group.changed_at = flushes_;
}

std::optional<DetailJob> PatchStore::next_group(bool resting) {
    for (auto& [place, group] : groups_.all()) {
        const bool changes = flushes_ < group.changed_at + kRestingFlushes;
        if (group.patches == 0 || group.asked == group.version || (changes && !resting)) continue;
        group.asked = group.version;
        DetailJob job;
        job.group = place;
        job.version = group.version;
        Box bounds;
        for (const auto& [id, patch] : placed_) {
            if (patch.group != &group) continue;
            job.members.push_back({patch.surface, patch.first_vertex});
            job.edge_m = std::max(job.edge_m, patch.shape.edge_m);
            bounds.include(patch.shape.bounds.lo);
            bounds.include(patch.shape.bounds.hi);
        }
        group.shape = {.bounds = bounds, .center = bounds.center(), .radius_m = 0.5 * glm::length(bounds.extent())};
        return job;
    }
    return std::nullopt;
}

void PatchStore::take_group(DetailDone done) {
    const auto found = groups_.all().find(done.job.group);
    if (found == groups_.all().end() || found->second.version != done.job.version) return;
    found->second.ready = std::move(done.levels);
    levels_ready_ = levels_ready_ || !found->second.ready.empty();
}

Result<void> PatchStore::place_ready_groups(gpu::Device& device, gpu::Commands& commands) {
    for (auto& [place, group] : groups_.all()) {
        for (const PatchLevel& level : std::exchange(group.ready, {})) {
            const auto count = static_cast<std::uint32_t>(level.indices.size());
            BURIN_TRY(first, room_for(device, commands, count, false));
            if (!first) break;
            group.levels.push_back({*first, count, level.error_m});
            upload_indices(commands, *first, level.indices);
        }
    }
    return {};
}

// ---- Order, bounds and counts

namespace {

std::uint32_t place_of(const PatchStore::Patch* patch) { return patch->levels.front().first_index; }

double farthest_m(const Box& box, const Vec3& from) {
    return glm::length(glm::max(glm::abs(box.lo - from), glm::abs(box.hi - from)));
}

// Returns whether the bounds would shrink without the box.
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

// Recomputes bounds_ and reach_m_. Rarely needed: carving removes from the inside of the bounds.
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

}  // namespace burin::renderer
