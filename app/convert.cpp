// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/finishing.hpp"
#include "app/sculpt.hpp"
#include "geometry/mesh_export.hpp"
#include "geometry/mesh_health.hpp"
#include "geometry/mesh_import.hpp"
#include "geometry/mesh_mend.hpp"

namespace burin {

namespace {

void print_health(const TriangleMesh& mesh) {
    const MeshHealth health = examine(mesh);
    const Vec3 size = health.bounds_m.extent();
    std::printf("  size %g x %g x %g m, %zu shells, area %g m2, volume %g m3\n", size.x, size.y, size.z, health.shells,
                health.area_m2, health.signed_volume_m3);
    for (const std::string& complaint : complaints(health)) std::printf("  %s\n", complaint.c_str());
}

}  // namespace

Result<void> convert(const ConvertOptions& options) {
    if (const auto ok = check_simplification(options.simplify_m); !ok) return ok;
    Result<ImportedMesh> imported = import_mesh(options.in);
    if (!imported) return std::unexpected(imported.error());
    TriangleMesh& mesh = imported->mesh;
    std::printf("%s: %s, %zu triangles, %zu vertices\n", options.in.c_str(), imported->report.format.c_str(),
                mesh.triangles.size(), mesh.positions_m.size());
    for (const std::string& remark : imported->report.remarks) std::printf("  %s\n", remark.c_str());
    print_health(mesh);
    if (options.close_holes) {
        weld_vertices(mesh);
        const ClosingReport closing = close_holes(mesh);
        const OrientationReport turned = orient_outward(mesh);
        std::printf("  closed %zu holes with %zu triangles; turned %zu triangles\n", closing.holes.size(),
                    closing.triangles_added, turned.triangles_turned);
        print_health(mesh);
    }
    if (options.simplify_m) {
        weld_vertices(mesh);  // a format without shared vertices would leave every edge a border, and borders stay
        WorkerPool pool;
        Result<SimplifiedMesh> simplified = simplify_with_progress(mesh, *options.simplify_m, pool);
        if (!simplified) return std::unexpected(simplified.error());
        std::printf("  simplified from %zu to %zu triangles, at most %g m away (asked: %g m)\n", mesh.triangles.size(),
                    simplified->mesh.triangles.size(), simplified->figures["error_max_m"].get<double>(),
                    *options.simplify_m);
        mesh = std::move(simplified->mesh);
        print_health(mesh);
    }
    return export_mesh(mesh, options.out);
}

}  // namespace burin
