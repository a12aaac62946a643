// SPDX-License-Identifier: MIT
#include "renderer/patch_store.hpp"

#include <algorithm>

namespace burin {

namespace {

// Ranges are rounded up so that a patch that grows by a few triangles keeps its place; padding indices are all the same
// vertex, triangles without area.
constexpr std::uint32_t kVertexStep = 32;
constexpr std::uint32_t kIndexStep = 96;

std::uint32_t round_up(std::size_t count, std::uint32_t step) {
    return static_cast<std::uint32_t>((count + step - 1) / step * step);
}

Box bounds_of(std::span<const shared::SurfaceVertex> vertices) {
    Box box;
    for (const shared::SurfaceVertex& v : vertices) box.include({v.x, v.y, v.z});
    return box;
}

struct ElementKind {
    gpu::BufferUse use;
    std::uint64_t bytes;
    std::uint32_t first_capacity;
};
constexpr ElementKind kVertexKind{gpu::BufferUse::vertex, sizeof(shared::SurfaceVertex), 1 << 16};
constexpr ElementKind kIndexKind{gpu::BufferUse::index, sizeof(std::uint32_t), 3 << 17};

// Makes room for `more` elements in one run at the end, and moves what is there.
Result<void> grow(gpu::Device& device, gpu::Commands& commands, RangeAllocator& ranges, gpu::Buffer& buffer,
                  const ElementKind& kind, std::uint64_t more) {
    const std::uint64_t needed = ranges.capacity() + more;
    const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes / kind.bytes;
    std::uint64_t capacity = std::max<std::uint64_t>(kind.first_capacity, ranges.capacity());
    while (capacity < needed) capacity *= 2;
    if (capacity > limit && needed <= limit) capacity = limit;  // the last step, to the limit itself
    auto larger = gpu::Buffer::create(device, kind.use, capacity * kind.bytes, "surface");
    if (!larger) return std::unexpected(larger.error());
    if (buffer.size_bytes() > 0) {
        commands.barrier();
        commands.copy(buffer, 0, *larger, 0, buffer.size_bytes());
        commands.barrier();
        commands.keep_alive(std::move(buffer));
    }
    buffer = std::move(*larger);
    ranges.grow(static_cast<std::uint32_t>(capacity));
    return {};
}

// Takes a range, growing the buffer where the free ranges are too scattered.
Result<std::uint32_t> take(gpu::Device& device, gpu::Commands& commands, RangeAllocator& ranges, gpu::Buffer& buffer,
                           const ElementKind& kind, std::uint32_t size) {
    if (const auto first = ranges.allocate(size)) return *first;
    if (const auto grown = grow(device, commands, ranges, buffer, kind, size); !grown) {
        return std::unexpected(grown.error());
    }
    return ranges.allocate(size).value();
}

}  // namespace

void PatchStore::set(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                     std::span<const std::uint32_t> indices) {
    const auto inside = [&](std::uint32_t i) { return i < vertices.size(); };
    const bool whole = indices.size() % 3 == 0 && std::ranges::all_of(indices, inside);
    BURIN_CHECK(whole);
    if (!whole || indices.empty()) return remove(id);
    pending_[id] = {{vertices.begin(), vertices.end()}, {indices.begin(), indices.end()}};
}

void PatchStore::remove(std::uint32_t id) { pending_[id] = {}; }

void PatchStore::clear() {
    pending_.clear();
    cleared_ = true;
}

void PatchStore::release(std::uint32_t id) {
    const auto found = placed_.find(id);
    if (found == placed_.end()) return;
    vertex_ranges_.release(found->second.first_vertex, found->second.vertex_count);
    index_ranges_.release(found->second.first_index, found->second.index_count);
    placed_.erase(found);
}

Result<std::uint64_t> PatchStore::flush(gpu::Device& device, gpu::Commands& commands) {
    if (!cleared_ && pending_.empty()) return std::uint64_t{0};
    if (cleared_) {
        placed_.clear();
        vertex_ranges_ = RangeAllocator(vertex_ranges_.capacity());
        index_ranges_ = RangeAllocator(index_ranges_.capacity());
        cleared_ = false;
    }
    for (const auto& [id, patch] : pending_) release(id);
    std::uint64_t bytes = 0;
    Result<void> placed = make_room(device, commands);
    for (auto& [id, patch] : pending_) {
        if (!placed) break;
        if (patch.vertices.empty()) continue;
        placed = place(device, commands, id, patch);
        if (!placed) break;
        bytes += std::as_bytes(std::span(patch.vertices)).size() + std::as_bytes(std::span(patch.indices)).size();
    }
    pending_.clear();
    list_draws();
    if (!placed) return std::unexpected(placed.error());
    return bytes;
}

// Grows at most once for all that is new, instead of by doubling along the way.
Result<void> PatchStore::make_room(gpu::Device& device, gpu::Commands& commands) {
    std::uint64_t vertices = 0, indices = 0;
    for (const auto& [id, patch] : pending_) {
        vertices += round_up(patch.vertices.size(), kVertexStep);
        indices += round_up(patch.indices.size(), kIndexStep);
    }
    Result<void> done;
    if (vertices > vertex_ranges_.free_elements()) {
        done =
            grow(device, commands, vertex_ranges_, vertices_, kVertexKind, vertices - vertex_ranges_.free_elements());
    }
    if (done && indices > index_ranges_.free_elements()) {
        done = grow(device, commands, index_ranges_, indices_, kIndexKind, indices - index_ranges_.free_elements());
    }
    return done;
}

Result<void> PatchStore::place(gpu::Device& device, gpu::Commands& commands, std::uint32_t id, Pending& patch) {
    Placed p;
    p.vertex_count = round_up(patch.vertices.size(), kVertexStep);
    p.index_count = round_up(patch.indices.size(), kIndexStep);
    p.triangles = patch.indices.size() / 3;
    p.bounds = bounds_of(patch.vertices);
    const auto first_vertex = take(device, commands, vertex_ranges_, vertices_, kVertexKind, p.vertex_count);
    if (!first_vertex) return std::unexpected(first_vertex.error());
    const auto first_index = take(device, commands, index_ranges_, indices_, kIndexKind, p.index_count);
    if (!first_index) {
        vertex_ranges_.release(*first_vertex, p.vertex_count);
        return std::unexpected(first_index.error());
    }
    p.first_vertex = *first_vertex;
    p.first_index = *first_index;
    for (std::uint32_t& index : patch.indices) index += p.first_vertex;
    patch.indices.resize(p.index_count, p.first_vertex);
    commands.upload(vertices_, std::uint64_t{p.first_vertex} * sizeof(shared::SurfaceVertex),
                    std::as_bytes(std::span(patch.vertices)));
    commands.upload(indices_, std::uint64_t{p.first_index} * sizeof(std::uint32_t),
                    std::as_bytes(std::span(patch.indices)));
    placed_.emplace(id, p);
    return {};
}

void PatchStore::list_draws() {
    draws_.clear();
    triangles_ = 0;
    bounds_ = {};
    for (const auto& [id, p] : placed_) {
        draws_.push_back({p.first_index, p.index_count});
        triangles_ += p.triangles;
        bounds_.include(p.bounds.lo);
        bounds_.include(p.bounds.hi);
    }
    reach_m_ = 0.0;
    for (const auto& [id, p] : placed_) {
        const Vec3 center = bounds_.center();
        const Vec3 farthest = glm::max(glm::abs(p.bounds.lo - center), glm::abs(p.bounds.hi - center));
        reach_m_ = std::max(reach_m_, glm::length(farthest));
    }
    std::ranges::sort(draws_, {}, &DrawRange::first_index);
    std::vector<DrawRange> merged;
    for (const DrawRange& range : draws_) {
        if (!merged.empty() && merged.back().first_index + merged.back().index_count == range.first_index) {
            merged.back().index_count += range.index_count;
        } else {
            merged.push_back(range);
        }
    }
    draws_ = std::move(merged);
}

}  // namespace burin
