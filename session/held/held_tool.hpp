// SPDX-License-Identifier: MIT
// The tool in the hand of a session, made ready once when it is taken up: its shape, what the hand feels of it, how it
// is drawn. A step of the session makes it and reads no file: meshes are read before the session begins (ToolMeshes).
// Frame: tool, metres. Immutable and shared; any thread.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_kinds.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::picture {
struct DrawnMesh;  // picture/drawn_mesh.hpp
}  // namespace burin::picture

namespace burin::session {

// The shapes of tools whose meshes have been read.
class ToolMeshes {
public:
    // Reads the file of a tool that is a mesh, unless it has been read; does nothing for other tools.
    [[nodiscard]] Result<void> read(const toolbox::ToolSpec& tool);
    // Returns the shape of a tool. Fails for a mesh that has not been read.
    [[nodiscard]] Result<compute::ToolShape> shape_of(const toolbox::ToolSpec& tool) const;

private:
    std::vector<std::pair<toolbox::ToolSpec, compute::ToolShape>> read_;
};

struct HeldTool {
    toolbox::ToolSpec spec;
    compute::ToolShape shape;
    toolbox::FeltTool felt;
    std::shared_ptr<const picture::DrawnMesh> drawn;  // null: a ball
    toolbox::Spine spine;
    double shaft_height_m = 0.0;

    // Half of the tool's least width; a ball's radius.
    [[nodiscard]] double half_width_m() const { return toolbox::size_of(shape); }
};

// Makes a tool ready. Takes some milliseconds for one that is no ball.
[[nodiscard]] Result<std::shared_ptr<const HeldTool>> take_up(const toolbox::ToolSpec& tool, const ToolMeshes& meshes);
[[nodiscard]] std::shared_ptr<const HeldTool> take_up(const toolbox::ToolSpec& tool, compute::ToolShape shape);

}  // namespace burin::session
