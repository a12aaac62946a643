// SPDX-License-Identifier: MIT
#include "tests/app/meshes/file_counts.hpp"

#include "compute/repair/self_intersections.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"

namespace burin::app {

Json counts_of_file(const std::filesystem::path& path) {
    // As metres the numbers stay as they are.
    auto read = geometry::import_mesh(path, LengthUnit::m);
    if (!read) return {};
    geometry::weld_vertices(read->mesh);
    const geometry::MeshHealth health = geometry::examine(read->mesh);
    WorkerPool pool(2);
    return {{"triangles", health.triangles},
            {"vertices", health.vertices},
            {"open_edges", health.boundary_edges},
            {"nonmanifold_edges", health.nonmanifold_edges},
            {"nonmanifold_vertices", health.nonmanifold_vertices},
            {"misoriented_edges", health.misoriented_edges},
            {"crossing_pairs", compute::self_intersections(read->mesh, pool).size()}};
}

Json counts_of_report(const Json& report) {
    Json counts;
    for (const char* key :
         {"triangles", "vertices", "open_edges", "nonmanifold_edges", "nonmanifold_vertices", "misoriented_edges"})
        counts[key] = report["mesh"][key];
    counts["crossing_pairs"] = report["mesh"]["self_intersections"]["left"];
    return counts;
}

}  // namespace burin::app
