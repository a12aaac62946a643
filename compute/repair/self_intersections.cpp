// SPDX-License-Identifier: MIT
#include "compute/repair/self_intersections.hpp"

#include <algorithm>

#include "geometry/mesh/triangle_contact.hpp"
#include "geometry/mesh/triangle_tree.hpp"

namespace burin::compute {
namespace {

// Number of tree positions per task: enough to make dispatching a task cheap, few enough to share the work evenly.
constexpr std::size_t kPlacesATask = 4096;

// Adds the pairs whose first triangle, in the tree's order, is at one of the positions first .. last - 1.
void collect(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree, std::size_t first,
             std::size_t last, std::vector<TrianglePair>& pairs) {
    // Tests one leaf at a time: its triangles are neighbours and meet nearly the same boxes.
    for (std::size_t leaf = first; leaf < last; leaf += geometry::TriangleTree::kBranches) {
        const std::size_t leaf_end = std::min(leaf + geometry::TriangleTree::kBranches, last);
        geometry::TreeBox box;
        for (std::size_t p = leaf; p < leaf_end; ++p) box.include(tree.box_at(p));
        tree.for_each_meeting(box, leaf + 1, [&](std::size_t other) {
            for (std::size_t p = leaf; p < std::min(leaf_end, other); ++p) {
                if (!tree.box_at(p).meets(tree.box_at(other))) continue;
                const std::uint32_t a = tree.triangle_at(p), b = tree.triangle_at(other);
                if (geometry::meet_beyond_shared(mesh.positions_m, mesh.triangles[a], mesh.triangles[b])) {
                    pairs.push_back({std::min(a, b), std::max(a, b)});
                }
            }
        });
    }
}

}  // namespace

std::vector<TrianglePair> self_intersections(const geometry::TriangleMesh& mesh, WorkerPool& pool) {
    const geometry::TriangleTree tree(mesh.positions_m, mesh.triangles);
    const std::size_t tasks = (tree.size() + kPlacesATask - 1) / kPlacesATask;
    std::vector<std::vector<TrianglePair>> of_task(tasks);
    pool.run(tasks, [&](std::size_t task) {
        const std::size_t first = task * kPlacesATask;
        collect(mesh, tree, first, std::min(first + kPlacesATask, tree.size()), of_task[task]);
    });
    std::vector<TrianglePair> pairs;
    for (const auto& found : of_task) pairs.insert(pairs.end(), found.begin(), found.end());
    std::ranges::sort(pairs);
    return pairs;
}

}  // namespace burin::compute
