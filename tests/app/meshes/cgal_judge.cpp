// SPDX-License-Identifier: MIT
#include "tests/app/meshes/cgal_judge.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace burin::app {

std::optional<CgalVerdict> judge_by_cgal(const std::string& path) {
    namespace processing = CGAL::Polygon_mesh_processing;
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    CgalVerdict verdict;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> triangles;
    verdict.is_read = CGAL::IO::read_polygon_soup(path, points, triangles);
    if (!verdict.is_read) return verdict;
    processing::merge_duplicate_points_in_polygon_soup(points, triangles);
    verdict.is_manifold = processing::is_polygon_soup_a_polygon_mesh(triangles);
    if (!verdict.is_manifold) return verdict;
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
    verdict.is_closed = CGAL::is_closed(mesh);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    processing::self_intersections(mesh, std::back_inserter(pairs));
    verdict.crossing_pairs = pairs.size();
    return verdict;
}

}  // namespace burin::app
