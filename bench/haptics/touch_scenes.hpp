// SPDX-License-Identifier: MIT
// The meshes that bench haptics touches: a smooth sphere (bumpy_sphere.hpp), generated detail (rough_surfaces.hpp), the
// workpiece that comes with the program, and the meshes of a folder of the user's: scans, machined parts, whatever is
// to be touched. All but the generated ones are moved to the origin and scaled to 100 mm in their largest extent.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/assets.hpp"
#include "base/error.hpp"
#include "bench/haptics/surface_walk.hpp"
#include "geometry/contact/local_surface.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "haptics/tick_parameters.hpp"

namespace burin::bench {

struct TouchScene {
    std::string name;
    bool smooth = false;                                   // a sphere, which is easier than what is touched in use
    std::function<Result<geometry::TriangleMesh>()> make;  // makes or reads it; may take seconds
};

struct TouchScenes {
    std::vector<TouchScene> scenes;
    std::vector<std::string> notes;  // for the user: what is missing
};

struct TouchSceneOptions {
    std::vector<std::size_t> spheres = {};  // approximate triangle counts
    std::size_t rough_triangles = 200'000;
    std::uint32_t sides = 64, needles = 40;
    std::string workpiece = asset_path("workpieces/soccer_ball.obj");
    std::string models = {};  // a folder; empty: none
};

// Fails where the folder of models cannot be read or holds none.
[[nodiscard]] Result<TouchScenes> touch_scenes(const TouchSceneOptions& options);

// A mesh that is touched, ready for every probe, and for other programs' proxies beside ours.
struct TouchedScene {
    std::string name;
    bool smooth = false;
    geometry::TriangleMesh mesh;
    std::shared_ptr<const geometry::TouchSnapshot> snapshot;
    SurfaceWalk walk;  // has not moved yet
    geometry::TriangleTree tree;
    bool both_sides = false;  // an open mesh, which has no inside: felt as a scene feels it
};

[[nodiscard]] Result<std::unique_ptr<const TouchedScene>> touched(const TouchScene& scene);

// Counts the hands from which a ball of this radius, or a point, should have felt the mesh. Looks at some hundreds of
// them at most, and draws on all.
[[nodiscard]] std::uint64_t contacts_lost(const TouchedScene& scene, const std::vector<Vec3>& hands_m, double radius_m);

// Sets the surface to the whole mesh, as it is published at this time.
void fill(geometry::LocalSurface& draft, const TouchedScene& scene, std::uint64_t sequence, Nanoseconds now_ns);

// Moves the mesh's middle to the origin and scales its largest extent to this length.
[[nodiscard]] geometry::TriangleMesh scaled_to(geometry::TriangleMesh mesh, double extent_m);

struct NamedProbe {
    std::string name;
    haptics::Probe probe;
    double radius_m = 0.0;
};

// Returns a point, balls of 2 and 5 mm, balls of 1, 3.5, 7 and 14 mean edges, two points and 20 points; leaves out
// balls of more than 20 mm.
[[nodiscard]] std::vector<NamedProbe> probes_on(double mean_edge_m);

// Returns the parameters of a tick as a live session sets them (parameters_of in session/state/session_state.cpp), with
// the medium material, or with its friction taken away.
[[nodiscard]] haptics::TickParameters session_parameters(const haptics::Probe& probe, bool friction);

}  // namespace burin::bench
