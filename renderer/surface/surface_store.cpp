// SPDX-License-Identifier: MIT
#include "renderer/surface/surface_store.hpp"

#include <utility>

#include "renderer/surface/drawn_patches.hpp"

namespace burin::renderer {

void SurfaceStore::set_patch(std::uint32_t id, std::shared_ptr<const geometry::SurfaceTile> surface) {
    patches_.set(id, std::move(surface));
}

void SurfaceStore::set_patch(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                             std::span<const std::uint32_t> indices) {
    auto copy = std::make_shared<geometry::SurfaceTile>();
    copy->vertices.assign(vertices.begin(), vertices.end());
    copy->indices.assign(indices.begin(), indices.end());
    set_patch(id, std::move(copy));
}

void SurfaceStore::set_patch_light(std::uint32_t id, std::span<const geometry::VertexLight> light) {
    patches_.set_light(id, light);
}

Result<std::uint64_t> SurfaceStore::flush(gpu::Commands& commands) {
    commands.barrier();  // waits until the previous frame has read what is now overwritten
    const auto bytes = patches_.flush(device_, commands);
    if (!bytes) return bytes;
    commands.barrier();
    work_.uploads += *bytes > 0 ? 1 : 0;
    work_.uploaded_bytes += *bytes;
    return bytes;
}

std::size_t SurfaceStore::refine(std::size_t most) {
    std::size_t refined = 0;
    for (; refined < most; ++refined) {
        auto job = patches_.next_detail(true);
        if (!job) break;
        std::vector<PatchLevel> levels = job->levels();
        patches_.take({std::move(*job), std::move(levels)});
    }
    work_.detail_jobs += refined;
    return refined;
}

void SurfaceStore::refine_beside(bool resting) {
    constexpr std::size_t kAhead = 512;
    for (DetailDone& done : detail_.take()) {
        const PatchStore::Patch* patch = patches_.take(std::move(done));
        if (patch == nullptr) continue;
        patches_.for_each_picture([&](DrawnPatches& drawn) { drawn.levels_came(*patch); });
    }
    while (detail_.waiting() < kAhead) {
        auto job = patches_.next_group(resting);
        if (!job) job = patches_.next_detail(resting);
        if (!job) break;
        work_.detail_jobs += job->members.empty() ? 1 : 0;  // not those of groups
        detail_.give(std::move(*job));
    }
    const bool all_done = resting && detail_.waiting() == 0;
    patches_.for_each_picture([&](DrawnPatches& drawn) { drawn.levels_are_there(all_done); });
}

}  // namespace burin::renderer
