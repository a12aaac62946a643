// SPDX-License-Identifier: MIT
// A tree of boxes over a mesh's triangles, each box along the triangles within it. It tells long and narrow triangles
// apart that lie side by side across the axes, where all boxes along the axes (geometry/mesh/triangle_tree.hpp) meet.
//
// Layout: two nodes below each, in preorder (the left one is next, the right one behind all of that), up to kLeaf
// triangles in a leaf. Triangles of a large fan lie side by side in the order, so that nearly all nodes above them have
// its vertex in common. Lengths are in the mesh's unit. The tree copies what it needs. Read-only after construction,
// hence usable from many threads. Cost: n log n to build, about 1 us a triangle; 100 bytes a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "compute/repair/remedies.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct OrientedBox {
    Vec3 middle{0.0};
    std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};  // unit, at right angles
    Vec3 half{0.0};                                                         // of the extent along each axis
    double reach = 0.0;                                                     // how far what is inside may move beyond it
};

// Tells whether the boxes may meet: false is certain.
[[nodiscard]] bool may_meet(const OrientedBox& a, const OrientedBox& b);

// Tells whether a triangle whose corners move by at most `reach` may meet the box: false is certain.
[[nodiscard]] bool may_meet(const OrientedBox& box, const std::array<Vec3, 3>& triangle, double reach);

// Tells whether the triangles are farther from each other than `reach`: true is certain.
[[nodiscard]] bool are_apart(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double reach);

class OrientedTree {
public:
    static constexpr std::size_t kLeaf = 4;
    static constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

    struct Node {
        OrientedBox box;
        std::uint32_t first = 0, last = 0;  // of the places in the order
        std::uint32_t behind = 0;           // the next node that is not below this one
        std::array<std::uint32_t, 3> common{kNoVertex, kNoVertex, kNoVertex};  // vertices of all triangles within

        [[nodiscard]] bool is_leaf() const { return last - first <= kLeaf; }
        [[nodiscard]] bool has_in_common_with(const Node& other) const;
    };

    // reach: how far each vertex may move. Triangles that name a vertex twice are left out.
    OrientedTree(const geometry::TriangleMesh& mesh, const Fans& fans, std::span<const double> reach);

    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] std::uint32_t triangle_at(std::size_t place) const { return order_[place]; }

private:
    class Builder;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

}  // namespace burin::compute
