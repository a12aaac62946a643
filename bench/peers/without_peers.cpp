// SPDX-License-Identifier: MIT
// Replaces the peers in a build without them.
#include "bench/peers/peers.hpp"

namespace burin::bench {

bool has_peers() { return false; }

Result<PeerRun> run_openvdb(const CarveScene& /*scene*/, const compute::Lattice& /*lattice*/, unsigned /*threads*/,
                            VdbMethod /*method*/) {
    return peer_not_built("OpenVDB");
}

Result<PeerRun> run_cgal(const CarveScene& /*scene*/, int /*subdivisions*/) { return peer_not_built("CGAL"); }

Result<std::uint64_t> count_self_intersections_with_cgal(const geometry::TriangleMesh& /*mesh*/) {
    return peer_not_built("CGAL");
}

}  // namespace burin::bench
