// SPDX-License-Identifier: MIT
// Broad phase on a LocalSurface: finds the few triangles that are near the tool. A tick queries it several times.
// Does not allocate, lock or throw. Lengths are metres relative to origin_object.
// Cost: see geometry/contact/tile_block.hpp, geometry/contact/gridded_triangles.hpp and
// geometry/contact/touch_patch.hpp.
#pragma once

#include "geometry/contact/local_surface.hpp"

namespace burin::geometry {

// Visits the triangles of one mesh, whose origin is `shift` from the surface's origin; their numbers begin with
// `first`.
template <typename Visitor>
bool for_each_near_in_mesh(const TouchSnapshot& snapshot, const Vec3& shift, std::uint32_t first, Near& near,
                           const Visitor& visit) {
    Near shifted = near;
    for (Vec3* const place : {&shifted.lo, &shifted.hi, &shifted.from, &shifted.to}) *place -= shift;
    const auto triangle = [&](std::uint32_t i, const Triangle& t) {
        near.looks_left = shifted.looks_left;
        if (!visit.triangle(first + i, Triangle{t.a + shift, t.b + shift, t.c + shift})) return false;
        shifted.reach_m = near.reach_m;
        return true;
    };
    bool all = false;
    if constexpr (Visitor::kWantsPoints)
        all = for_each_near(snapshot, shifted, MixedVisitor{triangle, visit.point, visit.fineness}, shift);
    else
        all = for_each_near(snapshot, shifted, TriangleVisitor{triangle});
    near.looks_left = shifted.looks_left;
    return all;
}

// Visits the triangles within near.reach_m of the box [near.lo, near.hi], each once, and some a little farther off, but
// no degenerate one: visit.triangle(id, triangle). It may reduce near.reach_m for the triangles that follow. Where the
// visitor wants points and the surface is fine, visits the vertices near the segment of the query instead:
// visit.point(point). The order depends only on the surface and the query. Ends and returns false when a visit returns
// false, or when near.looks_left is used up.
template <typename Visitor>
bool for_each_near(const LocalSurface& surface, Near& near, const Visitor& visit) {
    if (surface.tiles.triangles > 0 && !for_each_near(surface.tiles, near, visit)) return false;
    std::uint32_t first = surface.tiles.triangles;
    const auto visit_loose = [&](std::uint32_t i, const Triangle& t) { return visit.triangle(first + i, t); };
    if (surface.loose && !for_each_near(*surface.loose, near, visit_loose)) return false;
    first += surface.loose_triangles();
    for (const TouchedMesh& mesh : surface.meshes) {
        if (!mesh.snapshot) continue;
        const Vec3 shift = mesh.snapshot->origin_object - surface.origin_object;
        // Vertices do not say which side of a sheet they are seen from.
        if (mesh.two_sided ? !for_each_near_in_mesh(*mesh.snapshot, shift, first, near, TriangleVisitor{visit.triangle})
                           : !for_each_near_in_mesh(*mesh.snapshot, shift, first, near, visit))
            return false;
        first += mesh.snapshot->triangles();
    }
    return true;
}

// Visits triangles alone.
template <typename Visit>
bool for_each_triangle_near(const LocalSurface& surface, Near& near, Visit&& visit) {
    return for_each_near(surface, near, TriangleVisitor{visit});
}

// Visits each triangle that may meet the box.
template <typename Visit>
bool for_each_triangle_near(const LocalSurface& surface, const Vec3& lo, const Vec3& hi, Visit&& visit) {
    Near near{lo, hi};
    return for_each_triangle_near(surface, near, visit);
}

// Visits the triangles that have a corner at a vertex of the surface.
template <typename Visit>
void for_each_triangle_around(const LocalSurface& surface, const Vec3& vertex, Visit&& visit) {
    const double tie = 1e-6 * surface.mean_edge_m();  // far below an edge, far above rounding
    Near near{.lo = vertex, .hi = vertex, .reach_m = tie};
    for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle& t) {
        for (const Vec3& corner : {t.a, t.b, t.c})
            if (glm::dot(corner - vertex, corner - vertex) <= tie * tie) return visit(id, t);
        return true;
    });
}

// Returns a box that contains the centre of every triangle.
[[nodiscard]] inline Box bounds(const LocalSurface& surface) noexcept {
    Box box;
    const auto include = [&](const Box& other) {
        box.include(other.lo);
        box.include(other.hi);
    };
    if (surface.tiles.triangles > 0) include(surface.tiles.bounds());
    if (surface.loose && surface.loose->search.listed > 0) include(surface.loose->search.bounds());
    for (const TouchedMesh& mesh : surface.meshes) {
        if (triangles_of(mesh) == 0) continue;
        const Vec3 shift = mesh.snapshot->origin_object - surface.origin_object;
        const Box own = mesh.snapshot->bounds();
        include({own.lo + shift, own.hi + shift});
    }
    return box;
}

}  // namespace burin::geometry
