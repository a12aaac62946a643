// SPDX-License-Identifier: MIT
#include "app/meshes/combine.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/carve/report.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/sculpt_options.hpp"
#include "base/clock.hpp"
#include "base/length_unit.hpp"
#include "base/try.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/lattice.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/rays/set_algebra.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "geometry/mesh/mesh_placing.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/load_workpiece.hpp"
#include "session/options/option_bounds.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

struct CombineOptions {
    std::string a, b;                        // STL, OBJ, PLY, OFF
    std::optional<LengthUnit> units;         // of both files; none: as each states, else guessed (mesh_unit.hpp)
    std::optional<LengthUnit> export_units;  // none: those of A
    compute::Combination operation = compute::Combination::unite;
    int resolution = 256;  // cells along the longest side of both together
    bool close_holes = false;
    std::optional<double> weld_m;      // none: by the files' numbers (sculpt/load_workpiece.hpp)
    std::vector<std::string> exports;  // STL, PLY, OBJ
    std::string report;                // a JSON file; empty: none
    unsigned threads = 0;              // 0: one per core
};

// Names the material of a mesh without any after its file, so that b's does not pass for a's in the result.
void name_materials(geometry::ClosedMesh& closed, const std::string& file, const std::array<std::uint8_t, 3>& colour) {
    if (!closed.mesh.materials.empty()) return;
    closed.mesh.materials = {{std::filesystem::path(file).stem().string(), colour}};
}

Result<compute::Solid> convert_onto(geometry::ClosedMesh& closed, const std::string& file,
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

// Reads both meshes, each with a material of its own.
struct BothMeshes {
    geometry::ClosedMesh a, b;
};
Result<BothMeshes> load_both(const CombineOptions& options) {
    const auto load = [&](const std::string& file) {
        return geometry::load_closed_mesh(
            {.file = file, .close_holes = options.close_holes, .units = options.units, .weld_m = options.weld_m});
    };
    BURIN_TRY(a, load(options.a));
    BURIN_TRY(b, load(options.b));
    name_materials(a, options.a, {205, 195, 178});
    name_materials(b, options.b, {224, 142, 54});
    return BothMeshes{std::move(a), std::move(b)};
}

// Returns a lattice that holds both. Fails where an export could not hold its numbers.
Result<compute::Lattice> lattice_of(const BothMeshes& both, const CombineOptions& options) {
    Box bounds = geometry::bounds_of(both.a.mesh);
    const Box of_b = geometry::bounds_of(both.b.mesh);
    bounds.include(of_b.lo);
    bounds.include(of_b.hi);
    Result<compute::Lattice> lattice = compute::lattice_around(bounds, options.resolution);
    if (!lattice) return lattice;
    for (const std::string& path : options.exports) BURIN_TRY_DO(sculpt::check_precision(path, *lattice));
    return lattice;
}

// Converts both onto the lattice and combines them. Adds to the report what converting has found.
Result<compute::Solid> combine_solids(BothMeshes& both, const compute::Lattice& lattice, const CombineOptions& options,
                                      WorkerPool& pool, Json& report) {
    BURIN_TRY(a, convert_onto(both.a, options.a, lattice, pool, report["a"]));
    BURIN_TRY(b, convert_onto(both.b, options.b, lattice, pool, report["b"]));
    return compute::combine(a, b, options.operation, pool);
}

// Fails where nothing is left that could be exported.
Result<void> check_something_is_left(const sculpt::FinishedMesh& finished, const BothMeshes& both,
                                     const CombineOptions& options) {
    if (!finished.mesh.triangles.empty()) return {};
    const std::string operation = text(options.operation);
    if (!finished.too_thin.empty())
        return fail(options.a + " and " + options.b,
                    "leave nothing that shows: of their " + operation + " " + finished.too_thin,
                    "raise --resolution, or make it thicker");
    return fail(options.a + " and " + options.b,
                "leave nothing: their " + operation + " is empty (" + both.a.size + "; " + both.b.size + ")",
                "check where the two lie and their units, or choose another --operation");
}

Result<void> export_combined(const sculpt::FinishedMesh& finished, const CombineOptions& options, LengthUnit unit,
                             Json& report) {
    for (const std::string& path : options.exports) {
        BURIN_TRY_DO(sculpt::export_finished(finished, path));
        std::printf("%s: written in %s\n", path.c_str(), descriptor_of(unit).plural);
        if (sculpt::loses_colours(finished.mesh, path)) std::printf("  %s\n", sculpt::kColoursLeftOut);
        report["exports"].push_back(std::filesystem::path(path).filename().string());
    }
    return {};
}

Result<void> combine_files(const CombineOptions& options) {
    session::InputFiles inputs;
    inputs.mesh(options.a).mesh(options.b);
    BURIN_TRY_DO(check_outputs(options.exports, options.report, inputs.list()));
    BURIN_TRY(both, load_both(options));
    BURIN_TRY(lattice, lattice_of(both, options));

    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    WorkerPool pool(options.threads);
    Json report = {{"burin", BURIN_VERSION}, {"operation", text(options.operation)}};
    BURIN_TRY(result, combine_solids(both, lattice, options, pool, report));
    compute::Surface surface(lattice);
    surface.mesh_all(result, pool);
    const LengthUnit unit = options.export_units.value_or(both.a.unit);
    BURIN_TRY(finished, sculpt::finish_mesh(surface, result, unit, std::nullopt, 0.0, pool));
    BURIN_TRY_DO(check_something_is_left(finished, both, options));
    report["lattice_cells"] = lattice.cells;
    report["lattice_spacing_m"] = lattice.spacing_m;
    report["disagreeing_edges"] = surface.disagreeing_edges();
    report["mesh"] = describe_mesh(finished.mesh, unit);
    report["mesh"]["self_intersections"] = finished.self_intersections;
    report["slivers"] = finished.slivers;
    report["export_unit"] = name_of(unit);
    std::printf("%s\n%s\n", both.a.size.c_str(), both.b.size.c_str());
    BURIN_TRY_DO(export_combined(finished, options, unit, report));
    report["timing"] = {{"total_ms", static_cast<double>(clock.now_ns() - start_ns) * 1e-6}};
    if (!options.report.empty()) BURIN_TRY_DO(write_report(options.report, report));
    print(report);
    return {};
}

CommandAction add_combine(Command command) {
    const auto to = std::make_shared<CombineOptions>();
    CombineOptions& options = *to;
    command.option("A", options.a, "STL, OBJ, PLY or OFF").asset(AssetRoom::workpieces).required();
    command.option("B", options.b, "STL, OBJ, PLY or OFF").asset(AssetRoom::workpieces).required();
    command
        .choice("--operation", options.operation, "union, difference (A without B) or intersection",
                {{"union", compute::Combination::unite},
                 {"difference", compute::Combination::subtract},
                 {"intersection", compute::Combination::intersect}})
        .required();
    command.option("--resolution", options.resolution, "Lattice cells along the longest side of both together")
        .within(compute::kMinResolution, compute::kMaxResolution)
        .show_default();
    command.unit("--units", options.units, std::string("Of both files: ") + kUnitsHelp);
    command.unit("--export-units", options.export_units, "Unit of the numbers in exported files; else that of A");
    command.flag("--close-holes", options.close_holes, "Fill the holes of meshes that are not closed");
    command.option("--weld", options.weld_m, kWeldHelp).within(session::kWeldBounds);
    command.option("--export", options.exports,
                   "Where to write the result: .stl, .ply (with colour) or .obj; may be repeated");
    command.option("--report", options.report, "A JSON file for all figures");
    command.option("--threads", options.threads, "How many threads work; 0: one per core").within(0, 1024);
    return action([to] { return combine_files(*to); });
}

}  // namespace

CommandRow combine_row() { return {"combine", "Unite, subtract or intersect two closed meshes", add_combine}; }

}  // namespace burin::app
