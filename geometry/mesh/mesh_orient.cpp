// SPDX-License-Identifier: MIT
// Implements orient_outward of mesh_repair.hpp.
#include <algorithm>
#include <limits>

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh_repair.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

struct Neighbour {
    std::uint32_t triangle = kNoTriangle;
    bool agrees = true;  // the two triangles run along the shared edge in opposite directions
};

using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours_over_manifold_edges(std::span<const EdgeUse> uses, std::size_t triangles) {
    Neighbours neighbours(triangles);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 2) return;
        const bool agree = edge[0].upwards != edge[1].upwards;
        neighbours[edge[0].triangle][edge[0].corner] = {edge[1].triangle, agree};
        neighbours[edge[1].triangle][edge[1].corner] = {edge[0].triangle, agree};
    });
    return neighbours;
}

struct Patch {
    std::vector<std::uint32_t> triangles;
    Box bounds_m;
    double signed_volume_m3 = 0.0;
    bool open = false;
};

// Spreads over the patch from its first triangle and decides for each triangle whether it must flip to agree with that
// one.
Patch gather(std::uint32_t first, const Neighbours& neighbours, std::vector<bool>& turned, std::vector<bool>& seen) {
    Patch patch{{first}, {}, 0.0, false};
    seen[first] = true;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
        const std::uint32_t t = patch.triangles[i];
        for (const Neighbour& n : neighbours[t]) {
            if (n.triangle == kNoTriangle) {
                patch.open = true;
            } else if (!seen[n.triangle]) {
                seen[n.triangle] = true;
                turned[n.triangle] = turned[t] != !n.agrees;
                patch.triangles.push_back(n.triangle);
            }
        }
    }
    return patch;
}

void turn_all(const Patch& patch, std::vector<bool>& turned) {
    for (const std::uint32_t t : patch.triangles) turned[t] = !turned[t];
}

// Measures bounds and volume. Six times the volume would do for the sign; the true value makes sums comparable.
void measure(Patch& patch, const TriangleMesh& mesh, const std::vector<bool>& turned, const Vec3& centre_m) {
    for (const std::uint32_t t : patch.triangles) {
        const auto [i, j, k] = mesh.triangles[t];
        const Vec3 &a = mesh.positions_m[i], &b = mesh.positions_m[j], &c = mesh.positions_m[k];
        for (const Vec3* p : {&a, &b, &c}) patch.bounds_m.include(*p);
        const double volume = glm::dot(a - centre_m, glm::cross(b - centre_m, c - centre_m)) / 6.0;
        patch.signed_volume_m3 += turned[t] ? -volume : volume;
    }
}

bool within(const Box& inner, const Box& outer) {
    return glm::all(glm::greaterThanEqual(inner.lo, outer.lo)) && glm::all(glm::lessThanEqual(inner.hi, outer.hi)) &&
           (inner.lo != outer.lo || inner.hi != outer.hi);
}

// With thousands of patches (a triangle soup) the comparison would cost too much and mean too little.
constexpr std::size_t kMostPatchesCompared = 2000;

void turn_inside_out_patches(std::vector<Patch>& patches, std::vector<bool>& turned, OrientationReport& report) {
    if (patches.size() > kMostPatchesCompared) return;
    std::vector<bool> outermost(patches.size());
    for (std::size_t i = 0; i < patches.size(); ++i) {
        outermost[i] = std::ranges::none_of(
            patches, [&](const Patch& other) { return within(patches[i].bounds_m, other.bounds_m); });
    }
    for (std::size_t i = 0; i < patches.size(); ++i) {
        if (!outermost[i] || patches[i].open || patches[i].signed_volume_m3 >= 0.0) continue;
        turn_all(patches[i], turned);
        patches[i].signed_volume_m3 = -patches[i].signed_volume_m3;
        ++report.patches_turned;
    }
}

}  // namespace

OrientationReport orient_outward(TriangleMesh& mesh) {
    OrientationReport report;
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
    const Neighbours neighbours = neighbours_over_manifold_edges(uses, mesh.triangles.size());
    std::vector<bool> turned(mesh.triangles.size()), seen(mesh.triangles.size());
    Box bounds;
    for (const VertexTriple& t : mesh.triangles) {
        for (const std::uint32_t v : t) bounds.include(mesh.positions_m[v]);
    }
    std::vector<Patch> patches;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (seen[t] || names_a_vertex_twice(mesh.triangles[t])) continue;
        Patch patch = gather(t, neighbours, turned, seen);
        const auto turns = std::ranges::count_if(patch.triangles, [&](std::uint32_t i) { return turned[i]; });
        if (2 * static_cast<std::size_t>(turns) > patch.triangles.size()) turn_all(patch, turned);
        measure(patch, mesh, turned, bounds.center());
        patches.push_back(std::move(patch));
    }
    report.patches = patches.size();
    turn_inside_out_patches(patches, turned, report);
    double whole_m3 = 0.0;
    for (const Patch& p : patches) whole_m3 += p.signed_volume_m3;
    if (whole_m3 < 0.0) {
        for (const Patch& p : patches) turn_all(p, turned);
        report.patches_turned = patches.size() - report.patches_turned;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!turned[t]) continue;
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        ++report.triangles_turned;
    }
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 2) return;
        const bool agreed = edge[0].upwards != edge[1].upwards;
        if (agreed != (turned[edge[0].triangle] == turned[edge[1].triangle])) ++report.conflicts;
    });
    return report;
}

}  // namespace burin::geometry
