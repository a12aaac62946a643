// SPDX-License-Identifier: MIT
// Replaces the peers of bench/frame/ in a build without them.
#include "bench/frame/frame_peers.hpp"

namespace burin::bench {
namespace {

std::unexpected<Error> not_built(const char* library) {
    return fail(library, "is not built into this program",
                "install it with scripts/setup --peers and configure with -DBURIN_WITH_PEERS=ON");
}

}  // namespace

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
