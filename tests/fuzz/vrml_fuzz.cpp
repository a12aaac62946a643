// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of worlds. Whatever the bytes: no fault, no hang, no memory beyond the bounds (run with
// -rss_limit_mb); every fault has a place and a remedy; what is accepted is finite and has sound indices. Inline opens
// the same bytes again.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geometry/vrml/vrml_shapes.hpp"

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

void check_error(const burin::Error& error) {
    require(!error.what.empty() && !error.where.empty() && !error.remedy.empty());
}

void check_shape(const burin::geometry::VrmlShape& shape) {
    const burin::geometry::TriangleMesh& mesh = shape.surface->mesh;
    require(!mesh.triangles.empty());
    require(shape.surface->corner_colours.empty() || shape.surface->corner_colours.size() == mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            require(v < mesh.positions_m.size());
            require(burin::finite(burin::Vec3(shape.world_from_shape * glm::dvec4(mesh.positions_m[v], 1.0))));
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    // Most inputs would end at the first line.
    const std::string whole = "#VRML V2.0 utf8\n" + text;
    for (const std::string& bytes : {text, whole}) {
        const auto file = burin::geometry::read_vrml(
            bytes, "fuzz", [&](const std::string&) -> burin::Result<std::string> { return whole; });
        if (!file) {
            check_error(file.error());
            continue;
        }
        const auto world = burin::geometry::shapes_of(*file);
        if (!world) {
            require(!world.error().empty());
            for (const burin::Error& error : world.error()) check_error(error);
            continue;
        }
        for (const burin::geometry::VrmlShape& shape : world->shapes) check_shape(shape);
    }
    return 0;
}
