// SPDX-License-Identifier: MIT
#include "geometry/files/closed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/surface_colours.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"

namespace burin::geometry {
namespace {

Json describe(const MeshHealth& health) {
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

const char* word_for(UnitSource source) {
    switch (source) {
        case UnitSource::given: return "given";
        case UnitSource::stated: return "stated";
        case UnitSource::guessed: break;
    }
    return "guessed";
}

Json describe(const ImportReport& import) {
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

Json describe(const ClosingReport& closing) {
    Json holes = Json::array();
    for (const ClosedHole& hole : closing.holes) {
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

std::string in_words(const ClosingReport& closing) {
    double largest_m = 0.0;
    for (const ClosedHole& hole : closing.holes) largest_m = std::max(largest_m, hole.perimeter_m);
    const std::size_t count = closing.holes.size();
    return (count == 1 ? "1 hole was closed" : std::to_string(count) + " holes were closed") +
           formatted(", the largest %.3g mm around", 1e3 * largest_m);
}

// Closes the holes of a mesh where none is larger around than the mesh's shortest side: a scan's, and not the open end
// of a pipe or a missing face. Returns what it closed; nothing where there is a larger one, or the mesh is open still.
std::optional<ClosingReport> close_small_holes(TriangleMesh& mesh, const Vec3& size_m) {
    const double most_m = std::min({size_m.x, size_m.y, size_m.z});
    TriangleMesh closed = mesh;
    ClosingReport closing = close_holes(closed);
    const auto is_small = [&](const ClosedHole& hole) { return hole.perimeter_m <= most_m; };
    if (!std::ranges::all_of(closing.holes, is_small) || !examine(closed).closed) return std::nullopt;
    mesh = std::move(closed);
    return closing;
}

// Says how an open mesh can be closed.
std::string remedy_of_open(const TriangleMesh& mesh) {
    if (const auto tolerance_m = tolerance_that_closes_m(mesh))
        return formatted("pass --weld %g to have corners joined that lie up to %g mm apart, which closes it",
                         *tolerance_m, 1e3 * *tolerance_m);
    return "close it in a mesh editor, or pass --close-holes to have its holes filled, or --weld LENGTH to have "
           "corners joined that lie so near to each other";
}

// Welds the mesh, closes it where that is asked for, and turns it to face outwards.
Result<void> make_ready(ClosedMesh& closed, const ClosedMeshOptions& options, double tolerance_m,
                        const MeshWatch& looked) {
    TriangleMesh& mesh = closed.mesh;
    Json& report = closed.report;
    WorkWatch* const watch = looked.work;
    begin_step(watch, "checking the mesh", looked.read, looked.checked);
    report["vertices_welded"] = weld_vertices(mesh).vertices_merged;
    const JoinReport joins = join_open_edges(mesh, options.weld_m.value_or(tolerance_m));
    if (joins.vertices_joined > 0) {
        report["joined"] = {{"vertices", joins.vertices_joined},
                            {"farthest_m", joins.farthest_m},
                            {"triangles_dropped", joins.triangles_dropped}};
        closed.joined = in_words(joins);
        closed.size += "; " + closed.joined;
    }
    if (!go_on(watch, 0.4)) return no_longer_wanted();
    MeshHealth health = examine(mesh);
    report["health"] = describe(health);
    if (!health.closed) {
        std::optional<ClosingReport> closing;
        begin_step(watch, "closing holes", 0.5 * (looked.read + looked.checked), looked.checked);
        if (watch != nullptr && !watch->is_wanted()) return no_longer_wanted();
        if (options.close_holes) {
            closing = close_holes(mesh);
        } else if (options.close_small_holes) {
            closing = close_small_holes(mesh, closed.size_m);
        }
        if (!closing) {
            std::vector<std::string> complaints = geometry::complaints(health);
            if (!closed.joined.empty()) complaints.push_back(closed.joined + " before");
            return fail(options.file, "is not closed, so it has no inside: " + joined(complaints),
                        remedy_of_open(mesh));
        }
        report["closed_holes"] = describe(*closing);
        if (!closing->holes.empty()) {
            closed.closed = in_words(*closing);
            closed.size += "; " + closed.closed;
        }
        health = examine(mesh);
    }
    if (!go_on(watch, 1.0)) return no_longer_wanted();
    if (!health.consistently_oriented || health.inside_out()) {
        const OrientationReport turned = orient_outward(mesh);
        report["triangles_turned"] = turned.triangles_turned;
        report["orientation_conflicts"] = turned.conflicts;
    }
    return {};
}

}  // namespace

std::unexpected<Error> no_longer_wanted() { return fail("opening", "was ended", ""); }

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

Result<ClosedMesh> load_closed_mesh(const ClosedMeshOptions& options, const MeshWatch& watch) {
    const std::string& file = options.file;
    begin_step(watch.work, "reading the file", 0.0, watch.read);
    BURIN_TRY(imported, import_mesh(file, options.units));
    const Vec3& size_m = imported.report.size_m;
    BURIN_TRY_DO(check_weld(options.weld_m, std::max({size_m.x, size_m.y, size_m.z})));
    ImportReport& import = imported.report;
    if (!import.pictures.empty()) import.remarks.push_back(flattened_in_words(import.pictures));
    if (watch.look) watch.look(imported.mesh);
    if (!go_on(watch.work, 1.0)) return no_longer_wanted();
    ClosedMesh closed{
        std::move(imported.mesh), {}, describe_size(file, import.size_m, import.unit), import.unit.unit, import.size_m};
    closed.report["source"] = file;
    closed.report["import"] = describe(import);
    if (const auto ready = make_ready(closed, options, import.weld_tolerance_m, watch); !ready) {
        return std::unexpected(ready.error());
    }
    closed.report["size"] = closed.size;
    return closed;
}

}  // namespace burin::geometry
