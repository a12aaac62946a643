// SPDX-License-Identifier: MIT
#include "app/meshes/convert_placing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/mesher/surface.hpp"
#include "geometry/files/mesh_import.hpp"
#include "sculpt/load_workpiece.hpp"

namespace burin::app {
namespace {

// Returns the box around all vertices of a solid's surface. They are kept relative to the lattice's origin, so nothing
// is lost by a solid far from that of the object.
Box surface_bounds(const compute::Solid& solid, WorkerPool& pool) {
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    Box bounds;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t)
        for (const shared::SurfaceVertex& v : surface.tile(t).vertices)
            bounds.include(solid.lattice.origin_object + Vec3(v.x, v.y, v.z));
    return bounds;
}

}  // namespace

void add_placing_options(Command command, ConvertOptions& options) {
    command.flag("--center", options.center, "Move the middle of the mesh's box to the origin: --place 0,0,0");
    const auto take_place = [&options](const std::vector<std::string>& given) -> Result<void> {
        const std::string& text = given.back();
        const auto numbers = parse_numbers(text, 3, text);
        if (!numbers) return fail("'" + text + "'", "is no place", "give x, y and z in metres, such as 0.1,0,-0.25");
        options.place_m = Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
        return given.size() == 1 ? Result<void>() : fail("'" + text + "'", "is a second place", "give one");
    };
    command.option("--place", take_place,
                   "X,Y,Z in metres, whatever the unit of the files: move the middle of the mesh's box there");
    command.option("--scale", options.scale,
                   "A factor for its size, 1e-6 to 1e6: about the origin, or where --center or --place puts it; a "
                   "negative one mirrors as well. For a wrong unit there is --units");
}

Result<geometry::Placing> placing_of(const ConvertOptions& options) {
    geometry::Placing placing{.middle_m = options.place_m, .scale = options.scale.value_or(1.0)};
    if (options.center && options.place_m)
        return fail("--center", "and --place both say where the mesh goes", "give one of them");
    if (options.center) placing.middle_m = Vec3(0.0);
    BURIN_TRY_DO(geometry::check_scale(placing.scale));
    return placing;
}

Result<void> place_solid(compute::Solid& solid, const geometry::Placing& placing, LengthUnit unit, WorkerPool& pool) {
    if (placing.changes_nothing()) return {};
    compute::Lattice& lattice = solid.lattice;
    const double side = placing.mirrors() ? -1.0 : 1.0;
    lattice.spacing_m *= std::abs(placing.scale);
    lattice.origin_object = placing.middle_m ? Vec3(0.0) : lattice.origin_object * std::abs(placing.scale);
    Box bounds = surface_bounds(solid, pool);
    if (bounds.empty()) return {};  // all has been carved away, as the caller says
    if (placing.middle_m) {
        const Vec3 way = side * *placing.middle_m - bounds.center();
        lattice.origin_object = way;
        bounds = {bounds.lo + way, bounds.hi + way};
    }
    BURIN_TRY_DO(check_reach(bounds, unit));
    const Box seen = placing.mirrors() ? Box{Vec3(0.0) - bounds.hi, Vec3(0.0) - bounds.lo} : bounds;
    std::printf("%s\n", placed_in_words(seen, placing).c_str());
    return {};
}

void mirror(geometry::TriangleMesh& mesh) {
    for (Vec3& p : mesh.positions_m) p = Vec3(0.0) - p;  // no -0
    geometry::turn_over(mesh);
}

std::string placed_in_words(const Box& bounds_m, const geometry::Placing& placing) {
    const Vec3 middle = glm::round(bounds_m.center() * 1e9) / 1e9 + 0.0;  // to a nanometre, and no -0
    const double size = std::abs(placing.scale);
    std::string words =
        formatted("  placed: the middle of its box is at %.9g, %.9g, %.9g m", middle.x, middle.y, middle.z);
    if (size != 1.0) words += formatted(", %.9g times as large", size);
    if (placing.mirrors()) words += ", mirrored; what faced outwards still does";
    return words;
}

Result<void> check_reach(const Box& bounds_m, LengthUnit unit) {
    if (bounds_m.empty()) return {};
    const Vec3 farthest = from_metres(glm::max(glm::abs(bounds_m.lo), glm::abs(bounds_m.hi)), unit);
    if (std::max({farthest.x, farthest.y, farthest.z}) <= geometry::kMaxCoordinate) return {};
    return fail("--place and --scale", "would bring the mesh beyond 1e9 of the file's numbers, which no reader takes",
                "give a place nearer to the origin, a smaller factor, or a larger --export-units");
}

}  // namespace burin::app
