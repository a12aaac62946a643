// SPDX-License-Identifier: MIT
// Carving scenes that tests and benchmarks share: what is removed from the unit cube [0,1]^3 by one ball, by a capsule,
// and by the thousand balls of STROKE-1000. For a cube the answers are known, also where it is turned against the
// lattice; other workpieces are meshes from elsewhere.
// Lengths in metres. A scene has a frame of its own, in which the cube is [0,1]^3; object_from_scene places it.
#pragma once

#include <string>
#include <vector>

#include "base/space.hpp"
#include "compute/engine/engine.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

struct CarveScene {
    std::string name;
    std::vector<compute::BallSweep> sweeps;    // scene frame
    double removed_m3 = 0.0;                   // exact volume, out of the unit cube; 0 for a mesh
    Pose object_from_scene{};                  // how the workpiece lies on the lattice
    geometry::TriangleMesh workpiece_scene{};  // closed; empty: the unit cube

    // Returns whether every sweep stays where it starts.
    [[nodiscard]] bool only_stamps() const;
    [[nodiscard]] bool is_of_cube() const { return workpiece_scene.triangles.empty(); }
    [[nodiscard]] bool is_turned() const { return object_from_scene != Pose{}; }
};

// Returns the sweep as it lies in the object frame.
[[nodiscard]] compute::BallSweep in_object(const CarveScene& scene, const compute::BallSweep& sweep_scene);
// Returns the uncut workpiece in the object frame as a solid with cells of 1 / resolution. Fails where the mesh cannot
// be converted (compute/rays/scan_convert.hpp).
[[nodiscard]] Result<compute::Solid> uncut_solid(const CarveScene& scene, int resolution, WorkerPool& pool);

// A ball whose centre lies 0.05 below the top face: the removed part is the ball without its cap.
[[nodiscard]] CarveScene ball_scene();
// A capsule with its axis in the top face, at an angle to the lattice: half of it is removed.
[[nodiscard]] CarveScene capsule_scene();
// A capsule inside the cube, askew on all axes: a closed cavity.
[[nodiscard]] CarveScene cavity_scene();
// p(t) = (0.5 + 0.42 sin 6 pi t, 0.5 + 0.42 sin (4 pi t + 0.6), 0.985 + 0.03 sin 10 pi t), t = i / 999, radius 0.06, as
// 1000 stamps. The removed volume is from analytic rays, up to 8192^2 of them: 0.03323742(1).
[[nodiscard]] CarveScene stroke_1000_scene();
// Joins these positions by 999 capsules. The removed volume is from 1024^2 to 4096^2 rays (removed_volume_m3 in
// bench/measure/exact_rays.hpp), which give 0.03326591, 0.03326630, 0.03326626: 0.03326625(2).
[[nodiscard]] CarveScene stroke_1000_swept_scene();
// Returns the scene turned by 20 degrees about the axis (1, 2, 3) through the cube's centre: no face or edge lies along
// the lattice.
[[nodiscard]] CarveScene turned(CarveScene scene);
// Returns STROKE-1000 on another workpiece: the closed mesh, scaled to a longest side of 1 and centred in the cube,
// is cut at the places at which lines from its centre through the cube's stroke leave it, as deep as there. A place
// whose line misses the mesh is left out; `swept` joins the places by capsules. Fails where fewer than two are left.
[[nodiscard]] Result<CarveScene> stroke_on_mesh_scene(const std::string& name, geometry::TriangleMesh mesh, bool swept);
// Returns the first `sweeps` of a scene; the removed volume of a cube is from rays_a_side^2 analytic rays.
[[nodiscard]] CarveScene beginning_of(const CarveScene& scene, std::size_t sweeps, int rays_a_side);

}  // namespace burin::bench
