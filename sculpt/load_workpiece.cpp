// SPDX-License-Identifier: MIT
#include "sculpt/load_workpiece.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/longest_side.hpp"
#include "base/numbers.hpp"
#include "base/try.hpp"
#include "compute/rays/room.hpp"
#include "compute/rays/scan_convert.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "geometry/files/mesh_import.hpp"
#include "sculpt/unmet_parts.hpp"

namespace burin::sculpt {
namespace {

const geometry::Material kPlainMaterial{"workpiece", {205, 195, 178}};

// Parts of the work on a workpiece, as shares of all of it.
struct LoadShares {
    double read = 0.0, checked = 0.0, solid = 0.0;  // done when it is
};

// Estimates the shares by what a binary STL of 4.4 million triangles and a ball of 2048 cells took: they are shown, and
// nothing follows from them.
LoadShares shares_of(const workpiece::WorkpieceOptions& options) {
    constexpr double kOfByte = 34e-9, kOfSurfaceCell = 6.7e-6, kReading = 0.6, kSolid = 0.2;
    std::error_code ignored;
    const auto bytes = workpiece::is_shape(options.source) ? 0 : std::filesystem::file_size(options.source, ignored);
    const double file = ignored ? 0.0 : kOfByte * static_cast<double>(bytes);
    const double solid = kOfSurfaceCell * options.resolution * options.resolution;
    const double of_file = file / (file + solid);
    return {kReading * of_file, of_file, of_file + kSolid * (1.0 - of_file)};
}

Result<workpiece::LoadedWorkpiece> from_file(const workpiece::WorkpieceOptions& options, WorkerPool& pool,
                                             const workpiece::LoadWatch& watch) {
    const LoadShares shares = shares_of(options);
    BURIN_TRY(closed, geometry::load_closed_mesh({options.source, options.close_holes, options.close_small_holes,
                                                  options.units, options.weld_m},
                                                 {watch.work, watch.look, shares.read, shares.checked}));
    workpiece::LoadedWorkpiece workpiece{
        {}, std::move(closed.report), std::move(closed.size), closed.unit, closed.size_m, closed.closed};
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

Result<workpiece::LoadedWorkpiece> from_shape(const workpiece::WorkpieceOptions& options) {
    const std::size_t colon = options.source.find(':');
    const std::string shape = options.source.substr(0, colon);
    const std::string_view sizes = std::string_view(options.source).substr(colon + 1);
    BURIN_TRY(numbers, parse_numbers(sizes, shape == "block" ? 3 : 1, "--workpiece " + options.source));
    BURIN_TRY(solid, shape == "block"
                         ? compute::make_block({numbers[0], numbers[1], numbers[2]}, options.resolution, kPlainMaterial)
                         : compute::make_ball(numbers[0], options.resolution, kPlainMaterial));
    const Vec3 size_m = shape == "block" ? Vec3(numbers[0], numbers[1], numbers[2]) : Vec3(2.0 * numbers[0]);
    const std::string size = options.source + ": " + in_millimetres(size_m);
    return workpiece::LoadedWorkpiece{
        std::move(solid), {{"source", options.source}, {"size", size}}, size, LengthUnit::m, size_m};
}

}  // namespace

// ---- Workpiece

double meshing_from(const workpiece::WorkpieceOptions& options) { return shares_of(options).solid; }

void note_unmet_parts(const geometry::TriangleMesh& mesh, const compute::Solid& solid, std::string& size,
                      Json& report) {
    const std::vector<UnmetPart> parts = find_unmet_parts(mesh, solid);
    if (parts.empty()) return;
    size += "; " + in_words(parts, solid.lattice);
    report["size"] = size;
    report["unmet"] = describe(parts, solid.lattice);
}

Result<workpiece::LoadedWorkpiece> load_workpiece(const workpiece::WorkpieceOptions& options, WorkerPool& pool,
                                                  const workpiece::LoadWatch& watch) {
    const LoadShares shares = shares_of(options);
    if (workpiece::is_shape(options.source)) begin_step(watch.work, "building the solid", shares.checked, shares.solid);
    Result<workpiece::LoadedWorkpiece> workpiece =
        workpiece::is_shape(options.source) ? from_shape(options) : from_file(options, pool, watch);
    if (!workpiece) return workpiece;
    if (!go_on(watch.work, 0.5)) return geometry::no_longer_wanted();
    workpiece->bounds_object = workpiece::workpiece_bounds(workpiece->solid.lattice);
    const double room_m = options.room.value_or(0.0) * longest_side_m(workpiece->bounds_object);
    const double cells = std::ceil(room_m / workpiece->solid.lattice.spacing_m);
    const int most = compute::most_room_cells(workpiece->solid.lattice);
    BURIN_TRY(roomy, compute::with_room(std::move(workpiece->solid), std::min(most, static_cast<int>(cells))));
    workpiece->solid = std::move(roomy);
    return workpiece;
}

}  // namespace burin::sculpt
