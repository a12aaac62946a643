// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdio>

#include "app/commands.hpp"
#include "app/output_files.hpp"
#include "geometry/files/mesh_export.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "sculpt/finishing.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {

namespace {

void print_health(const geometry::TriangleMesh& mesh) {
    const geometry::MeshHealth health = geometry::examine(mesh);
    std::printf("  size %s, %zu shells, area %g cm2, volume %g cm3\n", in_millimetres(health.bounds_m.extent()).c_str(),
                health.shells, 1e4 * health.area_m2, 1e6 * health.signed_volume_m3);
    for (const std::string& complaint : geometry::complaints(health)) std::printf("  %s\n", complaint.c_str());
}

// Checks that corners which differ still do so in the single-precision numbers of .stl and .ply.
Result<void> check_precision(const geometry::TriangleMesh& mesh, const std::string& out) {
    if (geometry::mesh_format_of(out) == geometry::MeshFormat::obj) return {};
    const auto fall_together = [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 &p = mesh.positions_m[a], &q = mesh.positions_m[b];
        return p != q && glm::vec3(p) == glm::vec3(q);
    };
    const auto collapses = [&](const std::array<std::uint32_t, 3>& t) {
        return fall_together(t[0], t[1]) || fall_together(t[1], t[2]) || fall_together(t[2], t[0]);
    };
    const auto lost = std::ranges::count_if(mesh.triangles, collapses);
    if (lost == 0) return {};
    return fail(out,
                "would hold single-precision numbers, in which " + std::to_string(lost) + " triangles have no area",
                "move the mesh nearer to its origin, or write .obj");
}

}  // namespace

Result<void> convert(const ConvertOptions& options) {
    if (const auto ok = sculpt::check_simplification(options.simplify_m); !ok) return ok;
    const std::vector<std::string> inputs = session::InputFiles().mesh(options.in).list();
    if (const auto ok = check_overwrites_none(options.out, inputs); !ok) return ok;
    if (const auto ok = check_outputs(std::array{options.out}, "", inputs); !ok) return ok;
    Result<geometry::ImportedMesh> imported = geometry::import_mesh(options.in, options.units);
    if (!imported) return std::unexpected(imported.error());
    geometry::TriangleMesh& mesh = imported->mesh;
    std::printf("%s: %s, %zu triangles, %zu vertices\n", options.in.c_str(), imported->report.format.c_str(),
                mesh.triangles.size(), mesh.positions_m.size());
    const geometry::ImportReport& report = imported->report;
    std::printf("%s\n", geometry::describe_size(options.in, report.size_m, report.unit).c_str());
    for (const std::string& remark : imported->report.remarks) std::printf("  %s\n", remark.c_str());
    print_health(mesh);
    if (options.close_holes) {
        geometry::weld_vertices(mesh);
        const geometry::ClosingReport closing = geometry::close_holes(mesh);
        const geometry::OrientationReport turned = geometry::orient_outward(mesh);
        std::printf("  closed %zu holes with %zu triangles; turned %zu triangles\n", closing.holes.size(),
                    closing.triangles_added, turned.triangles_turned);
        print_health(mesh);
    }
    if (options.simplify_m) {
        // Without shared vertices every edge would be a border, and decimation keeps borders.
        geometry::weld_vertices(mesh);
        WorkerPool pool;
        Result<sculpt::SimplifiedMesh> simplified = sculpt::simplify_with_progress(mesh, *options.simplify_m, pool);
        if (!simplified) return std::unexpected(simplified.error());
        std::printf("  simplified from %zu to %zu triangles, at most %s away (asked: %s)\n", mesh.triangles.size(),
                    simplified->mesh.triangles.size(),
                    in_millimetres(simplified->figures["error_max_m"].get<double>()).c_str(),
                    in_millimetres(*options.simplify_m).c_str());
        mesh = std::move(simplified->mesh);
        print_health(mesh);
    }
    if (const auto ok = check_precision(mesh, options.out); !ok) return ok;
    const LengthUnit unit = options.export_units.value_or(report.unit.unit);
    if (const auto written = geometry::export_mesh(mesh, options.out, unit); !written) return written;
    std::printf("%s: written in %s\n", options.out.c_str(), descriptor_of(unit).plural);
    return {};
}

}  // namespace burin::app
