// SPDX-License-Identifier: MIT
// Does the same work with other libraries, for comparison: OpenVDB (narrow-band level sets) and CGAL (exact mesh
// Booleans). Built only with -DBURIN_WITH_PEERS=ON (scripts/setup --peers installs them); without them every function
// here fails with a message. Their headers are not included outside bench/peers/.
// Each uses as many threads as it is given. Lengths in metres, object frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/measure/scenes.hpp"
#include "compute/rays/lattice.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

struct PeerRun {
    std::string peer, method;
    std::string detail;  // of the method: cells a side, or the tool's triangles
    unsigned threads = 0;
    // Wall time of each update: the tool's own field or mesh, the
    // Boolean, the triangles of the changed region, and all three.
    std::vector<double> tool_ms, boolean_ms, mesh_ms, update_ms;
    std::vector<double> cpu_ms;  // of all three, all threads
    std::vector<double> triangles_remeshed;
    std::size_t bytes = 0;  // of the solid; 0 where the library does not report it
    double whole_mesh_ms = 0.0;
    geometry::TriangleMesh mesh;  // of the whole solid after the last update
};

[[nodiscard]] bool has_peers();

// What is said of a peer that needs -DBURIN_WITH_PEERS=ON, those of bench/frame/ included.
[[nodiscard]] inline std::unexpected<Error> peer_not_built(const std::string& peer) {
    return fail(peer, "is not built into this program",
                "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
}

enum class VdbMethod {
    csg_difference,  // a level set of the ball, csgDifference with pruning: what the library's documentation shows
    leaf_brush       // the ball's distance written into the 8^3 leaves it touches, in parallel: the best a user can do
};

// Carves the cube as a level set whose voxels lie on the lattice's nodes, half width 3 voxels,
// removing the scene's stamps one by one. After each, the leaves that the ball's surface touches
// are meshed with the library's own meshing steps, given only those leaves. Quads at the border
// of that region that a neighbouring leaf would add are left out, which favours the library.
[[nodiscard]] Result<PeerRun> run_openvdb(const CarveScene& scene, const compute::Lattice& lattice, unsigned threads,
                                          VdbMethod method);

// Runs corefine_and_compute_difference on the cube with a ball of 20 * 4^subdivisions triangles with its corners on the
// sphere; inexact constructions, one thread. There is no meshing step. Costs grow with the mesh: give it a short scene.
[[nodiscard]] Result<PeerRun> run_cgal(const CarveScene& scene, int subdivisions);

// Counts pairs of triangles that meet elsewhere than in shared corners and edges, by CGAL's exact predicates.
[[nodiscard]] Result<std::uint64_t> count_self_intersections_with_cgal(const geometry::TriangleMesh& mesh);

}  // namespace burin::bench
