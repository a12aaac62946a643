// SPDX-License-Identifier: MIT
#include "desk/present/frame_output.hpp"

#include <utility>

namespace burin::session {

compute::EngineMaker FrameOutput::engine_maker(compute::EngineChoice choice) {
    if (choice != compute::EngineChoice::cpu) offered_ = std::make_shared<compute::OfferedDevice>();
    return compute::engine_maker(choice, [this] { return lane(); }, offered_);
}

std::optional<scene::SceneOrder> FrameOutput::offer() {
    if (!offered_) return std::nullopt;
    const Result<gpu::Device> opened = lane();
    if (!opened) return std::nullopt;  // lost again: the next recovery offers another
    return scene::SceneOrder::aside([to = offered_, lane = *opened] { to->offer(lane); });
}

SessionSetup carving_with(FrameOutput& output, SessionSetup options) {
    if (!options.carve.make_engine && has_workpiece(options))
        options.carve.make_engine = output.engine_maker(options.carve.engine);
    return options;
}

}  // namespace burin::session
