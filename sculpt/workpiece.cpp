// SPDX-License-Identifier: MIT
#include "sculpt/workpiece.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/rays/room.hpp"
#include "compute/rays/scan_convert.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/surface_colours.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "sculpt/unmet_parts.hpp"

namespace burin::sculpt {
namespace {

const geometry::Material kPlainMaterial{"workpiece", {205, 195, 178}};

Json describe(const geometry::MeshHealth& health) {
    const auto point = [](const Vec3& p) { return Json::array({p.x, p.y, p.z}); };
    return {{"triangles", health.triangles},
            {"vertices", health.vertices},
            {"bounds_lo_m", point(health.bounds_m.lo)},
            {"bounds_hi_m", point(health.bounds_m.hi)},
            {"shells", health.shells},
            {"holes", health.holes},
            {"boundary_edges", health.boundary_edges},
            {"nonmanifold_edges", health.nonmanifold_edges},
            {"misoriented_edges", health.misoriented_edges},
            {"degenerate_triangles", health.degenerate_triangles},
            {"duplicate_triangles", health.duplicate_triangles},
            {"signed_volume_m3", health.signed_volume_m3},
            {"closed", health.closed}};
}

const char* word_for(geometry::UnitSource source) {
    switch (source) {
        case geometry::UnitSource::given: return "given";
        case geometry::UnitSource::stated: return "stated";
        case geometry::UnitSource::guessed: break;
    }
    return "guessed";
}

Json describe(const geometry::ImportReport& import) {
    return {{"format", import.format},
            {"unit", name_of(import.unit.unit)},
            {"unit_source", word_for(import.unit.source)},
            {"faces_in_file", import.faces_in_file},
            {"triangles_in_file", import.triangles_in_file},
            {"polygons_split", import.polygons_in_file},
            {"faces_without_area", import.faces_without_area},
            {"weld_tolerance_m", import.weld_tolerance_m},
            {"materials_merged", import.materials_merged},
            {"remarks", import.remarks}};
}

Json describe(const geometry::ClosingReport& closing) {
    Json holes = Json::array();
    for (const geometry::ClosedHole& hole : closing.holes) {
        holes.push_back({{"edges", hole.edges},
                         {"perimeter_m", hole.perimeter_m},
                         {"area_added_m2", hole.area_added_m2},
                         {"triangles_added", hole.triangles_added}});
    }
    return holes;
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& s : sentences) text += (text.empty() ? "" : "; ") + s;
    return text;
}

std::string in_words(const geometry::ClosingReport& closing) {
    double largest_m = 0.0;
    for (const geometry::ClosedHole& hole : closing.holes) largest_m = std::max(largest_m, hole.perimeter_m);
    const std::size_t count = closing.holes.size();
    return (count == 1 ? "1 hole was closed" : std::to_string(count) + " holes were closed") +
           formatted(", the largest %.3g mm around", 1e3 * largest_m);
}

// Closes the holes of a mesh where none is larger around than the mesh's shortest side: a scan's, and not the open end
// of a pipe or a missing face. Returns what it closed; nothing where there is a larger one, or the mesh is open still.
std::optional<geometry::ClosingReport> close_small_holes(geometry::TriangleMesh& mesh, const Vec3& size_m) {
    const double most_m = std::min({size_m.x, size_m.y, size_m.z});
    geometry::TriangleMesh closed = mesh;
    geometry::ClosingReport closing = geometry::close_holes(closed);
    const auto is_small = [&](const geometry::ClosedHole& hole) { return hole.perimeter_m <= most_m; };
    if (!std::ranges::all_of(closing.holes, is_small) || !geometry::examine(closed).closed) return std::nullopt;
    mesh = std::move(closed);
    return closing;
}

// Says how an open mesh can be closed.
std::string remedy_of_open(const geometry::TriangleMesh& mesh) {
    if (const auto tolerance_m = geometry::tolerance_that_closes_m(mesh))
        return formatted("pass --weld %g to have corners joined that lie up to %g mm apart, which closes it",
                         *tolerance_m, 1e3 * *tolerance_m);
    return "close it in a mesh editor, or pass --close-holes to have its holes filled, or --weld LENGTH to have "
           "corners joined that lie so near to each other";
}

// Parts of the work on a workpiece, as shares of all of it.
struct LoadShares {
    double read = 0.0, checked = 0.0, solid = 0.0;  // done when it is
};

bool is_shape(const std::string& source) { return source.starts_with("block:") || source.starts_with("ball:"); }

// Estimates the shares by what a binary STL of 4.4 million triangles and a ball of 2048 cells took: they are shown, and
// nothing follows from them.
LoadShares shares_of(const WorkpieceOptions& options) {
    constexpr double kOfByte = 34e-9, kOfSurfaceCell = 6.7e-6, kReading = 0.6, kSolid = 0.2;
    std::error_code ignored;
    const auto bytes = is_shape(options.source) ? 0 : std::filesystem::file_size(options.source, ignored);
    const double file = ignored ? 0.0 : kOfByte * static_cast<double>(bytes);
    const double solid = kOfSurfaceCell * options.resolution * options.resolution;
    const double of_file = file / (file + solid);
    return {kReading * of_file, of_file, of_file + kSolid * (1.0 - of_file)};
}

// Welds the mesh, closes it where that is asked for, and turns it to face outwards.
Result<void> make_ready(ClosedMesh& closed, const WorkpieceOptions& options, double tolerance_m, WorkWatch* watch) {
    geometry::TriangleMesh& mesh = closed.mesh;
    Json& report = closed.report;
    const LoadShares shares = shares_of(options);
    begin_step(watch, "checking the mesh", shares.read, shares.checked);
    report["vertices_welded"] = geometry::weld_vertices(mesh).vertices_merged;
    const geometry::JoinReport joins = geometry::join_open_edges(mesh, options.weld_m.value_or(tolerance_m));
    if (joins.vertices_joined > 0) {
        report["joined"] = {{"vertices", joins.vertices_joined},
                            {"farthest_m", joins.farthest_m},
                            {"triangles_dropped", joins.triangles_dropped}};
        closed.joined = in_words(joins);
        closed.size += "; " + closed.joined;
    }
    if (!go_on(watch, 0.4)) return no_longer_wanted();
    geometry::MeshHealth health = geometry::examine(mesh);
    report["health"] = describe(health);
    if (!health.closed) {
        std::optional<geometry::ClosingReport> closing;
        begin_step(watch, "closing holes", 0.5 * (shares.read + shares.checked), shares.checked);
        if (watch != nullptr && !watch->is_wanted()) return no_longer_wanted();
        if (options.close_holes) {
            closing = close_holes(mesh);
        } else if (options.close_small_holes) {
            closing = close_small_holes(mesh, closed.size_m);
        }
        if (!closing) {
            std::vector<std::string> complaints = geometry::complaints(health);
            if (!closed.joined.empty()) complaints.push_back(closed.joined + " before");
            return fail(options.source, "is not closed, so it has no inside: " + joined(complaints),
                        remedy_of_open(mesh));
        }
        report["closed_holes"] = describe(*closing);
        if (!closing->holes.empty()) {
            closed.closed = in_words(*closing);
            closed.size += "; " + closed.closed;
        }
        health = geometry::examine(mesh);
    }
    if (!go_on(watch, 1.0)) return no_longer_wanted();
    if (!health.consistently_oriented || health.inside_out()) {
        const geometry::OrientationReport turned = geometry::orient_outward(mesh);
        report["triangles_turned"] = turned.triangles_turned;
        report["orientation_conflicts"] = turned.conflicts;
    }
    return {};
}

Result<LoadedWorkpiece> from_file(const WorkpieceOptions& options, WorkerPool& pool, const LoadWatch& watch) {
    BURIN_TRY(closed, load_closed_mesh(options, watch));
    LoadedWorkpiece workpiece{
        {}, std::move(closed.report), std::move(closed.size), closed.unit, closed.size_m, closed.closed};
    const LoadShares shares = shares_of(options);
    begin_step(watch.work, "building the solid", shares.checked, shares.solid);
    Result<compute::ScanConversion> converted = compute::scan_convert(closed.mesh, options.resolution, pool);
    if (!converted) {
        Error error = converted.error();
        if (error.where == "mesh") error.where = options.source;
        if (!closed.joined.empty()) error.what += "; " + closed.joined + ", as --weld LENGTH decides";
        return std::unexpected(error);
    }
    workpiece.report["triangles_converted"] = closed.mesh.triangles.size();
    workpiece.report["ray_crossings"] = converted->crossings;
    workpiece.report["unmatched_rays"] = converted->unmatched_rays;
    workpiece.report["inside_by_parity"] = converted->by_parity;
    workpiece.solid = std::move(converted->solid);
    note_unmet_parts(closed.mesh, workpiece.solid, workpiece.size, workpiece.report);
    return workpiece;
}

Result<LoadedWorkpiece> from_shape(const WorkpieceOptions& options) {
    const std::size_t colon = options.source.find(':');
    const std::string shape = options.source.substr(0, colon);
    const std::string_view sizes = std::string_view(options.source).substr(colon + 1);
    BURIN_TRY(numbers, parse_numbers(sizes, shape == "block" ? 3 : 1, "--workpiece " + options.source));
    BURIN_TRY(solid, shape == "block"
                         ? compute::make_block({numbers[0], numbers[1], numbers[2]}, options.resolution, kPlainMaterial)
                         : compute::make_ball(numbers[0], options.resolution, kPlainMaterial));
    const Vec3 size_m = shape == "block" ? Vec3(numbers[0], numbers[1], numbers[2]) : Vec3(2.0 * numbers[0]);
    const std::string size = options.source + ": " + in_millimetres(size_m);
    return LoadedWorkpiece{std::move(solid), {{"source", options.source}, {"size", size}}, size, LengthUnit::m, size_m};
}

}  // namespace

// ---- Workpiece

double meshing_from(const WorkpieceOptions& options) { return shares_of(options).solid; }

std::unexpected<Error> no_longer_wanted() { return fail("opening", "was ended", ""); }

Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count, const std::string& what) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (at <= end && numbers.size() <= count) {
        double value = 0.0;
        const auto [stop, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !std::isfinite(value)) break;
        numbers.push_back(value);
        if (stop == end) {
            at = end;
            break;
        }
        if (*stop != ',') break;
        at = stop + 1;
    }
    if (at != end || numbers.size() != count) {
        return fail(what, "does not give " + std::to_string(count) + (count == 1 ? " number" : " numbers with commas"),
                    "see the command's --help");
    }
    return numbers;
}

Result<void> check_weld(std::optional<double> weld_m, double longest_side_m) {
    if (!weld_m) return {};
    if (!(std::isfinite(*weld_m) && *weld_m > 0.0)) {
        return fail("--weld", "needs a distance above zero",
                    "give how far corners may lie apart that are joined, in metres, or leave the option out");
    }
    if (10.0 * *weld_m < longest_side_m) return {};
    return fail(formatted("--weld %g", *weld_m),
                "is more than a tenth of the mesh, whose longest side is " + in_millimetres(longest_side_m),
                "give a shorter distance, in metres");
}

Result<ClosedMesh> load_closed_mesh(const WorkpieceOptions& options, const LoadWatch& watch) {
    const std::string& file = options.source;
    begin_step(watch.work, "reading the file", 0.0, shares_of(options).read);
    BURIN_TRY(imported, geometry::import_mesh(file, options.units));
    const Vec3& size_m = imported.report.size_m;
    BURIN_TRY_DO(check_weld(options.weld_m, std::max({size_m.x, size_m.y, size_m.z})));
    geometry::ImportReport& import = imported.report;
    if (!import.pictures.empty()) import.remarks.push_back(geometry::flattened_in_words(import.pictures));
    if (watch.look) watch.look(imported.mesh);
    if (!go_on(watch.work, 1.0)) return no_longer_wanted();
    ClosedMesh closed{
        std::move(imported.mesh), {}, describe_size(file, import.size_m, import.unit), import.unit.unit, import.size_m};
    closed.report["source"] = file;
    closed.report["import"] = describe(import);
    if (const auto ready = make_ready(closed, options, import.weld_tolerance_m, watch.work); !ready) {
        return std::unexpected(ready.error());
    }
    closed.report["size"] = closed.size;
    return closed;
}

void note_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid, std::string& size,
                      Json& report) {
    const std::vector<UnmetPart> parts = find_unmet_parts(mesh, solid);
    if (parts.empty()) return;
    size += "; " + in_words(parts, solid.lattice);
    report["size"] = size;
    report["unmet"] = describe(parts, solid.lattice);
}

Result<LoadedWorkpiece> load_workpiece(const WorkpieceOptions& options, WorkerPool& pool, const LoadWatch& watch) {
    const LoadShares shares = shares_of(options);
    if (is_shape(options.source)) begin_step(watch.work, "building the solid", shares.checked, shares.solid);
    Result<LoadedWorkpiece> workpiece =
        is_shape(options.source) ? from_shape(options) : from_file(options, pool, watch);
    if (!workpiece) return workpiece;
    if (!go_on(watch.work, 0.5)) return no_longer_wanted();
    workpiece->bounds_object = workpiece_bounds(workpiece->solid.lattice);
    const double room_m = options.room.value_or(0.0) * longest_side_m(workpiece->bounds_object);
    const double cells = std::ceil(room_m / workpiece->solid.lattice.spacing_m);
    const int most = compute::most_room_cells(workpiece->solid.lattice);
    BURIN_TRY(roomy, compute::with_room(std::move(workpiece->solid), std::min(most, static_cast<int>(cells))));
    workpiece->solid = std::move(roomy);
    return workpiece;
}

Result<void> check_units(const WorkpieceOptions& options, bool tool_is_a_file) {
    const LengthUnit unit = options.units.value_or(LengthUnit::m);
    if (unit == LengthUnit::m || tool_is_a_file || !is_shape(options.source)) return {};
    return fail(std::string("--units ") + name_of(unit), "is for mesh files, and " + options.source + " is in metres",
                "leave --units out and write the sizes in metres");
}

double longest_side_m(const Box& box) {
    const Vec3 size = box.extent();
    return std::max({size.x, size.y, size.z});
}

Box lattice_bounds(const compute::Lattice& lattice) {
    const Vec3 size = Vec3(lattice.cells[0], lattice.cells[1], lattice.cells[2]) * lattice.spacing_m;
    return {lattice.origin_object, lattice.origin_object + size};
}

Box workpiece_bounds(const compute::Lattice& lattice) {
    // The lattice has about one and a half empty cells around the workpiece.
    const Vec3 inset(1.5 * lattice.spacing_m);
    const Box all = lattice_bounds(lattice);
    return {all.lo + inset, all.hi - inset};
}

}  // namespace burin::sculpt
