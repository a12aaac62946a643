// SPDX-License-Identifier: MIT
#include "geometry/mesh/crumbs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/text.hpp"
#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {
namespace {

// A closed piece of the surface.
struct Shell {
    Vec3 corner{0.0};  // one of its own, for its volume, so that a far shell loses no digits
    Box bounds;
    double six_volumes = 0.0;  // negative: a hollow
    bool goes = false;

    [[nodiscard]] double longest() const {
        const Vec3 size = bounds.extent();
        return std::max({size.x, size.y, size.z});
    }
};

// Numbers the shell of each triangle from 0.
struct ShellsOfMesh {
    std::vector<std::uint32_t> of_triangle;
    std::vector<Shell> shells;
};

ShellsOfMesh shells_of(const TriangleMesh& mesh) {
    DisjointSets joined(mesh.positions_m.size());
    for (const auto& t : mesh.triangles) {
        joined.unite(t[0], t[1]);
        joined.unite(t[0], t[2]);
    }
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> number(mesh.positions_m.size(), kNone);
    ShellsOfMesh found;
    for (const auto& t : mesh.triangles) {
        std::uint32_t& of_root = number[joined.set_of(t[0])];
        if (of_root == kNone) {
            of_root = static_cast<std::uint32_t>(found.shells.size());
            found.shells.push_back({mesh.positions_m[t[0]], {}, 0.0, false});
        }
        Shell& shell = found.shells[of_root];
        const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
        for (const Vec3& p : {a, b, c}) shell.bounds.include(p);
        const Vec3& from = shell.corner;
        shell.six_volumes += glm::dot(a - from, glm::cross(b - from, c - from));
        found.of_triangle.push_back(of_root);
    }
    return found;
}

bool holds(const Box& outer, const Box& inner) {
    return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) && glm::all(glm::lessThanEqual(inner.hi, outer.hi));
}

// Marks what goes; returns how many shells that are no hollows.
std::size_t mark_crumbs(std::vector<Shell>& shells, double below) {
    const auto largest = std::ranges::max_element(shells, {}, &Shell::longest);
    std::size_t count = 0;
    for (Shell& shell : shells) {
        shell.goes = &shell != &*largest && shell.six_volumes >= 0.0 && shell.longest() < below;
        count += shell.goes ? 1 : 0;
    }
    if (count == 0) return 0;
    for (Shell& hollow : shells) {
        if (hollow.six_volumes >= 0.0) continue;
        hollow.goes = std::ranges::any_of(shells, [&](const Shell& crumb) {
            return crumb.goes && crumb.six_volumes >= 0.0 && holds(crumb.bounds, hollow.bounds);
        });
    }
    return count;
}

// Keeps the triangles of the shells that stay, and the vertices that these use, in their order.
void keep_rest(TriangleMesh& mesh, const ShellsOfMesh& found) {
    std::vector<bool> used(mesh.positions_m.size(), false);
    const bool has_materials = !mesh.triangle_materials.empty();
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (found.shells[found.of_triangle[t]].goes) continue;
        for (const std::uint32_t v : mesh.triangles[t]) used[v] = true;
        if (has_materials) mesh.triangle_materials[kept] = mesh.triangle_materials[t];
        mesh.triangles[kept++] = mesh.triangles[t];
    }
    mesh.triangles.resize(kept);
    if (has_materials) mesh.triangle_materials.resize(kept);
    std::vector<std::uint32_t> moved(mesh.positions_m.size(), 0);
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        moved[v] = next;
        mesh.positions_m[next] = mesh.positions_m[v];
        if (!mesh.colours.empty()) mesh.colours[next] = mesh.colours[v];
        ++next;
    }
    mesh.positions_m.resize(next);
    if (!mesh.colours.empty()) mesh.colours.resize(next);
    for (auto& t : mesh.triangles)
        for (std::uint32_t& v : t) v = moved[v];
}

}  // namespace

DroppedCrumbs drop_crumbs(TriangleMesh& numbers, LengthUnit unit, double below_m) {
    DroppedCrumbs dropped{0, below_m};
    if (!(below_m > 0.0) || numbers.triangles.empty()) return dropped;
    ShellsOfMesh found = shells_of(numbers);
    dropped.count = mark_crumbs(found.shells, from_metres(below_m, unit));
    if (dropped.count > 0) keep_rest(numbers, found);
    return dropped;
}

std::string in_words(const DroppedCrumbs& dropped) {
    if (dropped.count == 0) return "";
    return "dropped " + std::to_string(dropped.count) + (dropped.count == 1 ? " crumb" : " crumbs") + " smaller than " +
           in_millimetres(dropped.below_m);
}

Result<void> check_crumbs(std::optional<double> below_m) {
    if (!below_m || (std::isfinite(*below_m) && *below_m >= 0.0)) return {};
    return fail("--crumbs", "needs a distance, or 0 to keep all of them",
                "give below which size loose pieces are dropped, in metres, or leave the option out");
}

}  // namespace burin::geometry
