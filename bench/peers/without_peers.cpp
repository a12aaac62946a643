// SPDX-License-Identifier: MIT
// Stands in for the peers where they are not built.
#include "bench/peers/peers.hpp"

namespace burin::bench {
namespace {

std::unexpected<Error> not_built(const char* library) {
    return fail(library, "is not built into this program",
                "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
}

}  // namespace

bool has_peers() { return false; }

Result<PeerRun> run_openvdb(const CarveScene& /*scene*/, const Lattice& /*lattice*/, unsigned /*threads*/,
                            VdbMethod /*method*/) {
    return not_built("OpenVDB");
}

Result<PeerRun> run_cgal(const CarveScene& /*scene*/, int /*subdivisions*/) { return not_built("CGAL"); }

Result<std::uint64_t> count_self_intersections_with_cgal(const TriangleMesh& /*mesh*/) { return not_built("CGAL"); }

}  // namespace burin::bench
