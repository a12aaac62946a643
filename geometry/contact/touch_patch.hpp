// SPDX-License-Identifier: MIT
// The snapshot that a TouchMesh (geometry/contact/touch_mesh.hpp) hands to the haptic thread: immutable patches of
// neighbouring triangles under a tree of boxes, and the search for the few triangles near the tool.
//
// Layout: a patch holds up to 256 triangles in leaves of 16; nodes hold up to 16 patches, or 16 nodes. An edit makes
// new patches where it changes triangles and new nodes on the way up to the root; all else is shared with the snapshot
// before. A query for a point of a mesh of 2 million triangles reads 4 nodes, a patch or two and a leaf or two, each of
// 2 or 3 cache lines.
// Frame: positions are float metres relative to origin_object. A triangle's number counts the tree's triangles from
// left to right and holds for one snapshot only; mesh_triangle gives its index in the mesh.
// Threads: any thread may read; only the publisher makes and destroys references. Queries do not allocate, lock or
// throw.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/contact/surface_points.hpp"
#include "geometry/contact/touch_boxes.hpp"
#include "geometry/mesh/componentwise.hpp"
#include "geometry/mesh/triangle.hpp"

namespace burin::geometry {

// The common part of patches and nodes.
struct TouchPart {
    TouchFrame frame;
    std::uint32_t triangles = 0;
    std::uint32_t count = 0;  // leaves of a patch; children of a node
    double edge_sum_m = 0.0;  // sum of the triangles' edges; a shared edge counts twice
};

struct TouchPatch : TouchPart {
    static constexpr std::uint32_t kMostTriangles = TouchBoxes::kMost * TouchBoxes::kMost;

    struct Leaf {
        TouchBoxes boxes;
        std::array<std::array<std::uint16_t, 3>, TouchBoxes::kMost> corners{};  // indices of vertices
        // The leaf's own vertices: those that no leaf before it has. They come in a row, up to the next leaf's.
        std::uint16_t first_vertex = 0;
        float longest_edge_m = 0.0f;  // of its triangles
        TriangleSlab slab;
    };
    TriangleSlab slab;
    TouchBoxes boxes;  // bounds of the leaves
    std::vector<Leaf> leaves;
    // A mesh vertex on a sharp edge appears here once for each smooth piece, with the same position and another normal.
    std::vector<Vec3f> positions_m;
    std::vector<Vec3f> normals;
    std::vector<std::uint32_t> mesh_triangles;  // index in the mesh of each triangle

    [[nodiscard]] const std::array<std::uint16_t, 3>& corners(std::uint32_t i) const noexcept {
        return leaves[i / TouchBoxes::kMost].corners[i % TouchBoxes::kMost];
    }
    [[nodiscard]] std::uint32_t vertices_end(std::uint32_t leaf) const noexcept {
        return leaf + 1 < count ? leaves[leaf + 1].first_vertex : static_cast<std::uint32_t>(positions_m.size());
    }
    [[nodiscard]] std::uint32_t in_leaf(std::uint32_t leaf) const noexcept {
        return std::min(TouchBoxes::kMost, triangles - leaf * TouchBoxes::kMost);
    }
};

struct TouchNode : TouchPart {
    TouchBoxes boxes;        // bounds of the children
    bool of_patches = true;  // else the children are nodes
    std::array<std::uint32_t, TouchBoxes::kMost>
        first_triangle{};  // number of each child's first triangle, counted from this node's first
    std::array<std::shared_ptr<const TouchPart>, TouchBoxes::kMost> children;

    [[nodiscard]] const TouchPatch& patch(std::uint32_t i) const noexcept {
        return static_cast<const TouchPatch&>(*children[i]);
    }
    [[nodiscard]] const TouchNode& node(std::uint32_t i) const noexcept {
        return static_cast<const TouchNode&>(*children[i]);
    }
};

struct TouchSnapshot {
    // levels of nodes: more than triangles numbered in 32 bits can fill
    static constexpr std::uint32_t kMostLevels = 16;

    Vec3 origin_object{0.0};
    std::shared_ptr<const TouchNode> root;  // never null; without children when the mesh has no triangle left

    [[nodiscard]] std::uint32_t triangles() const noexcept { return root->triangles; }
    [[nodiscard]] double mean_edge_m() const noexcept {
        return root->triangles > 0 ? root->edge_sum_m / (3.0 * root->triangles) : 0.0;
    }
    // Returns a box that contains all triangles, relative to origin_object; empty when there are none.
    [[nodiscard]] Box bounds() const noexcept {
        return root->triangles > 0 ? Box{Vec3(root->frame.lo), Vec3(root->frame.hi)} : Box{};
    }

    // These functions require a number below triangles().
    [[nodiscard]] Triangle triangle(std::uint32_t number) const noexcept;
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t number) const noexcept;
    [[nodiscard]] std::uint32_t mesh_triangle(std::uint32_t number) const noexcept;

private:
    struct Place {
        const TouchPatch* patch = nullptr;
        std::uint32_t triangle = 0;  // number within the patch
    };
    [[nodiscard]] Place place_of(std::uint32_t number) const noexcept;
};

inline TouchSnapshot::Place TouchSnapshot::place_of(std::uint32_t number) const noexcept {
    for (const TouchNode* node = root.get();;) {
        // Finds the last child that does not begin after the number; of several that begin there, the last has
        // triangles.
        std::uint32_t child = node->count - 1;
        while (node->first_triangle[child] > number || node->children[child]->triangles == 0) --child;
        number -= node->first_triangle[child];
        if (node->of_patches) return {&node->patch(child), number};
        node = &node->node(child);
    }
}

inline Triangle TouchSnapshot::triangle(std::uint32_t number) const noexcept {
    const auto [patch, i] = place_of(number);
    const auto& corner = patch->corners(i);
    const auto at = [&](std::size_t k) { return Vec3(patch->positions_m[corner[k]]); };
    return {at(0), at(1), at(2)};
}

inline CornerNormals TouchSnapshot::corner_normals(std::uint32_t number) const noexcept {
    const auto [patch, i] = place_of(number);
    const auto& corner = patch->corners(i);
    const auto at = [&](std::size_t k) { return patch->normals[corner[k]]; };
    const CornerNormals all{true, {at(0), at(1), at(2)}};
    const auto is_none = [](const Vec3f& n) { return n == Vec3f(0.0f); };
    return std::ranges::any_of(all.normals, is_none) ? CornerNormals{} : all;
}

inline std::uint32_t TouchSnapshot::mesh_triangle(std::uint32_t number) const noexcept {
    const auto [patch, i] = place_of(number);
    return patch->mesh_triangles[i];
}

// One search in progress: holds the query in float.
class TouchSearch {
public:
    explicit TouchSearch(Near& near) noexcept : near_(near), lo_(near.lo), hi_(near.hi) { widen(); }

    // Points are visited relative to the surface's origin, from which the mesh's is `shift`.
    template <typename Visitor>
    bool run(const TouchNode& root, const Visitor& visit, const Vec3& shift = Vec3(0.0)) {
        const PointGate gate(near_, Vec3(0.0));
        struct Step {
            const TouchNode* node;
            std::uint32_t first, left;  // number of the node's first triangle; bits of children still to be searched
        };
        std::array<Step, TouchSnapshot::kMostLevels> way;
        std::uint32_t depth = 0;
        const auto enter = [&](const TouchNode& node, std::uint32_t first) {
            if (!near_.look()) return false;
            way[depth++] = {&node, first, node.boxes.meeting(stepped(node.frame), node.count)};
            return true;
        };
        if (!enter(root, 0)) return false;
        while (depth > 0) {
            Step& at = way[depth - 1];
            if (at.left == 0) {
                --depth;
                continue;
            }
            const auto child = static_cast<std::uint32_t>(std::countr_zero(at.left));
            at.left &= at.left - 1;
            const std::uint32_t first = at.first + at.node->first_triangle[child];
            if (!(at.node->of_patches ? in_patch(at.node->patch(child), first, visit, gate, shift)
                                      : enter(at.node->node(child), first)))
                return false;
        }
        return true;
    }

private:
    template <typename Visitor>
    bool in_patch(const TouchPatch& patch, std::uint32_t first, const Visitor& visit, const PointGate& gate,
                  const Vec3& shift) {
        if (!near_.look()) return false;
        if (!within_reach(patch.frame.lo, patch.frame.hi)) return true;
        if (skips(visit, Box{Vec3(patch.frame.lo), Vec3(patch.frame.hi)}, patch.slab, shift)) return true;
        const SteppedBox asked = stepped(patch.frame);
        const Vec3f step_m = 1.0f / patch.frame.steps_per_m;
        for (std::uint32_t leaves = patch.boxes.meeting(asked, patch.count); leaves != 0; leaves &= leaves - 1) {
            const auto number = static_cast<std::uint32_t>(std::countr_zero(leaves));
            if (!near_.look()) return false;
            const Vec3f lo = patch.frame.lo + step_m * patch.boxes.lo_of(number),
                        hi = patch.frame.lo + step_m * (patch.boxes.hi_of(number) + 1.0f);
            if (!within_reach(lo, hi)) continue;
            const TouchPatch::Leaf& leaf = patch.leaves[number];
            if (skips(visit, Box{Vec3(lo), Vec3(hi)}, leaf.slab, shift)) continue;
            if constexpr (Visitor::kWantsPoints)
                // A vertex that it shares with a leaf before it is within reach where that leaf is, and visited there.
                if (leaf.longest_edge_m <= visit.fineness.longest_edge_m) {
                    const PointRange range{leaf.first_vertex, patch.vertices_end(number), visit.fineness.stride};
                    if (!for_each_point_near(patch.positions_m, patch.normals, range, shift, gate, near_, visit.point))
                        return false;
                    continue;
                }
            for (std::uint32_t left = leaf.boxes.meeting(asked, patch.in_leaf(number)); left != 0; left &= left - 1) {
                const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
                if (!in_triangle(patch, leaf.corners[i], first + number * TouchBoxes::kMost + i, visit)) return false;
            }
        }
        return true;
    }

    template <typename Visitor>
    bool in_triangle(const TouchPatch& patch, const std::array<std::uint16_t, 3>& corner, std::uint32_t number,
                     const Visitor& visit) {
        if (near_.passes_by()) return true;
        if (!near_.look()) return false;
        const Vec3f &a = patch.positions_m[corner[0]], &b = patch.positions_m[corner[1]],
                    &c = patch.positions_m[corner[2]];
        if (!within_reach(lower_of(lower_of(a, b), c), upper_of(upper_of(a, b), c))) return true;
        const double reach = near_.reach_m;
        if (!visit.triangle(number, Triangle{Vec3(a), Vec3(b), Vec3(c)})) return false;
        if (near_.reach_m != reach) widen();
        return true;
    }

    [[nodiscard]] SteppedBox stepped(const TouchFrame& frame) const noexcept { return frame.stepped(from_, to_); }

    // Rejects boxes that meet the box around the query ball but lie beside the ball, as most do.
    [[nodiscard]] bool within_reach(const Vec3f& lo, const Vec3f& hi) const noexcept {
        const Vec3f outside = upper_of(upper_of(lo - hi_, lo_ - hi), Vec3f(0.0f));
        return glm::dot(outside, outside) <= reach2_;
    }

    void widen() noexcept {
        // Enlarges the box by slightly more than the rounding to float can remove.
        const Vec3 size = upper_of(glm::abs(near_.lo), glm::abs(near_.hi)) + near_.reach_m;
        const double rounding = 4e-7 * std::max({size.x, size.y, size.z});
        const double reach = near_.reach_m * (1.0 + 1e-6) + rounding;
        from_ = Vec3f(near_.lo - reach);
        to_ = Vec3f(near_.hi + reach);
        reach2_ = static_cast<float>(reach * reach);
    }

    Near& near_;
    Vec3f from_{0.0f}, to_{0.0f};
    Vec3f lo_{0.0f}, hi_{0.0f};  // the query box without its reach
    float reach2_ = 0.0f;
};

// Visits triangles and points as for_each_near(LocalSurface) does (geometry/contact/local_surface_search.hpp).
// Triangles come by their number and relative to the snapshot's origin; points come relative to the surface's origin,
// from which the snapshot's is `shift`. A look is a test of sixteen boxes of a node, a patch or a leaf, of one
// triangle, or of four points.
template <typename Visitor>
bool for_each_near(const TouchSnapshot& snapshot, Near& near, const Visitor& visit, const Vec3& shift = Vec3(0.0)) {
    // A NaN in the query box meets nothing.
    if (snapshot.triangles() == 0 || !(glm::dot(near.lo, near.hi) + near.reach_m < HUGE_VAL)) return true;
    return TouchSearch(near).run(*snapshot.root, visit, shift);
}

}  // namespace burin::geometry
