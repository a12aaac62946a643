// SPDX-License-Identifier: MIT
#include "bench/engines/followed_surface.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace burin::bench {
namespace {

using compute::TileMesh;
using shared::SurfaceVertex;

bool same(const SurfaceVertex& a, const SurfaceVertex& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::string text_of(const SurfaceVertex& v) {
    return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + ", normal " +
           std::to_string(v.normal) + ", colour " + std::to_string(v.colour);
}

void compare(std::uint32_t tile, const TileMesh& held, const TileMesh& right, ComparedSurface& compared) {
    const std::string where = "tile " + std::to_string(tile) + ": ";
    const std::size_t vertices = std::min(held.vertices.size(), right.vertices.size());
    const std::size_t triangles = std::min(held.triangles(), right.triangles());
    compared.elements +=
        std::max(held.vertices.size(), right.vertices.size()) + std::max(held.triangles(), right.triangles());
    const std::uint64_t before = compared.differ;
    for (std::size_t i = 0; i < vertices; ++i) {
        if (same(held.vertices[i], right.vertices[i])) continue;
        if (compared.differ++ == 0)
            compared.first = where + "vertex " + std::to_string(i) + " is " + text_of(held.vertices[i]) +
                             ", the processor's " + text_of(right.vertices[i]);
    }
    for (std::size_t i = 0; i < triangles; ++i)
        compared.differ += std::equal(&right.indices[3 * i], &right.indices[3 * i] + 3, &held.indices[3 * i]) ? 0 : 1;
    compared.differ += std::max(held.vertices.size(), right.vertices.size()) - vertices +
                       std::max(held.triangles(), right.triangles()) - triangles;
    if (compared.differ > before && compared.first.empty())
        compared.first = where + std::to_string(held.vertices.size()) + " vertices and " +
                         std::to_string(held.triangles()) + " triangles, the processor's " +
                         std::to_string(right.vertices.size()) + " and " + std::to_string(right.triangles());
}

}  // namespace

FollowedSurface::FollowedSurface(const compute::Solid& solid, WorkerPool& pool)
    : pool_(pool), by_device_(solid.lattice), by_processor_(solid.lattice) {
    by_processor_.mesh_all(solid, pool_);
    by_device_ = by_processor_;
}

ComparedSurface FollowedSurface::follow(const compute::Solid& solid, const compute::Delta& delta) {
    by_device_.update(solid, delta.changes, pool_, delta.made ? &*delta.made : nullptr);
    by_processor_.update(solid, delta.changes, pool_);
    ComparedSurface compared;
    for (const std::uint32_t tile : by_processor_.changed_tiles())
        compare(tile, by_device_.tile(tile), by_processor_.tile(tile), compared);
    // Counts a difference once: later updates would find it again.
    if (compared.differ > 0) by_device_ = by_processor_;
    return compared;
}

void FollowedSurface::follow(const compute::Solid& solid, const compute::Changes& changes) {
    by_processor_.update(solid, changes, pool_);
    by_device_.update(solid, changes, pool_);
}

}  // namespace burin::bench
