// SPDX-License-Identifier: MIT
#include "bench/measure/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/try.hpp"
#include "bench/measure/exact_rays.hpp"
#include "compute/rays/scan_convert.hpp"
#include "geometry/mesh/mesh_placing.hpp"

namespace burin::bench {
namespace {

constexpr int kPlaces = 1000;
constexpr double kStrokeRadius_m = 0.06;
const Vec3 kCubeCentre(0.5);

Vec3 stroke_place(int i) {
    const double t = i / (kPlaces - 1.0);
    return {0.5 + 0.42 * std::sin(6 * std::numbers::pi * t), 0.5 + 0.42 * std::sin(4 * std::numbers::pi * t + 0.6),
            0.985 + 0.03 * std::sin(10 * std::numbers::pi * t)};
}

geometry::TriangleMesh cube_mesh() {
    geometry::TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner) mesh.positions_m.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

// Scales the mesh to a longest side of 1 and moves the centre of its bounds to that of the cube.
void fit_into_cube(geometry::TriangleMesh& mesh) {
    const Box bounds = geometry::bounds_of(mesh);
    const Vec3 size = bounds.extent();
    const double longest_m = std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh.positions_m) p = (p - bounds.center()) / longest_m + kCubeCentre;
}

// Returns how far from `from`, along the unit vector, the ray leaves the mesh for the last time; nullopt where it
// misses. By Moller and Trumbore 1997.
std::optional<double> last_crossing(const geometry::TriangleMesh& mesh, const Vec3& from, const Vec3& along) {
    std::optional<double> last;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3& a = mesh.positions_m[i];
        const Vec3 ab = mesh.positions_m[j] - a, ac = mesh.positions_m[k] - a, q = glm::cross(along, ac), to = from - a;
        const double determinant = glm::dot(ab, q);
        if (determinant == 0.0) continue;
        const double u = glm::dot(to, q) / determinant;
        const Vec3 r = glm::cross(to, ab);
        const double v = glm::dot(along, r) / determinant;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        const double distance = glm::dot(ac, r) / determinant;
        if (distance > last.value_or(0.0)) last = distance;
    }
    return last;
}

}  // namespace

bool CarveScene::only_stamps() const {
    return std::ranges::all_of(sweeps, [](const compute::BallSweep& s) { return s.start_object_m == s.end_object_m; });
}

compute::BallSweep in_object(const CarveScene& scene, const compute::BallSweep& sweep_scene) {
    compute::BallSweep sweep = sweep_scene;
    sweep.start_object_m = scene.object_from_scene * sweep_scene.start_object_m;
    sweep.end_object_m = scene.object_from_scene * sweep_scene.end_object_m;
    return sweep;
}

Result<compute::Solid> uncut_solid(const CarveScene& scene, int resolution, WorkerPool& pool) {
    const geometry::Material material{"cube", {200, 200, 200}};
    if (scene.is_of_cube() && !scene.is_turned()) return compute::make_block(Vec3(1.0), resolution, material);
    geometry::TriangleMesh mesh = scene.is_of_cube() ? cube_mesh() : scene.workpiece_scene;
    for (Vec3& p : mesh.positions_m) p = scene.object_from_scene * p;
    mesh.triangle_materials.clear();
    mesh.materials = {material};
    const Vec3 size = geometry::bounds_of(mesh).extent();
    const double longest_m = std::max({size.x, size.y, size.z});
    const int cells = static_cast<int>(std::lround(longest_m * resolution));
    BURIN_TRY(converted, compute::scan_convert(mesh, cells, pool));
    return std::move(converted.solid);
}

CarveScene ball_scene() {
    constexpr double r = 0.2, depth = 0.05, cap_height = r - depth;
    const Vec3 center(0.47, 0.52, 1.0 - depth);
    const double cap = std::numbers::pi * cap_height * cap_height * (3 * r - cap_height) / 3;
    return {"ball", {{center, center, r, 0}}, 4.0 / 3.0 * std::numbers::pi * r * r * r - cap};
}

CarveScene capsule_scene() {
    constexpr double r = 0.12;
    const Vec3 from(0.31, 0.27, 1.0), to(0.66, 0.71, 1.0);
    const double length = glm::length(to - from);
    return {"capsule", {{from, to, r, 0}}, 0.5 * std::numbers::pi * r * r * (length + 4.0 / 3.0 * r)};
}

CarveScene cavity_scene() {
    constexpr double r = 0.13;
    const Vec3 from(0.3, 0.35, 0.31), to(0.62, 0.55, 0.7);
    const double length = glm::length(to - from);
    return {"cavity", {{from, to, r, 0}}, std::numbers::pi * r * r * (length + 4.0 / 3.0 * r)};
}

CarveScene stroke_1000_scene() {
    CarveScene scene{"stroke-1000", {}, 0.03323742};
    for (int i = 0; i < kPlaces; ++i) {
        scene.sweeps.push_back({stroke_place(i), stroke_place(i), kStrokeRadius_m, 0});
    }
    return scene;
}

CarveScene stroke_1000_swept_scene() {
    CarveScene scene{"stroke-1000-swept", {}, 0.03326625};
    for (int i = 0; i + 1 < kPlaces; ++i) {
        scene.sweeps.push_back({stroke_place(i), stroke_place(i + 1), kStrokeRadius_m, 0});
    }
    return scene;
}

CarveScene turned(CarveScene scene) {
    const Quat turn = glm::angleAxis(std::numbers::pi / 9.0, glm::normalize(Vec3(1.0, 2.0, 3.0)));
    scene.name += "-turned";
    scene.object_from_scene = {kCubeCentre - turn * kCubeCentre, turn};
    return scene;
}

Result<CarveScene> stroke_on_mesh_scene(const std::string& name, geometry::TriangleMesh mesh, bool swept) {
    fit_into_cube(mesh);
    std::vector<Vec3> places;
    for (int i = 0; i < kPlaces; ++i) {
        const Vec3 on_cube = stroke_place(i), outwards = glm::normalize(on_cube - kCubeCentre);
        const std::optional<double> distance_m = last_crossing(mesh, kCubeCentre, outwards);
        if (distance_m) places.push_back(kCubeCentre + outwards * (*distance_m + on_cube.z - 1.0));
    }
    if (places.size() < 2) {
        return fail(name, "does not surround the middle of its bounds, so there is nowhere to carve",
                    "choose a mesh whose middle lies inside it");
    }
    CarveScene scene{name, {}, 0.0, {}, std::move(mesh)};
    for (std::size_t i = 0; i + (swept ? 1 : 0) < places.size(); ++i) {
        scene.sweeps.push_back({places[i], places[swept ? i + 1 : i], kStrokeRadius_m, 0});
    }
    return scene;
}

CarveScene beginning_of(const CarveScene& scene, std::size_t sweeps, int rays_a_side) {
    CarveScene beginning = scene;
    beginning.sweeps.resize(std::min(sweeps, scene.sweeps.size()));
    beginning.name += " (first " + std::to_string(beginning.sweeps.size()) + ")";
    if (scene.is_of_cube()) beginning.removed_m3 = removed_volume_m3(beginning.sweeps, rays_a_side);
    return beginning;
}

}  // namespace burin::bench
