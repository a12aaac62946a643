// SPDX-License-Identifier: MIT
// Fills a picture from one of fewer pixels that shows the same: for frames that are drawn at a lower resolution.
// Values between the pixels' middles are interpolated, as the picture stores them.
// Thread: as gpu::Device. Cost on a software driver: some 2 ns a pixel of the larger picture.
#pragma once

#include "gpu/commands.hpp"
#include "renderer/frame/frame_targets.hpp"

namespace burin::renderer {

// Records it for the views that both draw. `from` is in the layout in which its passes leave it, and is left so; what
// `to` holds is lost, and it is left as its passes leave it.
void magnify(const gpu::Device& device, gpu::Commands& commands, const FrameTargets& from, const FrameTargets& to);

}  // namespace burin::renderer
