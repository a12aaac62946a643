// SPDX-License-Identifier: MIT
// Draws the same frames with other libraries, for comparison: OpenSceneGraph and VTK.
// Built only with -DBURIN_WITH_PEERS=ON (scripts/setup --peers installs them); without
// them every function here fails with a message. Their headers are not included outside
// bench/frame/. They draw with OpenGL and need a display (bench/frame/frame_display.hpp).
// Each is set up as a user who cares for speed would: see the source files.
#pragma once

#include <memory>

#include "base/error.hpp"
#include "bench/frame/frame.hpp"

namespace burin::bench {

[[nodiscard]] bool has_frame_peers();

enum class OsgDrawables {
    patches,  // each patch a drawable, culled by OpenSceneGraph
    one       // the whole surface as one drawable
};

// Create subjects named "OpenSceneGraph, patches", "OpenSceneGraph, one drawable" and "VTK", which draw all triangles.
// samples: 1 or 4 a pixel. way: where the light is computed, and by which formula.
[[nodiscard]] Result<std::unique_ptr<FrameSubject>> open_osg(const FrameScene& scene, unsigned samples,
                                                             OsgDrawables drawables, const FrameWay& way = {});
// gouraud: also asks for Gouraud's interpolation, which VTK 9 accepts and lights every pixel all the same
// (tests/bench/frame_unit.cpp).
[[nodiscard]] Result<std::unique_ptr<FrameSubject>> open_vtk(const FrameScene& scene, unsigned samples,
                                                             const FrameWay& way = {}, bool gouraud = false);

}  // namespace burin::bench
