// SPDX-License-Identifier: MIT
#include "bench/measure/surface_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/measure/exact_creases.hpp"
#include "bench/measure/point_distances.hpp"
#include "bench/measure/swept_union.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::bench {
namespace {

constexpr double kSharp_rad = std::numbers::pi / 6.0;
constexpr int kEdgePoints = 1999, kRimLines = 1999;  // prime, so that they are not commensurate with a lattice
constexpr double kCreaseStep_m = 0.001;

class SpreadSum {
public:
    void add(double x) {
        sum2_ += x * x;
        max_ = std::max(max_, std::abs(x));
        ++samples_;
    }
    [[nodiscard]] Spread spread() const {
        return {samples_ > 0 ? std::sqrt(sum2_ / static_cast<double>(samples_)) : 0.0, max_, samples_};
    }

private:
    double sum2_ = 0.0, max_ = 0.0;
    std::size_t samples_ = 0;
};

Spread spread_to_mesh(const std::vector<Vec3>& points, const geometry::TriangleMesh& mesh, double cell_m) {
    SpreadSum sum;
    for (const double distance : distances_to_mesh(points, mesh, 2.0 * cell_m)) sum.add(distance);
    return sum.spread();
}

// Returns the vertices and the triangles' centres.
std::vector<Vec3> samples_of(const geometry::TriangleMesh& mesh) {
    std::vector<Vec3> points = mesh.positions_m;
    points.reserve(mesh.positions_m.size() + mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        points.push_back((mesh.positions_m[t[0]] + mesh.positions_m[t[1]] + mesh.positions_m[t[2]]) / 3.0);
    }
    return points;
}

void measure_surface(const geometry::TriangleMesh& mesh, const CarveScene& scene, const SweptUnion& tools,
                     double cell_m, SurfaceErrors& errors) {
    SpreadSum whole, cut;
    const auto add = [&](const SweptUnion::SurfaceError& at) {
        whole.add(at.error_m);
        if (at.in_cut_region) cut.add(at.error_m);
    };
    const std::vector<Vec3> samples = samples_of(mesh);
    if (scene.is_of_cube()) {
        for (const Vec3& p : samples) add(tools.surface_error(p));
    } else {
        const std::vector<double> workpiece_m = distances_to_mesh(samples, scene.workpiece_scene, 2.0 * cell_m);
        for (std::size_t i = 0; i < samples.size(); ++i) add(tools.surface_error(samples[i], workpiece_m[i]));
    }
    errors.surface_m = whole.spread();
    errors.cut_m = cut.spread();
}

// Returns the mesh in the scene's frame.
geometry::TriangleMesh in_scene(geometry::TriangleMesh mesh, const CarveScene& scene) {
    if (!scene.is_turned()) return mesh;
    const Quat scene_from_object = glm::conjugate(scene.object_from_scene.orientation);
    for (Vec3& p : mesh.positions_m) p = scene_from_object * (p - scene.object_from_scene.position_m);
    return mesh;
}

}  // namespace

SurfaceErrors measure(const geometry::TriangleMesh& mesh_object, const CarveScene& scene, double cell_m) {
    SurfaceErrors errors;
    const geometry::TriangleMesh mesh = in_scene(mesh_object, scene);
    const SweptUnion tools(scene.sweeps);
    const geometry::MeshHealth health = geometry::examine(mesh);
    errors.triangles = health.triangles;
    errors.bad_edges = health.boundary_edges + health.nonmanifold_edges + health.misoriented_edges;
    measure_surface(mesh, scene, tools, cell_m, errors);
    errors.of_cube = scene.is_of_cube();
    if (!errors.of_cube) return errors;
    errors.volume_over_removed = (health.signed_volume_m3 - (1.0 - scene.removed_m3)) / scene.removed_m3;
    errors.edge_m = spread_to_mesh(untouched_edge_points(tools, kEdgePoints, 2.0 * cell_m), mesh, cell_m);
    errors.corner_m = spread_to_mesh(untouched_corners(tools, 2.0 * cell_m), mesh, cell_m);
    errors.rim_m = spread_to_mesh(rim_points(scene, kRimLines), mesh, cell_m);
    errors.has_creases = scene.only_stamps();
    if (errors.has_creases) {
        errors.crease_m =
            spread_to_mesh(ball_ball_crease_points(scene, tools, kSharp_rad, kCreaseStep_m), mesh, cell_m);
    }
    return errors;
}

double worst_normal_rad(const compute::Surface& surface, const CarveScene& scene) {
    const SweptUnion tools(scene.sweeps);
    const double away = 2.0 * surface.lattice().spacing_m;
    double worst = 0.0;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        for (const shared::SurfaceVertex& v : surface.tile(t).vertices) {
            const Vec3 p = surface.lattice().origin_object + Vec3(v.x, v.y, v.z);
            if (cube_distance(p) > -away || !tools.surface_error(p).in_cut_region) continue;
            const SweptUnion::Nearest nearest = tools.nearest(p);
            if (nearest.second_m - nearest.distance_m < away) continue;
            const shared::Direction n = shared::decode_normal(v.normal);
            const Vec3 normal(n.x, n.y, n.z), exact = glm::normalize(nearest.towards_axis);
            worst = std::max(worst, glm::length(glm::cross(normal, exact)));
            if (glm::dot(normal, exact) < 0.0) worst = std::numbers::pi;
        }
    }
    return worst;
}

}  // namespace burin::bench
