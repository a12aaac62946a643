// SPDX-License-Identifier: MIT
// A finely meshed surface by its vertices: what a ball much larger than the triangles can tell of it.
//
// A ball of radius R that rests on the corners of a triangle whose longest edge is a sinks into it by at most
// a^2 / (6 R): no point of the triangle is farther than a / sqrt(3) from a corner. So where all edges are at most
// sqrt(6 e) R, vertices alone stand for the surface to within e R, and a vertex costs a tenth of a triangle. Four are
// tested at once, in float.
// Frame and threads: as geometry/contact/local_surface_search.hpp. A query does not allocate, lock or throw.
#pragma once

#include <algorithm>
#include <span>

#include "geometry/contact/lanes.hpp"
#include "geometry/contact/surface_tile.hpp"
#include "geometry/contact/triangle_slab.hpp"
#include "geometry/mesh/triangle.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::geometry {

struct SurfacePoint {
    Vec3 position{0.0};
    // Where its normal is: one of them is null. Read only where it is needed, for decoding takes longer than the rest.
    const shared::SurfaceVertex* of_tile = nullptr;
    const Vec3f* of_mesh = nullptr;
    const Quat* turned_by = nullptr;  // null: that normal is in the object frame; else the mesh is turned by this

    // The normal of the smooth surface; zero where it is not known.
    [[nodiscard]] Vec3 normal() const noexcept {
        if (turned_by != nullptr) return *turned_by * Vec3(*of_mesh);
        if (of_tile == nullptr) return Vec3(*of_mesh);
        const shared::Direction d = shared::decode_normal(of_tile->normal);
        return {d.x, d.y, d.z};
    }
};

// Which surfaces are visited by their vertices: tiles and patches without longer edges than this.
struct Fineness {
    double longest_edge_m = 0.0;  // 0: none
    std::uint32_t stride = 1;     // only each so manieth vertex is visited
};

// Tests four points at a time against a segment with a reach, relative to the origin of their own positions.
class PointGate {
public:
    PointGate(const Near& near, const Vec3& shift) noexcept {
        const Vec3 from = near.from - shift, motion = near.to - near.from;
        const double length2 = glm::dot(motion, motion);
        const Vec3 size = glm::abs(from) + glm::abs(motion) + near.reach_m;
        const double reach = near.reach_m * (1.0 + 1e-6) + 4e-7 * std::max({size.x, size.y, size.z});
        from_ = in_all_lanes(Vec3f(from));
        motion_ = in_all_lanes(Vec3f(motion));
        by_length2_ = in_all_lanes(length2 > 0.0 ? Vec3f(motion / length2) : Vec3f(0.0f));
        reach2_ = static_cast<float>(reach * reach);
    }
    [[nodiscard]] LaneMask near(const Vec3Lanes& at) const noexcept {
        const Vec3Lanes off = at - from_;
        const Lanes one{1.0f, 1.0f, 1.0f, 1.0f};
        const Lanes share = lesser(greater(dot(off, by_length2_), Lanes{}), one);
        const Vec3Lanes across = off - share * motion_;
        return dot(across, across) <= reach2_;
    }

private:
    Vec3Lanes from_, motion_, by_length2_;
    float reach2_ = 0.0f;
};

// The points first, first + stride, .., below end.
struct PointRange {
    std::uint32_t first = 0, end = 0, stride = 1;
};

// Calls visit(i) for the points of the range that pass the gate. Their coordinates are at(i): three floats in a row,
// followed by at least one more readable float. A look is a test of four points.
template <typename At, typename Visit>
bool for_each_point(const PointGate& gate, const PointRange& range, Near& near, At&& at, Visit&& visit) {
    const std::uint32_t four = static_cast<std::uint32_t>(kLanes) * range.stride;
    for (std::uint32_t first = range.first; first < range.end; first += four) {
        if (!near.look()) return false;
        const float* from[kLanes];
        for (std::uint32_t k = 0; k < kLanes; ++k) from[k] = at(std::min(first + k * range.stride, range.end - 1));
        const LaneMask is_near = gate.near(gathered(from));
        if (!any(is_near)) continue;
        for (std::uint32_t k = 0; k < kLanes; ++k)
            if (is_near[k] != 0 && first + k * range.stride < range.end && !visit(first + k * range.stride))
                return false;
    }
    return true;
}

// Visits the points of a tile, a SurfacePoint each.
template <typename Visit>
bool for_each_point_near(const SurfaceTile& tile, const PointGate& gate, std::uint32_t stride, Near& near,
                         Visit&& visit) {
    const std::span<const shared::SurfaceVertex> vertices = tile.vertices;
    return for_each_point(
        gate, {0, static_cast<std::uint32_t>(vertices.size()), stride}, near,
        [&](std::uint32_t i) { return &vertices[i].x; },
        [&](std::uint32_t i) { return visit(SurfacePoint{Vec3(place_of(vertices[i])), &vertices[i], nullptr}); });
}

// Visits points of a part of a mesh whose origin is at `shift`, by their positions and normals.
template <typename Visit>
bool for_each_point_near(std::span<const Vec3f> positions, std::span<const Vec3f> normals, const PointRange& range,
                         const Vec3& shift, const PointGate& gate, Near& near, Visit&& visit) {
    // After the last position there is nothing more to read.
    const std::array<float, 4> last{positions.back().x, positions.back().y, positions.back().z, 0.0f};
    return for_each_point(
        gate, range, near, [&](std::uint32_t i) { return i + 1 < positions.size() ? &positions[i].x : last.data(); },
        [&](std::uint32_t i) { return visit(SurfacePoint{Vec3(positions[i]) + shift, nullptr, &normals[i]}); });
}

// A visitor of triangles alone.
template <typename VisitTriangle>
struct TriangleVisitor {
    static constexpr bool kWantsPoints = false, kSkips = false;
    VisitTriangle& triangle;  // bool(number, Triangle); false ends the search
};

// A visitor of triangles, and of points where the surface is fine.
template <typename VisitTriangle, typename VisitPoint>
struct MixedVisitor {
    static constexpr bool kWantsPoints = true, kSkips = false;
    VisitTriangle& triangle;
    VisitPoint& point;  // bool(SurfacePoint); false ends the search
    Fineness fineness;
};

// A visitor that has groups of neighbouring triangles left out.
template <typename VisitTriangle, typename VisitPoint, typename Skips>
struct SkippingVisitor {
    static constexpr bool kWantsPoints = true, kSkips = true;
    VisitTriangle& triangle;
    VisitPoint& point;
    Fineness fineness;
    Skips& skips;  // bool(Box, TriangleSlab), relative to the surface's origin; true leaves out what they bound
};

// Asks a visitor whether to leave out a group whose origin is at `shift`.
template <typename Visitor>
[[nodiscard]] bool skips(const Visitor& visit, const Box& box, const TriangleSlab& slab, const Vec3& shift) {
    if constexpr (Visitor::kSkips) {
        return visit.skips(Box{box.lo + shift, box.hi + shift},
                           TriangleSlab{slab.normal, slab.top_m + glm::dot(Vec3(slab.normal), shift)});
    } else {
        return false;
    }
}

}  // namespace burin::geometry
