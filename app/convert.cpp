// SPDX-License-Identifier: MIT
#include <cstdio>

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

Result<void> convert(const std::string& in, const std::string& out, bool close) {
    Result<ImportedMesh> imported = import_mesh(in);
    if (!imported) return std::unexpected(imported.error());
    TriangleMesh& mesh = imported->mesh;
    std::printf("%s: %s, %zu triangles, %zu vertices\n", in.c_str(), imported->report.format.c_str(),
                mesh.triangles.size(), mesh.positions_m.size());
    for (const std::string& remark : imported->report.remarks) std::printf("  %s\n", remark.c_str());
    print_health(mesh);
    if (close) {
        weld_vertices(mesh);
        const ClosingReport closing = close_holes(mesh);
        const OrientationReport turned = orient_outward(mesh);
        std::printf("  closed %zu holes with %zu triangles; turned %zu triangles\n", closing.holes.size(),
                    closing.triangles_added, turned.triangles_turned);
        print_health(mesh);
    }
    return export_mesh(mesh, out);
}

}  // namespace burin
