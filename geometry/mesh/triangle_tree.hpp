// SPDX-License-Identifier: MIT
// A tree of boxes over a mesh's triangles: finds the triangles whose boxes meet a box, and the distance of a point from
// the mesh.
//
// Layout: triangles in Morton order of their centroids, four to a leaf, four nodes to a node, one array for each level,
// no pointers. Boxes are floats relative to the middle of the mesh, rounded outwards, so that no triangle is missed.
// The tree refers to the positions and triangles it was made from: they must stay in place, and positions that move
// must stay within the margin given to the queries. Read-only after construction, hence usable from many threads.
// Cost: n log n to build, 0.2 s a million triangles; 40 bytes a triangle.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

struct TreeBox {
    Vec3f lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};

    [[nodiscard]] bool meets(const TreeBox& b) const {
        return lo.x <= b.hi.x && b.lo.x <= hi.x && lo.y <= b.hi.y && b.lo.y <= hi.y && lo.z <= b.hi.z && b.lo.z <= hi.z;
    }
    void include(const TreeBox& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
};

class TriangleTree {
public:
    static constexpr std::size_t kBranches = 4;

    // Triangles that name a vertex twice are left out.
    TriangleTree(std::span<const Vec3> positions, std::span<const VertexTriple> triangles);

    // Queries report a triangle by its place in the tree's order; this returns its index in the mesh.
    [[nodiscard]] std::uint32_t triangle_at(std::size_t place) const { return order_[place]; }
    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] const TreeBox& box_at(std::size_t place) const { return boxes_[place]; }
    [[nodiscard]] TreeBox box_of(const Box& box_m) const;

    // Calls visit(place) for each triangle at first_place or later whose box meets the given one.
    template <typename Visit>
    void for_each_meeting(const TreeBox& box, std::size_t first_place, Visit&& visit) const {
        if (!levels_.empty()) descend(levels_.size() - 1, 0, box, first_place, visit);
    }

    // A triangle near the point, and its distance: the nearest one, or the first found within good_enough_m.
    struct Near {
        double distance_m = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = 0;
    };
    // Finds that triangle. `hint` is a triangle of the mesh that may be near; a good one saves time.
    [[nodiscard]] Near nearest(const Vec3& point_m, std::uint32_t hint, double good_enough_m = 0.0) const;

private:
    template <typename Visit>
    void descend(std::size_t level, std::size_t node, const TreeBox& box, std::size_t first_place, Visit& visit) const {
        // The node covers the places before (node + 1) * kBranches^(level + 1).
        if (((node + 1) << (2 * (level + 1))) <= first_place || !levels_[level][node].meets(box)) return;
        const std::size_t first = node * kBranches;
        if (level == 0) {
            const std::size_t last = std::min(first + kBranches, order_.size());
            for (std::size_t p = std::max(first, first_place); p < last; ++p) {
                if (boxes_[p].meets(box)) visit(p);
            }
            return;
        }
        const std::size_t last = std::min(first + kBranches, levels_[level - 1].size());
        for (std::size_t child = first; child < last; ++child) descend(level - 1, child, box, first_place, visit);
    }
    void search(std::size_t level, std::size_t node, const Vec3& point, const Vec3f& place, double good_enough_m,
                Near& near) const;
    void try_triangle(std::uint32_t triangle, const Vec3& point_m, Near& near) const;

    std::span<const Vec3> positions_;
    std::span<const VertexTriple> triangles_;
    Vec3 middle_m_{0.0};
    std::vector<std::uint32_t> order_;
    std::vector<TreeBox> boxes_;                // one for each triangle, in the tree's order
    std::vector<std::vector<TreeBox>> levels_;  // the leaves first, one root last
};

// Returns the point of the triangle nearest to p.
[[nodiscard]] Vec3 nearest_point(const std::array<Vec3, 3>& triangle, const Vec3& p);

}  // namespace burin::geometry
