// SPDX-License-Identifier: MIT
// Carves the other sides of planes as well (toolbox/mirror.hpp). Tools of closed form are their own mirror images; of a
// mesh, an image of its own is made. Frame: object. One thread.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "compute/tools/mesh_tool.hpp"
#include "compute/tools/tool.hpp"
#include "toolbox/mirror.hpp"

namespace burin::sculpt {

// Adds the images to sweeps. Keeps the image of the last mesh that was a tool, which takes long to make.
class StrokeMirror {
public:
    explicit StrokeMirror(const Vec3& middle_object) : middle_object_(middle_object) {}

    void set(const toolbox::Mirror& mirror) { mirror_ = mirror; }
    [[nodiscard]] const toolbox::Mirror& mirror() const { return mirror_; }
    // Returns each sweep, with its images behind it. Fails where a mesh is no tool (compute/tools/mesh_tool.hpp).
    [[nodiscard]] Result<std::vector<compute::ToolSweep>> with_images(std::span<const compute::ToolSweep> sweeps);

private:
    [[nodiscard]] Result<compute::ToolShape> reflected(const compute::ToolShape& shape);

    Vec3 middle_object_;
    toolbox::Mirror mirror_;
    std::shared_ptr<const geometry::TriangleMesh> mesh_;  // whose image this is
    compute::MeshTool image_;
};

}  // namespace burin::sculpt
