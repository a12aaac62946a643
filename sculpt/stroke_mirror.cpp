// SPDX-License-Identifier: MIT
#include "sculpt/stroke_mirror.hpp"

#include <utility>

#include "base/try.hpp"

namespace burin::sculpt {
namespace {

std::shared_ptr<const geometry::TriangleMesh> reflected_mesh(const geometry::TriangleMesh& mesh) {
    auto image = std::make_shared<geometry::TriangleMesh>(mesh);
    for (auto& vertex : image->positions_m) vertex.x = -vertex.x;
    for (auto& triangle : image->triangles) std::swap(triangle[1], triangle[2]);
    return image;
}

}  // namespace

Result<compute::ToolShape> StrokeMirror::reflected(const compute::ToolShape& shape) {
    const auto* tool = std::get_if<compute::MeshTool>(&shape);
    if (tool == nullptr) return shape;
    if (mesh_ != tool->mesh) {
        BURIN_TRY(image, compute::prepare_mesh_tool(reflected_mesh(*tool->mesh)));
        mesh_ = tool->mesh;
        image_ = std::move(image);
    }
    return image_;
}

Result<std::vector<compute::ToolSweep>> StrokeMirror::with_images(std::span<const compute::ToolSweep> sweeps) {
    const std::vector<toolbox::MirrorImage> images = toolbox::images_of(mirror_);
    std::vector<compute::ToolSweep> all;
    all.reserve(sweeps.size() * (1 + images.size()));
    for (const compute::ToolSweep& sweep : sweeps) {
        all.push_back(sweep);
        const bool turns = !std::holds_alternative<compute::BallTool>(sweep.shape);
        for (const toolbox::MirrorImage& image : images) {
            compute::ToolSweep other = sweep;
            if (turns && image.reverses()) {
                BURIN_TRY(shape, reflected(sweep.shape));
                other.shape = std::move(shape);
            }
            for (Pose* pose : {&other.start, &other.end}) {
                const Pose moved = toolbox::image_of(*pose, image, middle_object_);
                pose->position_m = moved.position_m;
                if (turns) pose->orientation = moved.orientation;
            }
            all.push_back(std::move(other));
        }
    }
    return all;
}

}  // namespace burin::sculpt
