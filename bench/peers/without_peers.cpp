// SPDX-License-Identifier: MIT
// Replaces the peers, those of bench/frame/ too, in a build without them.
#include "bench/frame/frame_peers.hpp"
#include "bench/peers/peers.hpp"

namespace burin::bench {
namespace {

std::unexpected<Error> not_built(const char* library) {
    return fail(library, "is not built into this program",
                "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
}

}  // namespace

bool has_peers() { return false; }

Result<PeerRun> run_openvdb(const CarveScene& /*scene*/, const compute::Lattice& /*lattice*/, unsigned /*threads*/,
                            VdbMethod /*method*/) {
    return not_built("OpenVDB");
}

Result<PeerRun> run_cgal(const CarveScene& /*scene*/, int /*subdivisions*/) { return not_built("CGAL"); }

Result<std::uint64_t> count_self_intersections_with_cgal(const geometry::TriangleMesh& /*mesh*/) {
    return not_built("CGAL");
}

bool has_frame_peers() { return false; }

Result<std::unique_ptr<FrameSubject>> open_osg(const FrameScene& /*scene*/, unsigned /*samples*/,
                                               OsgDrawables /*drawables*/, const FrameWay& /*way*/) {
    return not_built("OpenSceneGraph");
}

Result<std::unique_ptr<FrameSubject>> open_vtk(const FrameScene& /*scene*/, unsigned /*samples*/,
                                               const FrameWay& /*way*/, bool /*gouraud*/) {
    return not_built("VTK");
}

}  // namespace burin::bench
