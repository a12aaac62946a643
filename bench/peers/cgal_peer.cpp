// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/version.h>

#include <array>
#include <exception>
#include <iterator>
#include <map>

#include "bench/measure/timing.hpp"
#include "bench/peers/peers.hpp"

namespace burin::bench {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Mesh from_triangles(const geometry::TriangleMesh& triangles) {
    Mesh mesh;
    std::vector<Mesh::Vertex_index> vertices;
    for (const Vec3& p : triangles.positions_m) vertices.push_back(mesh.add_vertex(Point(p.x, p.y, p.z)));
    for (const auto& t : triangles.triangles) mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    return mesh;
}

geometry::TriangleMesh to_triangles(const Mesh& mesh) {
    geometry::TriangleMesh triangles;
    std::map<Mesh::Vertex_index, std::uint32_t> index;
    for (const auto v : mesh.vertices()) {
        index[v] = static_cast<std::uint32_t>(triangles.positions_m.size());
        const Point& p = mesh.point(v);
        triangles.positions_m.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : mesh.faces()) {
        std::array<std::uint32_t, 3> t{};
        std::size_t k = 0;
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) t[k++] = index[v];
        triangles.triangles.push_back(t);
    }
    return triangles;
}

Mesh unit_cube() {
    Mesh mesh;
    CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1),
                          Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1), mesh);
    pmp::triangulate_faces(mesh);
    return mesh;
}

// Returns a unit icosphere: an icosahedron whose triangles are
// split in four, the new corners pushed out onto the sphere.
geometry::TriangleMesh icosphere(int subdivisions) {
    Mesh mesh;
    CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
    geometry::TriangleMesh ball = to_triangles(mesh);
    for (Vec3& p : ball.positions_m) p = glm::normalize(p);
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(ball.positions_m.size()));
            if (fresh) ball.positions_m.push_back(glm::normalize(ball.positions_m[a] + ball.positions_m[b]));
            return at->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : ball.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        ball.triangles = std::move(finer);
    }
    return ball;
}

geometry::TriangleMesh placed(geometry::TriangleMesh ball, const compute::BallSweep& stamp) {
    for (Vec3& p : ball.positions_m) p = stamp.start_object_m + p * stamp.radius_m;
    return ball;
}

Result<PeerRun> carve(const CarveScene& scene, int subdivisions) {
    PeerRun run;
    const geometry::TriangleMesh unit_ball = icosphere(subdivisions);
    run.peer = "CGAL " CGAL_VERSION_STR;
    run.method = "corefinement, first " + std::to_string(scene.sweeps.size()) + " updates";
    run.detail = "ball of " + std::to_string(unit_ball.triangles.size());
    run.threads = 1;
    Mesh solid = unit_cube();
    for (const compute::BallSweep& stamp : scene.sweeps) {
        const double cpu_before_ms = process_cpu_ms();
        Stopwatch watch;
        Mesh ball = from_triangles(placed(unit_ball, stamp));
        run.tool_ms.push_back(watch.lap_ms());
        if (!pmp::corefine_and_compute_difference(solid, ball, solid)) {
            return fail(run.peer, "could not take ball " + std::to_string(run.update_ms.size()) + " out of the cube",
                        "take fewer updates");
        }
        run.boolean_ms.push_back(watch.lap_ms());
        run.mesh_ms.push_back(0.0);
        run.update_ms.push_back(run.tool_ms.back() + run.boolean_ms.back());
        run.cpu_ms.push_back(process_cpu_ms() - cpu_before_ms);
        run.triangles_remeshed.push_back(static_cast<double>(solid.number_of_faces()));
    }
    solid.collect_garbage();
    run.mesh = to_triangles(solid);
    return run;
}

}  // namespace

Result<PeerRun> run_cgal(const CarveScene& scene, int subdivisions) {
    if (!scene.only_stamps()) {
        return fail(scene.name, "has sweeps, and the mesh tool is a ball at one place", "use the scene of stamps");
    }
    try {
        return carve(scene, subdivisions);
    } catch (const std::exception& error) {
        return fail("CGAL", error.what(), "take fewer updates");
    }
}

Result<std::uint64_t> count_self_intersections_with_cgal(const geometry::TriangleMesh& mesh) {
    try {
        const Mesh surface = from_triangles(mesh);
        if (surface.number_of_faces() != mesh.triangles.size()) {
            return fail("CGAL", "cannot hold a mesh that is not manifold", "look at bad_edges first");
        }
        std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
        pmp::self_intersections(surface, std::back_inserter(pairs));
        return pairs.size();
    } catch (const std::exception& error) {
        return fail("CGAL", error.what());
    }
}

}  // namespace burin::bench
