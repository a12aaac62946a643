// SPDX-License-Identifier: MIT
// The same frames drawn by other libraries, for comparison: OpenSceneGraph and VTK. Built only with -DBURIN_WITH_PEERS=ON
// (scripts/setup --peers installs them); without them every function here fails and says so. No header of theirs is seen
// outside bench/peers/. They draw with OpenGL and need a display (bench/frame_display.hpp).
// Each is set up as a user who cares for speed would: see the files.
#pragma once

#include <memory>

#include "base/error.hpp"
#include "bench/frame.hpp"

namespace burin::bench {

[[nodiscard]] bool has_frame_peers();

enum class OsgDrawables {
    patches,  // each patch a drawable, culled as OpenSceneGraph does it
    one       // the whole surface as one
};

// Names: "OpenSceneGraph, patches", "OpenSceneGraph, one drawable", "VTK". samples: 1 or 4 a pixel.
[[nodiscard]] Result<std::unique_ptr<FrameSubject>> open_osg(const FrameScene& scene, unsigned samples,
                                                             OsgDrawables drawables);
[[nodiscard]] Result<std::unique_ptr<FrameSubject>> open_vtk(const FrameScene& scene, unsigned samples);

}  // namespace burin::bench
