// SPDX-License-Identifier: MIT
#include "sculpt/finishing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "base/progress.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/repair/self_intersections.hpp"
#include "compute/repair/slivers.hpp"
#include "geometry/files/mesh_export.hpp"
#include "geometry/files/mesh_import.hpp"

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

Json describe(const compute::SliverReport& slivers, const compute::Lattice& lattice) {
    Json json = {{"solid", slivers.solid}, {"gaps", slivers.gaps}};
    if (slivers.count() == 0) return json;
    json["thinnest_m"] = slivers.thinnest_m;
    json["median_m"] = slivers.median_m;
    if (const auto resolution = compute::resolution_that_shows(slivers, lattice)) json["resolution"] = *resolution;
    json["where_m"] = {{"lo", as_json(slivers.bounds_object_m.lo)}, {"hi", as_json(slivers.bounds_object_m.hi)}};
    for (const compute::Sliver& s : slivers.first) {
        json["first"].push_back({{"place_m", as_json(s.place_object_m)},
                                 {"thickness_m", s.thickness_m},
                                 {"axis", std::string(1, "xyz"[s.axis])},
                                 {"kind", s.is_gap ? "gap" : "solid"}});
    }
    return json;
}

std::string too_thin(const compute::SliverReport& slivers, const compute::Lattice& lattice) {
    if (slivers.count() == 0) return "";
    const std::optional<int> resolution = compute::resolution_that_shows(slivers, lattice);
    return formatted(
               "%llu places are thinner than the mesh can show (the report's \"slivers\"); the solid keeps them: ",
               static_cast<unsigned long long>(slivers.count())) +
           "a cell is " + in_millimetres(lattice.spacing_m) + " wide, the thinnest of them " +
           in_millimetres(slivers.thinnest_m) + ", half of them at least " + in_millimetres(slivers.median_m) +
           (resolution ? formatted(", which --resolution %d shows", *resolution)
                       : formatted(", which no --resolution up to %d shows", compute::kMaxResolution));
}

}  // namespace

Result<void> check_precision(const std::string& path, const compute::Lattice& lattice) {
    if (lattice.fits_floats() || geometry::mesh_format_of(path) == geometry::MeshFormat::obj) return {};
    return fail(path,
                "would hold single-precision numbers, which cannot tell the workpiece's details apart so far from its "
                "origin",
                "move the workpiece to its origin (burin convert IN OUT.obj --center), or export .obj");
}

bool loses_colours(const geometry::TriangleMesh& mesh, const std::string& path) {
    if (geometry::mesh_format_of(path) != geometry::MeshFormat::stl) return false;
    const auto differ = [](const auto& values) {
        return std::ranges::adjacent_find(values, std::ranges::not_equal_to{}) != values.end();
    };
    return differ(mesh.colours) || differ(mesh.triangle_materials);
}

Result<void> check_simplification(std::optional<double> bound_m) {
    if (!bound_m || (std::isfinite(*bound_m) && *bound_m > 0.0)) return {};
    return fail("--simplify", "needs a distance above zero",
                "give how far the surface may move, in metres, or leave the option out");
}

Result<SimplifiedMesh> simplify_with_progress(const geometry::TriangleMesh& numbers, LengthUnit unit, double bound_m,
                                              WorkerPool& pool) {
    Progress progress("simplifying");
    Result<compute::ThinnedOut> decimated =
        compute::decimate(numbers, from_metres(bound_m, unit), pool, [&](double done) { progress.show(done); });
    if (!decimated) return std::unexpected(decimated.error());
    Json figures = {{"triangles_before", decimated->triangles_before},
                    {"triangles_after", decimated->mesh.triangles.size()},
                    {"bound_m", bound_m},
                    {"error_max_m", to_metres(decimated->error_m, unit)},
                    {"self_intersections", decimated->self_intersections}};
    return SimplifiedMesh{std::move(decimated->mesh), std::move(figures)};
}

Result<FinishedMesh> finish_mesh(const compute::Surface& surface, const compute::Solid& solid, LengthUnit unit,
                                 std::optional<double> simplify_bound_m, double crumbs_m, WorkerPool& pool) {
    FinishedMesh finished{surface.welded(unit), unit, {}, {}, {}, {}, {}};
    const compute::RepairReport repair = compute::repair_intersections(finished.mesh, surface, solid, pool, unit);
    finished.self_intersections = describe(repair);
    if (repair.left > 0) {
        std::fprintf(stderr, "burin: %llu pairs of triangles still pass through each other\n",
                     static_cast<unsigned long long>(repair.left));
    }
    if (repair.vertices_moved > 0) {
        std::printf(
            "  repaired %llu pairs of triangles that passed through each other; for that, vertices lie up to %s "
            "farther from the surface\n",
            static_cast<unsigned long long>(repair.found - repair.left),
            in_millimetres(repair.deviation_max_m).c_str());
    }
    const compute::SliverReport slivers = compute::find_slivers(solid, pool);
    finished.slivers = describe(slivers, solid.lattice);
    finished.too_thin = too_thin(slivers, solid.lattice);
    finished.thin_places = slivers.count();
    if (!finished.too_thin.empty()) std::printf("  %s\n", finished.too_thin.c_str());
    finished.crumbs = geometry::drop_crumbs(finished.mesh, unit, crumbs_m);
    if (simplify_bound_m) {
        BURIN_TRY(simplified, simplify_with_progress(finished.mesh, unit, *simplify_bound_m, pool));
        finished.mesh = std::move(simplified.mesh);
        finished.simplification = std::move(simplified.figures);
        finished.self_intersections["left"] = finished.simplification["self_intersections"];
    }
    return finished;
}

Result<void> export_finished(const FinishedMesh& finished, const std::string& path) {
    return geometry::export_numbers(finished.mesh, path, finished.unit);
}

}  // namespace burin::sculpt
