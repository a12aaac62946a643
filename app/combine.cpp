// SPDX-License-Identifier: MIT
#include "app/combine.hpp"

#include <cstdio>
#include <filesystem>

#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/workpiece.hpp"
#include "base/clock.hpp"
#include "compute/scan_convert.hpp"
#include "compute/surface.hpp"
#include "geometry/mesh_export.hpp"

namespace burin {
namespace {

// b's materials must not pass for a's when neither file names any.
void name_materials(ClosedMesh& closed, const std::string& file, const std::array<std::uint8_t, 3>& colour) {
    if (!closed.mesh.materials.empty()) return;
    closed.mesh.materials = {{std::filesystem::path(file).stem().string(), colour}};
}

Result<Solid> convert_onto(const ClosedMesh& closed, const std::string& file, const Lattice& lattice, WorkerPool& pool,
                           Json& report) {
    Result<ScanConversion> converted = scan_convert_onto(closed.mesh, lattice, pool);
    if (!converted) {
        Error error = converted.error();
        if (error.where == "mesh") error.where = file;
        return std::unexpected(error);
    }
    report = closed.report;
    report["unmatched_rays"] = converted->unmatched_rays;
    report["inside_by_parity"] = converted->by_parity;
    return std::move(converted->solid);
}

const char* text(Combination operation) {
    switch (operation) {
        case Combination::subtract: return "difference";
        case Combination::intersect: return "intersection";
        case Combination::unite: break;
    }
    return "union";
}

void print(const Json& report) {
    const Json& mesh = report["mesh"];
    std::printf(
        "%s of %s and %s: %zu triangles, volume %g m3; %zu open, %zu non-manifold, %zu wrongly oriented edges\n",
        report["operation"].get<std::string>().c_str(), report["a"]["source"].get<std::string>().c_str(),
        report["b"]["source"].get<std::string>().c_str(), mesh["triangles"].get<std::size_t>(),
        mesh["volume_m3"].get<double>(), mesh["open_edges"].get<std::size_t>(),
        mesh["nonmanifold_edges"].get<std::size_t>(), mesh["misoriented_edges"].get<std::size_t>());
}

}  // namespace

Result<void> combine_files(const CombineOptions& options) {
    if (const auto ok = check_outputs(options.exports, options.report); !ok) return ok;
    Result<ClosedMesh> a = load_closed_mesh(options.a, options.close_holes);
    if (!a) return std::unexpected(a.error());
    Result<ClosedMesh> b = load_closed_mesh(options.b, options.close_holes);
    if (!b) return std::unexpected(b.error());
    name_materials(*a, options.a, {205, 195, 178});
    name_materials(*b, options.b, {224, 142, 54});

    Box bounds = bounds_of_triangles(a->mesh);
    const Box of_b = bounds_of_triangles(b->mesh);
    bounds.include(of_b.lo);
    bounds.include(of_b.hi);
    const Result<Lattice> lattice = lattice_around(bounds, options.resolution);
    if (!lattice) return std::unexpected(lattice.error());
    if (const auto ok = check_precision(options.exports, *lattice); !ok) return ok;

    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    WorkerPool pool(options.threads);
    Json report = {{"burin", BURIN_VERSION}, {"operation", text(options.operation)}};
    const Result<Solid> solid_a = convert_onto(*a, options.a, *lattice, pool, report["a"]);
    if (!solid_a) return std::unexpected(solid_a.error());
    const Result<Solid> solid_b = convert_onto(*b, options.b, *lattice, pool, report["b"]);
    if (!solid_b) return std::unexpected(solid_b.error());
    const Result<Solid> result = combine(*solid_a, *solid_b, options.operation, pool);
    if (!result) return std::unexpected(result.error());
    Surface surface(*lattice);
    surface.mesh_all(*result, pool);
    const TriangleMesh mesh = surface.welded();
    if (mesh.triangles.empty()) {
        return fail(options.a + " and " + options.b,
                    "leave nothing: their " + std::string(text(options.operation)) + " is empty",
                    "check where the two lie, or choose another --operation");
    }
    report["lattice_cells"] = lattice->cells;
    report["lattice_spacing_m"] = lattice->spacing_m;
    report["disagreeing_edges"] = surface.disagreeing_edges();
    report["mesh"] = describe_mesh(mesh);
    for (const std::string& path : options.exports) {
        if (const auto written = export_mesh(mesh, path); !written) return written;
        report["exports"].push_back(std::filesystem::path(path).filename().string());
    }
    report["timing"] = {{"total_ms", static_cast<double>(clock.now_ns() - start_ns) * 1e-6}};
    if (!options.report.empty()) {
        if (const auto written = write_report(options.report, report); !written) return written;
    }
    print(report);
    return {};
}

}  // namespace burin
