// SPDX-License-Identifier: MIT
#include "sculpt/finishing.hpp"

#include <cmath>
#include <cstdio>

#include "compute/repair/self_intersections.hpp"
#include "compute/repair/slivers.hpp"
#include "geometry/files/mesh_export.hpp"
#include "sculpt/progress.hpp"

namespace burin::sculpt {
namespace {

Json as_json(const Vec3& p) { return {p.x, p.y, p.z}; }

Json describe(const compute::RepairReport& repair) {
    return {{"found", repair.found},
            {"repaired", repair.found - repair.left},
            {"left", repair.left},
            {"diagonals_turned", repair.diagonals_turned},
            {"vertices_moved", repair.vertices_moved},
            {"deviation_max_m", repair.deviation_max_m}};
}

Json describe(const compute::SliverReport& slivers) {
    Json json = {{"solid", slivers.solid}, {"gaps", slivers.gaps}};
    if (slivers.count() == 0) return json;
    json["thinnest_m"] = slivers.thinnest_m;
    json["where_m"] = {{"lo", as_json(slivers.bounds_object_m.lo)}, {"hi", as_json(slivers.bounds_object_m.hi)}};
    for (const compute::Sliver& s : slivers.first) {
        json["first"].push_back({{"place_m", as_json(s.place_object_m)},
                                 {"thickness_m", s.thickness_m},
                                 {"axis", std::string(1, "xyz"[s.axis])},
                                 {"kind", s.is_gap ? "gap" : "solid"}});
    }
    return json;
}

}  // namespace

Result<void> check_precision(const std::string& path, const compute::Lattice& lattice) {
    if (lattice.fits_floats() || geometry::mesh_format_of(path) == geometry::MeshFormat::obj) return {};
    return fail(path,
                "would hold single-precision numbers, which cannot tell the workpiece's details apart so far from its "
                "origin",
                "move the workpiece nearer to its origin, or export .obj");
}

Result<void> check_simplification(std::optional<double> bound_m) {
    if (!bound_m || (std::isfinite(*bound_m) && *bound_m > 0.0)) return {};
    return fail("--simplify", "needs a distance above zero",
                "give how far the surface may move, in metres, or leave the option out");
}

Result<SimplifiedMesh> simplify_with_progress(const geometry::TriangleMesh& mesh, double bound_m, WorkerPool& pool) {
    Progress progress("simplifying");
    Result<compute::ThinnedOut> decimated =
        compute::decimate(mesh, bound_m, pool, [&](double done) { progress.show(done); });
    if (!decimated) return std::unexpected(decimated.error());
    Json figures = {{"triangles_before", decimated->triangles_before},
                    {"triangles_after", decimated->mesh.triangles.size()},
                    {"bound_m", decimated->bound_m},
                    {"error_max_m", decimated->error_m},
                    {"self_intersections", decimated->self_intersections}};
    return SimplifiedMesh{std::move(decimated->mesh), std::move(figures)};
}

Result<FinishedMesh> finish_mesh(const compute::Surface& surface, const compute::Solid& solid,
                                 std::optional<double> simplify_bound_m, WorkerPool& pool) {
    FinishedMesh finished;
    finished.mesh = surface.welded();
    const compute::RepairReport repair = compute::repair_intersections(finished.mesh, surface, solid, pool);
    finished.self_intersections = describe(repair);
    if (repair.left > 0) {
        std::fprintf(stderr, "burin: %llu pairs of triangles still pass through each other\n",
                     static_cast<unsigned long long>(repair.left));
    }
    const compute::SliverReport slivers = compute::find_slivers(solid, pool);
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

}  // namespace burin::sculpt
