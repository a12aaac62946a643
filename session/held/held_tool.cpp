// SPDX-License-Identifier: MIT
#include "session/held/held_tool.hpp"

#include "base/try.hpp"
#include "picture/drawn_mesh.hpp"
#include "session/held/pen_at_rest.hpp"

#include <algorithm>

namespace burin::session {

Result<void> ToolMeshes::read(const toolbox::ToolSpec& tool) {
    if (tool.kind != toolbox::ToolKind::mesh || shape_of(tool)) return {};
    BURIN_TRY(shape, toolbox::make_shape(tool));
    read_.emplace_back(tool, std::move(shape));
    return {};
}

Result<compute::ToolShape> ToolMeshes::shape_of(const toolbox::ToolSpec& tool) const {
    if (tool.kind != toolbox::ToolKind::mesh) return toolbox::make_shape(tool);
    const auto known = std::ranges::find(read_, tool, [](const auto& one) { return one.first; });
    if (known != read_.end()) return known->second;
    return fail("tool " + toolbox::text_of(tool), "has not been read, and a running session reads no files",
                "start the session with it (--tool), or take it up in its --input");
}

Result<std::shared_ptr<const HeldTool>> take_up(const toolbox::ToolSpec& tool, const ToolMeshes& meshes) {
    BURIN_TRY(shape, meshes.shape_of(tool));
    return take_up(tool, std::move(shape));
}

std::shared_ptr<const HeldTool> take_up(const toolbox::ToolSpec& tool, compute::ToolShape shape) {
    auto held = std::make_shared<HeldTool>();
    held->spec = tool;
    held->felt = toolbox::felt_tool(shape);
    if (!std::holds_alternative<compute::BallTool>(shape))
        held->drawn = picture::drawn_mesh(toolbox::drawing_of(shape));
    held->spine = toolbox::spine_of(shape);
    held->shaft_height_m = toolbox::shaft_height_m(shape);
    held->shape = std::move(shape);
    return held;
}

Quat pen_at_rest() {
    const Vec3 shaft = glm::normalize(Vec3(0.45, 0.8, 1.0)), across = glm::normalize(Vec3(1.0, 0.0, -0.45));
    return glm::normalize(glm::quat_cast(glm::dmat3(across, shaft, glm::cross(across, shaft))));
}

}  // namespace burin::session
