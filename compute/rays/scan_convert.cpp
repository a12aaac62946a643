// SPDX-License-Identifier: MIT
#include "compute/rays/scan_convert.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/try.hpp"
#include "compute/rays/memory_need.hpp"
#include "compute/rays/normal_code.hpp"
#include "compute/rays/ray_crossings.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh_placing.hpp"

namespace burin::compute {
namespace {

struct Input {
    const geometry::TriangleMesh& mesh;
    std::vector<Whole3> vertices;
    std::vector<std::uint32_t> normals;  // code of each triangle's normal
};

Input prepare(const geometry::TriangleMesh& mesh, const Lattice& lattice) {
    Input input{mesh, {}, {}};
    input.vertices.reserve(mesh.positions_m.size());
    for (const Vec3& p : mesh.positions_m) {
        const Vec3 units = lattice.units_from_object(p);
        input.vertices.push_back({std::llround(units.x), std::llround(units.y), std::llround(units.z)});
    }
    input.normals.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        // Computed in lattice units: products of very small or large metres would leave the range of doubles.
        const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
        input.normals.push_back(normal_code(glm::cross((b - a) / lattice.unit_m(), (c - a) / lattice.unit_m())));
    }
    return input;
}

// Converts sorted crossings to the intervals of the set, and counts crossings and unmatched rays in `result`.
void build(const Input& input, std::span<const Crossing> crossings, DexelSet& set, ScanConversion& result) {
    const std::vector<std::uint8_t>& materials = input.mesh.triangle_materials;
    std::vector<std::uint32_t> counts(set.ray_count(), 0);
    std::vector<shared::DexelEnd> ends;
    std::vector<Crossing> bounds;
    for (std::size_t from = 0; from < crossings.size();) {
        const std::span<const Crossing> ray = ray_at(crossings, from);
        from += ray.size();
        bounds.clear();
        if (!append_interval_bounds(ray, result.by_parity, bounds)) ++result.unmatched_rays;
        counts[ray.front().ray] = static_cast<std::uint32_t>(bounds.size());
        for (const Crossing& c : bounds) {
            ends.push_back(
                shared::make_end(c.depth, materials.empty() ? 0u : materials[c.triangle], input.normals[c.triangle]));
        }
    }
    result.crossings += crossings.size();
    set.assign(counts, ends);
}

enum class Orientation { open, mixed, consistent };

// Classifies the mesh by its edges. A closed mesh uses every edge an even number of times; winding numbers also need it
// to be used as often in one direction as in the other.
Orientation orientation_of(const geometry::TriangleMesh& mesh) {
    Orientation result = Orientation::consistent;
    geometry::for_each_edge(geometry::edge_uses(mesh.triangles), [&](std::span<const geometry::EdgeUse> edge) {
        if (edge.size() % 2 != 0) {
            result = Orientation::open;
        } else if (geometry::imbalance(edge) != 0 && result == Orientation::consistent) {
            result = Orientation::mixed;
        }
    });
    return result;
}

// Checks that the mesh's lists are consistent: finite coordinates, valid materials and indices, and at least one
// triangle.
Result<void> check_lists(const geometry::TriangleMesh& mesh) {
    for (const Vec3& p : mesh.positions_m) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return fail("mesh", "has a coordinate that is not finite", "repair the file");
        }
    }
    if (!mesh.triangle_materials.empty() && mesh.triangle_materials.size() != mesh.triangles.size()) {
        return fail("mesh", "names a material for some triangles only", "give every triangle a material, or none");
    }
    const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
    for (const std::uint8_t m : mesh.triangle_materials) {
        if (m >= materials)
            return fail("mesh", "uses material " + std::to_string(m) + ", which it lacks", "repair the file");
    }
    for (const auto& t : mesh.triangles) {
        if (std::ranges::max(t) >= mesh.positions_m.size()) {
            return fail("mesh", "has a triangle with a vertex that does not exist", "repair the file");
        }
    }
    if (mesh.triangles.empty()) return fail("mesh", "has no triangles", "give a mesh with a closed surface");
    return {};
}

// Converts a mesh that check_lists has accepted, on a lattice that holds it.
Result<ScanConversion> convert(const geometry::TriangleMesh& mesh, Orientation orientation, const Lattice& lattice,
                               WorkerPool& pool) {
    ScanConversion result;
    result.by_parity = orientation == Orientation::mixed;
    result.solid.lattice = lattice;
    result.solid.materials =
        mesh.materials.empty() ? std::vector<geometry::Material>{{"workpiece", {200, 200, 200}}} : mesh.materials;
    const Input input = prepare(mesh, lattice);
    const WholeMesh whole{input.vertices, mesh.triangles};
    std::size_t ends_held = 0;
    for (int axis = 0; axis < 3; ++axis) {
        DexelSet& set = result.solid.sets[static_cast<std::size_t>(axis)];
        set = DexelSet(lattice.rays_u(axis), lattice.rays_v(axis));
        build(input, sorted_crossings(whole, all_rays(lattice, axis), pool), set, result);
        ends_held += set.end_count();
    }
    if (ends_held == 0) {
        return fail("mesh", "encloses no material at this resolution",
                    "raise --resolution, or check that the mesh's triangles face outwards");
    }
    return result;
}

const char* const kHoles = "has holes, so inside and outside are not defined";

}  // namespace

Result<ScanConversion> scan_convert(const geometry::TriangleMesh& mesh, int resolution, WorkerPool& pool) {
    BURIN_TRY_DO(check_lists(mesh));
    const Orientation orientation = orientation_of(mesh);
    if (orientation == Orientation::open) return fail("mesh", kHoles, "close it, or pass --close-holes");
    BURIN_TRY(lattice, lattice_around(geometry::bounds_of(mesh), resolution));
    BURIN_TRY_DO(check_memory(lattice, memory_available()));
    return convert(mesh, orientation, lattice, pool);
}

Result<ScanConversion> scan_convert_onto(const geometry::TriangleMesh& mesh, const Lattice& lattice, WorkerPool& pool) {
    BURIN_TRY_DO(check_lists(mesh));
    const Orientation orientation = orientation_of(mesh);
    if (orientation == Orientation::open) return fail("mesh", kHoles, "close it, or pass --close-holes");
    const Box bounds = geometry::bounds_of(mesh);
    const Vec3 lo = lattice.units_from_object(bounds.lo), hi = lattice.units_from_object(bounds.hi);
    for (int a = 0; a < 3; ++a) {
        if (lo[a] < 0.0 || hi[a] > lattice.cells[static_cast<std::size_t>(a)] * double(shared::kUnitsPerCell)) {
            return fail("mesh", "does not lie within the lattice", "place the lattice around all of it");
        }
    }
    return convert(mesh, orientation, lattice, pool);
}

}  // namespace burin::compute
