// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <meshoptimizer.h>

namespace burin::renderer {
namespace {

using shared::SurfaceVertex;

// A group's side in edges of triangles: four patches.
constexpr double kSide = 64.0;
// Largest displacement of the surface for each level, in edge lengths.
constexpr std::array<double, 4> kGroupErrors{0.1, 0.25, 0.6, 1.5};
constexpr double kGroupWorthIt = 0.8;  // share of the level before: one with more triangles is left out

// The patches of a group as one mesh, in which equal vertices of neighbours are one.
struct Union {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> places;  // of each vertex in the store's buffer
    std::vector<std::uint32_t> indices;
};

Union united(std::span<const GroupMember> members) {
    Union all;
    for (const GroupMember& member : members) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        const std::vector<SurfaceVertex>& own = member.surface->vertices;
        all.vertices.insert(all.vertices.end(), own.begin(), own.end());
        for (std::uint32_t i = 0; i < own.size(); ++i) all.places.push_back(member.first_vertex + i);
        for (const std::uint32_t i : member.surface->indices) all.indices.push_back(first + i);
    }
    if (all.vertices.empty()) return all;
    std::vector<std::uint32_t> first_equal(all.vertices.size()), remap(all.vertices.size());
    const std::size_t different = meshopt_generateVertexRemap(
        remap.data(), nullptr, all.vertices.size(), all.vertices.data(), all.vertices.size(), sizeof(SurfaceVertex));
    std::vector<std::uint32_t> one(different, UINT32_MAX);
    for (std::uint32_t i = 0; i < all.vertices.size(); ++i) {
        one[remap[i]] = std::min(one[remap[i]], i);
        first_equal[i] = one[remap[i]];
    }
    for (std::uint32_t& i : all.indices) i = first_equal[i];
    return all;
}

}  // namespace

std::vector<PatchLevel> group_levels(std::span<const GroupMember> members, double edge_m) {
    std::vector<PatchLevel> levels;
    const Union all = united(members);
    if (all.indices.empty() || !(edge_m > 0.0)) return levels;
    std::vector<std::vector<std::uint32_t>> parts = by_colour(all.vertices, all.indices);
    std::size_t before = all.indices.size();
    double error_m = 0.0;
    for (const double error : kGroupErrors) {
        PatchLevel level{.indices = parts.front()};
        for (std::size_t i = 1; i < parts.size(); ++i) {
            parts[i] = simplified(parts[i], all.vertices, (error - error_m / edge_m) * edge_m);
            level.indices.insert(level.indices.end(), parts[i].begin(), parts[i].end());
        }
        error_m = error * edge_m;
        if (static_cast<double>(level.indices.size()) > kGroupWorthIt * static_cast<double>(before)) continue;
        before = level.indices.size();
        for (std::uint32_t& i : level.indices) i = all.places[i];
        level.smooth = level.indices.size();
        level.error_m = error_m;
        levels.push_back(std::move(level));
    }
    return levels;
}

PatchGroup& PatchGroups::of(const PatchShape& shape) {
    if (side_m_ <= 0.0) side_m_ = kSide * std::max(shape.edge_m, 1e-9);
    GroupPlace place{};
    for (int i = 0; i < 3; ++i)
        place[static_cast<std::size_t>(i)] =
            static_cast<std::int32_t>(std::clamp(std::floor(shape.center[i] / side_m_), -1e9, 1e9));
    return groups_[place];
}

}  // namespace burin::renderer
