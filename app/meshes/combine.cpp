// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <filesystem>

#include "app/carve/report.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/output_files.hpp"
#include "base/clock.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "geometry/mesh/mesh_placing.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/workpiece.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

// Names the material of a mesh without any after its file, so that b's does not pass for a's in the result.
void name_materials(sculpt::ClosedMesh& closed, const std::string& file, const std::array<std::uint8_t, 3>& colour) {
    if (!closed.mesh.materials.empty()) return;
    closed.mesh.materials = {{std::filesystem::path(file).stem().string(), colour}};
}

Result<compute::Solid> convert_onto(sculpt::ClosedMesh& closed, const std::string& file,
                                    const compute::Lattice& lattice, WorkerPool& pool, Json& report) {
    Result<compute::ScanConversion> converted = compute::scan_convert_onto(closed.mesh, lattice, pool);
    if (!converted) {
        Error error = converted.error();
        if (error.where == "mesh") error.where = file;
        return std::unexpected(error);
    }
    report = closed.report;
    report["unmatched_rays"] = converted->unmatched_rays;
    report["inside_by_parity"] = converted->by_parity;
    sculpt::note_unmet_parts(closed.mesh, converted->solid, closed.size, report);
    return std::move(converted->solid);
}

const char* text(compute::Combination operation) {
    switch (operation) {
        case compute::Combination::subtract: return "difference";
        case compute::Combination::intersect: return "intersection";
        case compute::Combination::unite: break;
    }
    return "union";
}

void print(const Json& report) {
    const Json& mesh = report["mesh"];
    std::printf(
        "%s of %s and %s: %zu triangles, volume %g cm3; %zu open, %zu non-manifold, %zu wrongly oriented edges\n",
        report["operation"].get<std::string>().c_str(), report["a"]["source"].get<std::string>().c_str(),
        report["b"]["source"].get<std::string>().c_str(), mesh["triangles"].get<std::size_t>(),
        1e6 * mesh["volume_m3"].get<double>(), mesh["open_edges"].get<std::size_t>(),
        mesh["nonmanifold_edges"].get<std::size_t>(), mesh["misoriented_edges"].get<std::size_t>());
}

}  // namespace

Result<void> combine_files(const CombineOptions& options) {
    session::InputFiles inputs;
    inputs.mesh(options.a).mesh(options.b);
    if (const auto ok = check_outputs(options.exports, options.report, inputs.list()); !ok) return ok;
    const auto load = [&](const std::string& file) {
        return sculpt::load_closed_mesh(
            {.source = file, .close_holes = options.close_holes, .units = options.units, .weld_m = options.weld_m});
    };
    Result<sculpt::ClosedMesh> a = load(options.a);
    if (!a) return std::unexpected(a.error());
    Result<sculpt::ClosedMesh> b = load(options.b);
    if (!b) return std::unexpected(b.error());
    name_materials(*a, options.a, {205, 195, 178});
    name_materials(*b, options.b, {224, 142, 54});

    Box bounds = geometry::bounds_of(a->mesh);
    const Box of_b = geometry::bounds_of(b->mesh);
    bounds.include(of_b.lo);
    bounds.include(of_b.hi);
    const Result<compute::Lattice> lattice = compute::lattice_around(bounds, options.resolution);
    if (!lattice) return std::unexpected(lattice.error());
    for (const std::string& path : options.exports) {
        if (const auto ok = sculpt::check_precision(path, *lattice); !ok) return ok;
    }

    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    WorkerPool pool(options.threads);
    Json report = {{"burin", BURIN_VERSION}, {"operation", text(options.operation)}};
    const Result<compute::Solid> solid_a = convert_onto(*a, options.a, *lattice, pool, report["a"]);
    if (!solid_a) return std::unexpected(solid_a.error());
    const Result<compute::Solid> solid_b = convert_onto(*b, options.b, *lattice, pool, report["b"]);
    if (!solid_b) return std::unexpected(solid_b.error());
    const Result<compute::Solid> result = compute::combine(*solid_a, *solid_b, options.operation, pool);
    if (!result) return std::unexpected(result.error());
    compute::Surface surface(*lattice);
    surface.mesh_all(*result, pool);
    const LengthUnit unit = options.export_units.value_or(a->unit);
    const Result<sculpt::FinishedMesh> finished = sculpt::finish_mesh(surface, *result, unit, std::nullopt, 0.0, pool);
    if (!finished) return std::unexpected(finished.error());
    const geometry::TriangleMesh& mesh = finished->mesh;
    if (mesh.triangles.empty() && !finished->too_thin.empty()) {
        return fail(
            options.a + " and " + options.b,
            "leave nothing that shows: of their " + std::string(text(options.operation)) + " " + finished->too_thin,
            "raise --resolution, or make it thicker");
    }
    if (mesh.triangles.empty()) {
        return fail(options.a + " and " + options.b,
                    "leave nothing: their " + std::string(text(options.operation)) + " is empty (" + a->size + "; " +
                        b->size + ")",
                    "check where the two lie and their units, or choose another --operation");
    }
    report["lattice_cells"] = lattice->cells;
    report["lattice_spacing_m"] = lattice->spacing_m;
    report["disagreeing_edges"] = surface.disagreeing_edges();
    report["mesh"] = describe_mesh(mesh, unit);
    report["mesh"]["self_intersections"] = finished->self_intersections;
    report["slivers"] = finished->slivers;
    report["export_unit"] = name_of(unit);
    std::printf("%s\n%s\n", a->size.c_str(), b->size.c_str());
    for (const std::string& path : options.exports) {
        if (const auto written = sculpt::export_finished(*finished, path); !written) return written;
        std::printf("%s: written in %s\n", path.c_str(), descriptor_of(unit).plural);
        if (sculpt::loses_colours(finished->mesh, path)) std::printf("  %s\n", sculpt::kColoursLeftOut);
        report["exports"].push_back(std::filesystem::path(path).filename().string());
    }
    report["timing"] = {{"total_ms", static_cast<double>(clock.now_ns() - start_ns) * 1e-6}};
    if (!options.report.empty()) {
        if (const auto written = write_report(options.report, report); !written) return written;
    }
    print(report);
    return {};
}

}  // namespace burin::app
