// SPDX-License-Identifier: MIT
// Replaces the peers of bench/frame/ in a build without them.
#include "bench/frame/frame_peers.hpp"
#include "bench/peers/peers.hpp"

namespace burin::bench {

bool has_frame_peers() { return false; }

Result<std::unique_ptr<FrameSubject>> open_osg(const FrameScene& /*scene*/, unsigned /*samples*/,
                                               OsgDrawables /*drawables*/, const FrameWay& /*way*/) {
    return peer_not_built("OpenSceneGraph");
}

Result<std::unique_ptr<FrameSubject>> open_vtk(const FrameScene& /*scene*/, unsigned /*samples*/,
                                               const FrameWay& /*way*/, bool /*gouraud*/) {
    return peer_not_built("VTK");
}

}  // namespace burin::bench
