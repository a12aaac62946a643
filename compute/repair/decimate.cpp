// SPDX-License-Identifier: MIT
#include "compute/repair/decimate.hpp"

#include <algorithm>

#include "base/try.hpp"
#include "compute/repair/self_intersections.hpp"

namespace burin::compute {
namespace {

constexpr int kAttempts = 6;

// Adds to `keep` the vertices of the first mesh's triangles that come within `margin_m` of an intersection. With all of
// them kept, the first surface is restored there.
void keep_around(const geometry::TriangleMesh& first, const geometry::TriangleMesh& now,
                 std::span<const TrianglePair> pairs, double margin_m, std::vector<std::uint32_t>& keep) {
    const geometry::TriangleTree tree(first.positions_m, first.triangles);
    for (const TrianglePair& pair : pairs) {
        // The triangles intersect where their two boxes overlap.
        Box common;
        std::array<Box, 2> boxes;
        for (std::size_t i = 0; i < 2; ++i) {
            for (const std::uint32_t v : now.triangles[pair[i]]) boxes[i].include(now.positions_m[v]);
        }
        common.lo = glm::max(boxes[0].lo, boxes[1].lo) - margin_m;
        common.hi = glm::min(boxes[0].hi, boxes[1].hi) + margin_m;
        tree.for_each_meeting(tree.box_of(common), 0, [&](std::size_t place) {
            const auto& corners = first.triangles[tree.triangle_at(place)];
            keep.insert(keep.end(), corners.begin(), corners.end());
        });
    }
    std::ranges::sort(keep);
    keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
}

}  // namespace

Result<ThinnedOut> decimate(const geometry::TriangleMesh& mesh, double bound_m, WorkerPool& pool,
                            const std::function<void(double)>& show) {
    geometry::SimplifyOptions options;
    options.bound_m = bound_m;
    options.for_each = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
        pool.run(count, [&](std::size_t i) { task(i); });
    };
    ThinnedOut result;
    result.triangles_before = mesh.triangles.size();
    result.bound_m = bound_m;
    result.self_intersections_before = self_intersections(mesh, pool).size();
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        options.show = [&](double share) {
            if (show) show(1.0 - (1.0 - share) / (attempt + 1));
        };
        BURIN_TRY(simplified, geometry::simplify(mesh, options));
        const std::vector<TrianglePair> pairs = self_intersections(simplified.mesh, pool);
        if (pairs.size() <= result.self_intersections_before) {
            result.mesh = std::move(simplified.mesh);
            result.error_m = simplified.error_m;
            result.self_intersections = pairs.size();
            return result;
        }
        // The margin doubles with each attempt, because what was moved away from one place may meet the next.
        keep_around(mesh, simplified.mesh, pairs, 2.0 * bound_m * static_cast<double>(1 << attempt), options.keep);
    }
    result.mesh = mesh;
    result.self_intersections = result.self_intersections_before;
    return result;
}

}  // namespace burin::compute
