// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_change.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <vector>

namespace burin::renderer {
namespace {

// Hashes to 64 bits, so that the probability that any two triangles of a patch collide is one in 10^13.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 29);
}

struct Triangle {
    std::uint64_t key = 0;
    std::uint32_t first_index = 0;
};

std::vector<Triangle> triangles_of(const PatchLook& look) {
    std::vector<std::uint64_t> vertices;
    vertices.reserve(look.vertices.size());
    for (std::size_t i = 0; i < look.vertices.size(); ++i) {
        const shared::SurfaceVertex& v = look.vertices[i];
        const geometry::VertexLight light = i < look.light.size() ? look.light[i] : geometry::VertexLight{};
        const auto x = std::bit_cast<std::uint32_t>(v.x), y = std::bit_cast<std::uint32_t>(v.y),
                   z = std::bit_cast<std::uint32_t>(v.z);
        std::uint64_t hash = mixed(std::uint64_t{light.sun} << 8U | light.open, std::uint64_t{x} << 32U | y);
        hash = mixed(hash, std::uint64_t{z} << 32U | v.normal);
        vertices.push_back(mixed(hash, v.colour));
    }
    std::vector<Triangle> triangles;
    triangles.reserve(look.indices.size() / 3);
    for (std::uint32_t i = 0; i + 2 < look.indices.size(); i += 3) {
        std::uint64_t key = vertices[look.indices[i]];
        key = mixed(key, vertices[look.indices[i + 1]]);
        triangles.push_back({mixed(key, vertices[look.indices[i + 2]]), i});
    }
    std::ranges::sort(triangles, {}, &Triangle::key);
    return triangles;
}

void include(Box& box, const PatchLook& look, std::span<const Triangle> triangles) {
    for (const Triangle& t : triangles)
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const shared::SurfaceVertex& v = look.vertices[look.indices[t.first_index + corner]];
            box.include({v.x, v.y, v.z});
        }
}

}  // namespace

Box changed_bounds(const PatchLook& before, const PatchLook& after) {
    const std::vector<Triangle> old = triangles_of(before), now = triangles_of(after);
    std::vector<Triangle> gone, come;
    std::ranges::set_difference(old, now, std::back_inserter(gone), {}, &Triangle::key, &Triangle::key);
    std::ranges::set_difference(now, old, std::back_inserter(come), {}, &Triangle::key, &Triangle::key);
    Box box;
    include(box, before, gone);
    include(box, after, come);
    return box;
}

}  // namespace burin::renderer
