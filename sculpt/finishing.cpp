// SPDX-License-Identifier: MIT
#include "app/finishing.hpp"

#include <cmath>
#include <cstdio>

#include "app/progress.hpp"
#include "compute/mend_intersections.hpp"
#include "compute/slivers.hpp"

namespace burin {
namespace {

Json as_json(const Vec3& p) { return {p.x, p.y, p.z}; }

Json describe(const MendingReport& mending) {
    return {{"found", mending.found},
            {"mended", mending.found - mending.left},
            {"left", mending.left},
            {"diagonals_turned", mending.diagonals_turned},
            {"vertices_moved", mending.vertices_moved},
            {"deviation_max_m", mending.deviation_max_m}};
}

Json describe(const SliverReport& slivers) {
    Json json = {{"solid", slivers.solid}, {"gaps", slivers.gaps}};
    if (slivers.count() == 0) return json;
    json["thinnest_m"] = slivers.thinnest_m;
    json["where_m"] = {{"lo", as_json(slivers.bounds_object_m.lo)}, {"hi", as_json(slivers.bounds_object_m.hi)}};
    for (const Sliver& s : slivers.first) {
        json["first"].push_back({{"place_m", as_json(s.place_object_m)},
                                 {"thickness_m", s.thickness_m},
                                 {"axis", std::string(1, "xyz"[s.axis])},
                                 {"kind", s.is_gap ? "gap" : "solid"}});
    }
    return json;
}

}  // namespace

Result<void> check_simplification(std::optional<double> bound_m) {
    if (!bound_m || (std::isfinite(*bound_m) && *bound_m > 0.0)) return {};
    return fail("--simplify", "needs a distance above zero",
                "give how far the surface may move, in metres, or leave the option out");
}

Result<SimplifiedMesh> simplify_with_progress(const TriangleMesh& mesh, double bound_m, WorkerPool& pool) {
    Progress progress("simplifying");
    Result<ThinnedOut> thinned = thin_out(mesh, bound_m, pool, [&](double done) { progress.show(done); });
    if (!thinned) return std::unexpected(thinned.error());
    Json figures = {{"triangles_before", thinned->triangles_before},
                    {"triangles_after", thinned->mesh.triangles.size()},
                    {"bound_m", thinned->bound_m},
                    {"error_max_m", thinned->error_m},
                    {"self_intersections", thinned->self_intersections}};
    return SimplifiedMesh{std::move(thinned->mesh), std::move(figures)};
}

Result<FinishedMesh> finish_mesh(const Surface& surface, const Solid& solid, std::optional<double> simplify_bound_m,
                                 WorkerPool& pool) {
    FinishedMesh finished;
    finished.mesh = surface.welded();
    const MendingReport mending = mend_intersections(finished.mesh, surface, solid, pool);
    finished.self_intersections = describe(mending);
    if (mending.left > 0) {
        std::fprintf(stderr, "burin: %llu pairs of triangles still pass through each other\n",
                     static_cast<unsigned long long>(mending.left));
    }
    const SliverReport slivers = find_slivers(solid, pool);
    finished.slivers = describe(slivers);
    if (slivers.count() > 0) {
        std::printf(
            "  %llu places are thinner than the mesh can show (the report's \"slivers\"); the solid keeps them\n",
            static_cast<unsigned long long>(slivers.count()));
    }
    if (simplify_bound_m) {
        Result<SimplifiedMesh> simplified = simplify_with_progress(finished.mesh, *simplify_bound_m, pool);
        if (!simplified) return std::unexpected(simplified.error());
        finished.mesh = std::move(simplified->mesh);
        finished.simplification = std::move(simplified->figures);
    }
    return finished;
}

}  // namespace burin
