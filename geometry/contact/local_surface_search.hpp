// SPDX-License-Identifier: MIT
// Broad phase on a LocalSurface: finds the few triangles that are near the tool. A tick queries it several times.
// Does not allocate, lock or throw. Lengths are metres relative to origin_object.
// Cost: see geometry/contact/tile_block.hpp, geometry/contact/gridded_triangles.hpp and
// geometry/contact/touch_patch.hpp.
#pragma once

#include "geometry/contact/posed_surface.hpp"

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
        const bool goes_on = visit.triangle(first + i, Triangle{t.a + shift, t.b + shift, t.c + shift});
        shifted.reach_m = near.reach_m;
        shifted.looks_left = near.looks_left;
        return goes_on;
    };
    bool all = false;
    if constexpr (Visitor::kSkips)
        all = for_each_near(snapshot, shifted, SkippingVisitor{triangle, visit.point, visit.fineness, visit.skips},
                            shift);
    else if constexpr (Visitor::kWantsPoints)
        all = for_each_near(snapshot, shifted, MixedVisitor{triangle, visit.point, visit.fineness}, shift);
    else
        all = for_each_near(snapshot, shifted, TriangleVisitor{triangle});
    near.looks_left = shifted.looks_left;
    return all;
}

// The same for a mesh that has a pose. The query is carried into the mesh's frame, and what it finds back. An axis-
// aligned box becomes the smallest one around it there, which for a query by way is that of the way itself.
template <typename Visitor>
bool for_each_near_in_posed_mesh(const TouchSnapshot& snapshot, const Pose& pose, const Vec3& origin_object,
                                 std::uint32_t first, Near& near, const Visitor& visit) {
    const glm::dmat3 turn = glm::mat3_cast(pose.orientation);  // columns: the mesh's axes in the object frame
    const Vec3 offset = turn * snapshot.origin_object + pose.position_m - origin_object;
    const auto in_mesh = [&](const Vec3& p) { return (p - offset) * turn; };  // the transpose is the inverse
    Near turned = near;
    turned.from = in_mesh(near.from), turned.to = in_mesh(near.to);
    if (near.by_way) {
        turned.lo = glm::min(turned.from, turned.to), turned.hi = glm::max(turned.from, turned.to);
    } else {
        const Vec3 middle = in_mesh(0.5 * (near.lo + near.hi)), half = 0.5 * (near.hi - near.lo);
        Vec3 reach(0.0);
        for (int axis = 0; axis < 3; ++axis) reach[axis] = glm::dot(glm::abs(turn[axis]), half);
        turned.lo = middle - reach, turned.hi = middle + reach;
    }
    // Rounding of the transform, far above one part in 2^53 of any length in it.
    const double size = glm::length(turned.from) + glm::length(turned.to) + glm::length(offset);
    const auto widened = [size](double reach_m) { return reach_m * (1.0 + 1e-12) + 1e-14 * size; };
    turned.reach_m = widened(near.reach_m);
    const auto triangle = [&](std::uint32_t i, const Triangle& t) {
        near.looks_left = turned.looks_left;
        const Triangle moved{turn * t.a + offset, turn * t.b + offset, turn * t.c + offset};
        const bool goes_on = visit.triangle(first + i, moved);
        turned.reach_m = widened(near.reach_m);
        turned.looks_left = near.looks_left;
        return goes_on;
    };
    bool all = false;
    if constexpr (Visitor::kWantsPoints) {
        const auto point = [&](const SurfacePoint& p) {
            return visit.point(SurfacePoint{turn * p.position + offset, nullptr, p.of_mesh, &pose.orientation});
        };
        if constexpr (Visitor::kSkips) {
            const auto skips = [&](const Box& box, const TriangleSlab& slab) {
                const Vec3 middle = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
                const Vec3 placed = turn * middle + offset, normal = turn * Vec3(slab.normal);
                Vec3 size(0.0);
                for (int axis = 0; axis < 3; ++axis) size += glm::abs(turn[axis]) * half[axis];
                return visit.skips(Box{placed - size, placed + size},
                                   TriangleSlab{Vec3f(normal), slab.top_m + glm::dot(normal, offset)});
            };
            all = for_each_near(snapshot, turned, SkippingVisitor{triangle, point, visit.fineness, skips}, Vec3(0.0));
        } else {
            all = for_each_near(snapshot, turned, MixedVisitor{triangle, point, visit.fineness}, Vec3(0.0));
        }
    } else {
        all = for_each_near(snapshot, turned, TriangleVisitor{triangle});
    }
    near.looks_left = turned.looks_left;
    return all;
}

// Visits what is near of the mesh with this index.
template <typename Visitor>
bool for_each_near_of_mesh(const PosedSurface& posed, std::uint32_t index, std::uint32_t first, Near& near,
                           const Visitor& visit) {
    const TouchedMesh& mesh = posed.surface().meshes[index];
    if (mesh.has_pose())
        return for_each_near_in_posed_mesh(*mesh.snapshot, posed.pose(index), posed.origin_object(), first, near,
                                           visit);
    return for_each_near_in_mesh(*mesh.snapshot, mesh.snapshot->origin_object - posed.origin_object(), first, near,
                                 visit);
}

// The same visitor where the surface is visited by its triangles alone.
template <typename Visitor>
[[nodiscard]] auto without_points(const Visitor& visit) {
    if constexpr (Visitor::kSkips)
        return SkippingVisitor{visit.triangle, visit.point, Fineness{}, visit.skips};
    else
        return TriangleVisitor{visit.triangle};
}

// Visits the triangles within near.reach_m of the box [near.lo, near.hi], each once, and some a little farther off, but
// no degenerate one: visit.triangle(id, triangle). It may reduce near.reach_m and near.looks_left for the triangles
// that follow. Where the visitor wants points and the surface is fine, visits the vertices near the segment of the
// query instead: visit.point(point). Leaves out groups that the visitor skips. The order depends only on the surface
// and the query. Ends and returns false when a visit returns false, or when near.looks_left is used up.
template <typename Visitor>
bool for_each_near(const PosedSurface& posed, Near& near, const Visitor& visit) {
    const LocalSurface& surface = posed.surface();
    const bool ground = posed.shows_ground();
    if (ground && surface.tiles.triangles > 0 && !for_each_near(surface.tiles, near, visit)) return false;
    std::uint32_t first = surface.tiles.triangles;
    const auto visit_loose = [&](std::uint32_t i, const Triangle& t) { return visit.triangle(first + i, t); };
    const auto visit_cell = [&](const Box& box, const TriangleSlab& slab) {
        return skips(visit, box, slab, Vec3(0.0));
    };
    if (ground && surface.loose &&
        !(Visitor::kSkips ? for_each_near(*surface.loose, near, visit_loose, visit_cell)
                          : for_each_near(*surface.loose, near, visit_loose)))
        return false;
    first += surface.loose_triangles();
    for (std::uint32_t i = 0; i < surface.meshes.size(); ++i) {
        const TouchedMesh& mesh = surface.meshes[i];
        // The walk over the meshes is work as well: a surface may list a hundred.
        if (!near.look()) return false;
        if (posed.shows(i) &&
            // Vertices do not say which side of a sheet they are seen from.
            !(mesh.two_sided ? for_each_near_of_mesh(posed, i, first, near, without_points(visit))
                             : for_each_near_of_mesh(posed, i, first, near, visit)))
            return false;
        first += triangles_of(mesh);
    }
    return true;
}

// Visits triangles alone.
template <typename Visit>
bool for_each_triangle_near(const PosedSurface& surface, Near& near, Visit&& visit) {
    return for_each_near(surface, near, TriangleVisitor{visit});
}

// Visits each triangle that may meet the box.
template <typename Visit>
bool for_each_triangle_near(const PosedSurface& surface, const Vec3& lo, const Vec3& hi, Visit&& visit) {
    Near near{lo, hi};
    return for_each_triangle_near(surface, near, visit);
}

// Visits the triangles that have a corner at a vertex of the surface.
template <typename Visit>
void for_each_triangle_around(const PosedSurface& surface, const Vec3& vertex, Visit&& visit) {
    const double tie = 1e-6 * surface.mean_edge_m();  // far below an edge, far above rounding
    Near near{.lo = vertex, .hi = vertex, .reach_m = tie};
    for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle& t) {
        for (const Vec3& corner : {t.a, t.b, t.c})
            if (glm::dot(corner - vertex, corner - vertex) <= tie * tie) return visit(id, t);
        return true;
    });
}

// Returns a box that contains the centre of every triangle.
[[nodiscard]] inline Box bounds(const PosedSurface& posed) noexcept {
    const LocalSurface& surface = posed.surface();
    Box box;
    const auto include = [&](const Box& other) {
        box.include(other.lo);
        box.include(other.hi);
    };
    if (surface.tiles.triangles > 0) include(surface.tiles.bounds());
    if (surface.loose && surface.loose->search.listed > 0) include(surface.loose->search.bounds());
    for (std::uint32_t i = 0; i < surface.meshes.size(); ++i) {
        const TouchedMesh& mesh = surface.meshes[i];
        if (triangles_of(mesh) == 0) continue;
        const Vec3 shift = mesh.snapshot->origin_object - surface.origin_object;
        const Box own = mesh.snapshot->bounds();
        if (!mesh.has_pose()) {
            include({own.lo + shift, own.hi + shift});
        } else if (posed.shows(i)) {
            // Whichever way it is turned.
            const Vec3 middle = posed.pose(i) * (own.center() + mesh.snapshot->origin_object) - surface.origin_object;
            const Vec3 half(0.5 * glm::length(own.extent()));
            include({middle - half, middle + half});
        }
    }
    return box;
}

}  // namespace burin::geometry
