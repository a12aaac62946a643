// SPDX-License-Identifier: MIT
#include "app/meshes/convert.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>

#include "app/cli/output_files.hpp"
#include "app/cli/sculpt_options.hpp"
#include "app/meshes/convert_placing.hpp"
#include "app/meshes/document_command.hpp"
#include "app/recordings/session_export.hpp"
#include "base/progress.hpp"
#include "base/try.hpp"
#include "compute/repair/rounding.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "geometry/files/mesh_export.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_placing.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/load_workpiece.hpp"
#include "session/options/option_bounds.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

// Prints the health of a mesh of numbers in the unit.
void print_health(const geometry::TriangleMesh& numbers, LengthUnit unit = LengthUnit::m) {
    const geometry::MeshHealth health = geometry::examine(numbers);
    const double cm = 100.0 * metres_in(unit);
    std::printf("  size %s, %zu shells, area %g cm2, volume %g cm3\n",
                in_millimetres(to_metres(health.bounds_m.extent(), unit)).c_str(), health.shells,
                cm * cm * health.area_m2, cm * cm * cm * health.signed_volume_m3);
    for (const std::string& complaint : geometry::complaints(health)) std::printf("  %s\n", complaint.c_str());
}

// One triangle in so many may lose its area by rounding: its corners are then moved apart by a step of a float, which
// is no more than rounding does. Where more lose it, the format cannot hold the shape.
constexpr std::size_t kTrianglesForOneWithoutArea = 1000;

Result<void> check_precision(const geometry::FileNumbers& numbers, const std::string& out) {
    if (numbers.without_area * kTrianglesForOneWithoutArea <= numbers.mesh.triangles.size()) return {};
    return fail(out,
                "would hold single-precision numbers, in which " + std::to_string(numbers.without_area) +
                    " triangles have no area",
                "move the mesh to its origin (burin convert IN OUT --center), or write .obj");
}

// Moves and scales the mesh as asked, and says where it is then.
Result<void> place(geometry::TriangleMesh& mesh, const geometry::Placing& placing, LengthUnit unit) {
    if (placing.changes_nothing()) return {};
    geometry::place_mesh(mesh, placing);
    const Box bounds = geometry::bounds_of(mesh);
    BURIN_TRY_DO(check_reach(bounds, unit));
    std::printf("%s\n", placed_in_words(bounds, placing).c_str());
    print_health(mesh);
    return {};
}

// Of the longest side: how far single precision moves a corner before the user is told.
constexpr double kRoundingTold = 1e-5;

// Tells how far rounding to floats has moved corners of a mesh far from its origin.
void tell_rounding(const geometry::TriangleMesh& mesh_m, const geometry::TriangleMesh& numbers, LengthUnit unit) {
    double farthest_m = 0.0;
    for (std::size_t v = 0; v < mesh_m.positions_m.size(); ++v)
        farthest_m = std::max(farthest_m, glm::length(to_metres(numbers.positions_m[v], unit) - mesh_m.positions_m[v]));
    const Vec3 size_m = geometry::bounds_of(mesh_m).extent();
    if (!(farthest_m > kRoundingTold * std::max({size_m.x, size_m.y, size_m.z}))) return;
    std::printf(
        "  single-precision numbers so far from the origin move its corners by up to %s; --center moves the mesh to "
        "its "
        "origin, and .obj has double precision\n",
        in_millimetres(farthest_m).c_str());
}

// Brings the mesh to the numbers that the file will hold, and says what scaling and rounding have changed.
Result<geometry::TriangleMesh> rounded_for(const std::string& out, const geometry::TriangleMesh& mesh_m,
                                           LengthUnit unit, WorkerPool& pool) {
    const auto format = geometry::mesh_format_of(out).value_or(geometry::MeshFormat::obj);  // check_outputs() knows it
    geometry::FileNumbers numbers = geometry::numbers_of_file(mesh_m, format, unit);
    BURIN_TRY_DO(check_precision(numbers, out));
    if (numbers.steps_apart > 0)
        std::printf("  vertices that fall together by rounding were moved apart by %zu steps of a float\n",
                    numbers.steps_apart);
    if (numbers.is_rounded) tell_rounding(mesh_m, numbers.mesh, unit);
    if (!numbers.is_rounded || format == geometry::MeshFormat::obj) return std::move(numbers.mesh);
    Progress progress("repairing what rounding has turned over");
    const compute::RoundingReport repair =
        compute::repair_rounding(mesh_m, numbers.mesh, pool, [&](double done) { progress.show(done); });
    if (repair.vertices_moved > 0)
        std::printf(
            "  %s vertices were moved by a step or two of a float, so that triangles do not pass through each "
            "other by rounding\n",
            std::to_string(repair.vertices_moved).c_str());
    if (repair.left > 0)
        std::printf(
            "  %s of %s pairs of triangles still pass through each other by rounding to the file's single-precision "
            "numbers; .obj has double precision\n",
            std::to_string(repair.left).c_str(), std::to_string(repair.found).c_str());
    if (!repair.complete)
        std::printf(
            "  so many triangles lie within a rounding of each other that the repair was ended at its bound; .obj has "
            "double precision\n");
    return std::move(numbers.mesh);
}

// Says what becomes of colours that the file cannot hold as they are.
void tell_colours(const std::string& out, const geometry::FileColours& colours, const geometry::ImportReport& report) {
    if (colours.none()) return;
    if (geometry::mesh_format_of(out) == geometry::MeshFormat::stl) {
        std::printf("  %s\n", sculpt::kColoursLeftOut);
    } else if (colours.flattened && !report.pictures.empty()) {
        std::printf("  %s\n", geometry::flattened_in_words(report.pictures).c_str());
    }
}

// Checks that the file of an OBJ's materials, which nobody has named, replaces nothing but another that Burin wrote,
// and that the OBJ can name it.
Result<void> check_materials(const std::string& materials, std::span<const std::string> inputs) {
    BURIN_TRY_DO(check_places(std::array{materials}, inputs));
    const std::string name = std::filesystem::path(materials).filename().string();
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '\\'; };
    if (std::ranges::any_of(name, is_control) || name.front() == ' ')
        return fail(materials, "is no name that an OBJ can hold for its colours", "choose another name, or .ply");
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(materials, error))) return {};
    std::ifstream in(materials);
    std::string line;
    if (!std::filesystem::is_symlink(materials, error) && std::getline(in, line) && line == "# by Burin") return {};
    return fail(materials, "would be overwritten with the colours of the mesh, and Burin has not made it",
                "move it away, or choose another name");
}

// Writes the mesh; beside an OBJ whose faces have colours its materials, over none of the inputs.
Result<void> write_mesh(const ConvertOptions& options, const geometry::TriangleMesh& numbers, LengthUnit unit,
                        const geometry::ImportedMesh& imported, std::span<const std::string> inputs) {
    const std::span<const geometry::TriangleColours> corners = imported.corner_colours;
    const geometry::FileColours colours = geometry::file_colours(numbers, corners);
    tell_colours(options.out, colours, imported.report);
    const bool is_obj = geometry::mesh_format_of(options.out) == geometry::MeshFormat::obj;
    const bool has_materials = is_obj && !colours.of_faces.empty();
    const std::string materials = geometry::material_file_of(options.out).string();
    if (has_materials) BURIN_TRY_DO(check_materials(materials, inputs));
    BURIN_TRY_DO(geometry::export_numbers(numbers, options.out, unit, corners));
    std::printf("%s: written in %s%s\n", options.out.c_str(), descriptor_of(unit).plural,
                has_materials ? (", the colours of its faces in " + materials).c_str() : "");
    return {};
}

// Makes one vertex of those at one position. Where they differ in colour, the faces keep theirs.
void weld(geometry::TriangleMesh& mesh) {
    if (geometry::keep_colours_of_faces_at_seams(mesh))
        std::printf("  vertices at one place differ in colour: each triangle has one colour\n");
    geometry::weld_vertices(mesh);
}

// Has the colours of corners follow triangles that were added, or turned over; where some are gone, each of the others
// has the colour of its material.
void follow_triangles(geometry::ImportedMesh& imported, bool some_are_gone) {
    auto& corners = imported.corner_colours;
    const geometry::TriangleMesh& mesh = imported.mesh;
    if (corners.empty()) return;
    if (some_are_gone || mesh.triangle_materials.size() != mesh.triangles.size()) {
        if (imported.report.materials_merged > 0)
            std::printf("  triangles are gone, and the others have the colours that a solid has room for\n");
        return corners.clear();
    }
    for (geometry::TriangleColours& corner : corners) corner.fill(geometry::mean_of(corner));
    while (corners.size() < mesh.triangles.size()) {
        const auto colour = mesh.materials[mesh.triangle_materials[corners.size()]].colour;
        corners.push_back({colour, colour, colour});
    }
}

// Joins open edges, and closes the holes where that is asked for. Says what that has changed.
void close_mesh(geometry::ImportedMesh& imported, const ConvertOptions& options) {
    geometry::TriangleMesh& mesh = imported.mesh;
    weld(mesh);
    const auto joined = geometry::join_open_edges(mesh, options.weld_m.value_or(imported.report.weld_tolerance_m));
    if (joined.vertices_joined > 0) std::printf("  %s\n", in_words(joined).c_str());
    follow_triangles(imported, joined.triangles_dropped > 0);
    if (options.close_holes) {
        const geometry::ClosingReport closing = geometry::close_holes(mesh);
        const geometry::OrientationReport turned = geometry::orient_outward(mesh);
        std::printf("  closed %zu holes with %zu triangles; turned %zu triangles\n", closing.holes.size(),
                    closing.triangles_added, turned.triangles_turned);
        follow_triangles(imported, false);
    }
    print_health(mesh);
}

// Makes fewer triangles of the file's numbers, and says how many.
Result<void> simplify(geometry::TriangleMesh& numbers, geometry::ImportedMesh& imported, LengthUnit unit,
                      double simplify_m, WorkerPool& pool) {
    BURIN_TRY(simplified, sculpt::simplify_with_progress(numbers, unit, simplify_m, pool));
    std::printf("  simplified from %zu to %zu triangles, at most %s away (asked: %s)\n", imported.mesh.triangles.size(),
                simplified.mesh.triangles.size(),
                in_millimetres(simplified.figures["error_max_m"].get<double>()).c_str(),
                in_millimetres(simplify_m).c_str());
    numbers = std::move(simplified.mesh);
    follow_triangles(imported, true);
    print_health(numbers, unit);
    return {};
}

Result<void> convert_mesh(const ConvertOptions& options) {
    BURIN_TRY_DO(sculpt::check_simplification(options.simplify_m));
    BURIN_TRY(placing, placing_of(options));
    const std::vector<std::string> inputs = session::InputFiles().mesh(options.in).list();
    BURIN_TRY_DO(check_overwrites_none(options.out, inputs));
    BURIN_TRY_DO(check_outputs(std::array{options.out}, "", inputs));
    BURIN_TRY(imported,
              geometry::import_mesh(options.in, options.units,
                                    placing.middle_m ? geometry::MeshOrigin::middle : geometry::MeshOrigin::of_file));
    geometry::TriangleMesh& mesh = imported.mesh;
    std::printf("%s: %s, %zu triangles, %zu vertices\n", options.in.c_str(), imported.report.format.c_str(),
                mesh.triangles.size(), mesh.positions_m.size());
    const geometry::ImportReport& report = imported.report;
    std::printf("%s\n", geometry::describe_size(options.in, report.size_m, report.unit).c_str());
    const double longest_side_m = std::max({report.size_m.x, report.size_m.y, report.size_m.z});
    BURIN_TRY_DO(geometry::check_weld(options.weld_m, longest_side_m));
    for (const std::string& remark : imported.report.remarks) std::printf("  %s\n", remark.c_str());
    print_health(mesh);
    if (options.close_holes || options.weld_m) close_mesh(imported, options);
    const LengthUnit unit = options.export_units.value_or(report.unit.unit);
    BURIN_TRY_DO(place(mesh, placing, unit));
    // Without shared vertices every edge would be a border, and decimation keeps borders.
    if (options.simplify_m) weld(mesh);
    WorkerPool pool;
    BURIN_TRY(numbers, rounded_for(options.out, mesh, unit, pool));
    if (options.simplify_m) BURIN_TRY_DO(simplify(numbers, imported, unit, *options.simplify_m, pool));
    return write_mesh(options, numbers, unit, imported, inputs);
}

// Refuses what a mesh or a document alone can be asked for.
Result<void> check_for_a_session(const ConvertOptions& options) {
    const std::array given{std::pair{"--units", options.units.has_value()},
                           std::pair{"--export-units", options.export_units.has_value()},
                           std::pair{"--close-holes", options.close_holes},
                           std::pair{"--weld", options.weld_m.has_value()},
                           std::pair{"--simplify", options.simplify_m.has_value()},
                           std::pair{"--center", options.center},
                           std::pair{"--place", options.place_m.has_value()},
                           std::pair{"--scale", options.scale.has_value()}};
    for (const auto& [name, is_given] : given)
        if (is_given) return fail(name, "is for meshes and documents", "leave it out, or leave out --to");
    return {};
}

Result<void> convert_session(const ConvertOptions& options) {
    BURIN_TRY_DO(check_for_a_session(options));
    return export_session({.in = options.in,
                           .out = options.out,
                           .to = options.to,
                           .columns = options.columns,
                           .part = options.part,
                           .trials = options.trials,
                           .subject = options.subject,
                           .task = options.task});
}

// Adds the format of a session file's table, and what of it is written.
void add_table_options(Command command, ConvertOptions& o) {
    command
        .option("--to", o.to,
                "csv, npy, hdf5, mat: the ticks of a session file as a table; bids: as a folder of motion data; log: "
                "what was noted, as text")
        .one_of({"csv", "npy", "hdf5", "mat", "bids", "log"});
    command.option("--columns", o.columns,
                   "With --to: names with commas between them, a star at the end for all that begin so; else all");
    command.option(
        "--part", o.part,
        "With --to: which hand, where the recording has several, or a derived table by its name's beginning");
    command.option("--trials", o.trials,
                   "With --to: the ticks of these trials alone: numbers or names with commas between them, a star at "
                   "the end for all that begin so");
    command.option("--subject", o.subject, "With --to bids: its label").show_default();
    command.option("--task", o.task, "With --to bids: its label").show_default();
}

// Adds what becomes of a mesh.
void add_mesh_options(Command command, ConvertOptions& o) {
    command.unit("--units", o.units, kUnitsHelp);
    command.unit("--export-units", o.export_units, "Unit of the numbers in OUT; else that of IN");
    command.flag("--close-holes", o.close_holes, "Fill holes and turn the triangles outwards");
    command
        .option("--weld", o.weld_m,
                "Join corners at open edges that lie up to this far apart, in metres; with --close-holes at least "
                "as far as the file's numbers are precise")
        .within(session::kWeldBounds);
    command.option("--simplify", o.simplify_m, "Fewer triangles: the surface moves at most this far, in metres");
    add_placing_options(command, o);
}

CommandAction add_convert(Command command) {
    const auto options = std::make_shared<ConvertOptions>();
    ConvertOptions& o = *options;
    command.option("IN", o.in, "STL, OBJ, PLY, OFF, or a document (.burin); with --to a session file")
        .asset(AssetRoom::workpieces)
        .required();
    command.option("OUT", o.out,
                   ".stl, .ply or .obj; with --to any name, - for standard output, or none: IN with another ending");
    add_table_options(command, o);
    add_mesh_options(command, o);
    return [options]() -> Result<int> {
        if (options->is_misused()) return wrong_usage("convert", "OUT is required");
        return action([&] {
            return options->is_of_session()    ? convert_session(*options)
                   : options->is_of_document() ? convert_document(*options)
                                               : convert_mesh(*options);
        })();
    };
}

}  // namespace

CommandRow convert_row() {
    return {"convert",
            "Convert a mesh file or a document to STL, PLY or OBJ, or a session file to what other programs read",
            add_convert};
}

}  // namespace burin::app
