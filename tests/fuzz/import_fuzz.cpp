// SPDX-License-Identifier: MIT
// libFuzzer body of the four import fuzzers; BURIN_FUZZ_FORMAT names the format. Whatever the bytes: no fault, no hang,
// no memory beyond a multiple of the input (run with -rss_limit_mb and -malloc_limit_mb), every face accounted for; and
// what is accepted can be examined, closed, oriented, written and read again.
#include <cstdlib>

#include "geometry/files/mesh_export.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"

namespace {

using burin::geometry::MeshFormat;

void require(bool condition) {
    if (!condition) std::abort();
}

void check_accounts(const burin::geometry::ImportedMesh& read) {
    const burin::geometry::ImportReport& r = read.report;
    require(r.faces_in_file == r.triangles_in_file + r.polygons_in_file + r.faces_without_area);
    require(r.polygons_in_file == r.polygons_fanned + r.polygons_swept + r.polygons_touching + r.polygons_crossing);
    require(read.mesh.triangles.size() >= r.triangles_in_file + 2 * r.polygons_in_file);
    require(read.mesh.triangle_materials.empty() || read.mesh.triangle_materials.size() == read.mesh.triangles.size());
    require(read.mesh.materials.size() <= burin::geometry::kMaxMaterials);
    for (const std::uint8_t m : read.mesh.triangle_materials) require(m < read.mesh.materials.size());
    for (const auto& t : read.mesh.triangles) {
        for (const std::uint32_t v : t) require(v < read.mesh.positions_m.size());
    }
    for (const auto& p : read.mesh.positions_m) {
        for (int k = 0; k < 3; ++k)
            require(p[k] >= -burin::geometry::kMaxCoordinate && p[k] <= burin::geometry::kMaxCoordinate);
    }
}

void check_repair(burin::geometry::TriangleMesh mesh) {
    burin::geometry::weld_vertices(mesh);
    burin::geometry::close_holes(mesh);
    burin::geometry::orient_outward(mesh);
    const burin::geometry::MeshHealth health = burin::geometry::examine(mesh);
    require(health.holes == 0 && health.boundary_edges == 0);
    require(health.closed == (health.edges > 0));
    static_cast<void>(burin::geometry::complaints(health));
}

void check_round_trip(const burin::geometry::TriangleMesh& mesh) {
    const auto bytes = burin::geometry::encode_mesh(mesh, geometry::MeshFormat::obj, "again");
    require(bytes.has_value());
    const auto again = burin::geometry::import_mesh(bytes->mesh, geometry::MeshFormat::obj, "again");
    require(again && again->mesh.triangles == mesh.triangles && again->mesh.positions_m == mesh.positions_m);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    // The same bytes stand in for every material file, so that its reader is exercised as well.
    const burin::geometry::MaterialFileReader materials = [&](std::string_view) -> burin::Result<std::string> {
        return std::string(reinterpret_cast<const char*>(data), size);
    };
    const auto read = burin::geometry::import_mesh(bytes, geometry::MeshFormat::BURIN_FUZZ_FORMAT, "fuzz", materials);
    if (!read) {
        require(!read.error().what.empty() && !read.error().where.empty() && !read.error().remedy.empty());
        return 0;
    }
    check_accounts(*read);
    check_round_trip(read->mesh);
    if (read->mesh.triangles.size() < 2000) check_repair(read->mesh);
    return 0;
}
