// SPDX-License-Identifier: MIT
// Draws the pictures of a stroke that is carved without a person: close-ups of the workpiece before and
// after, and both eyes' views of the wall.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"
#include "base/space.hpp"
#include "gpu/device.hpp"
#include "renderer/frame/renderer.hpp"
#include "session/held/staging.hpp"

namespace burin::compute {
struct TileLight;  // compute/light/tile_light.hpp
struct TileMesh;   // compute/mesher/tile_mesher.hpp
}  // namespace burin::compute

namespace burin::sculpt {
class Sculpture;  // sculpt/sculpture.hpp
}  // namespace burin::sculpt

namespace burin::activities {

class StrokePictures {
public:
    // Opens the Vulkan device and checks that the folder, which is there, can be written. `bounds_object` are the
    // workpiece's bounds.
    [[nodiscard]] static Result<StrokePictures> create(const std::filesystem::path& folder, const Box& bounds_object);

    // Writes before.png: the workpiece alone, seen from nearby.
    [[nodiscard]] Result<void> take_before(sculpt::Sculpture& carving);
    // Writes after.png, the same view after carving, and left.png, right.png and stereo.png (left | right): the wall as
    // the tracked viewer sees it.
    [[nodiscard]] Result<void> take_after(sculpt::Sculpture& carving, const session::Staging& staging);
    // Returns the wall as seen from the middle between the eyes, for print, where one picture has to do.
    [[nodiscard]] Result<Image> view_of_wall(sculpt::Sculpture& carving, const session::Staging& staging);

    [[nodiscard]] const std::string& device_name() const { return device_name_; }
    // Opens another lane of the device, for who carves.
    [[nodiscard]] Result<gpu::Device> lane() const { return device_.lane(); }
    [[nodiscard]] double scene_scale() const { return world_from_object_.scale; }

private:
    struct ShownTile {
        std::shared_ptr<const compute::TileMesh> mesh;
        std::shared_ptr<const compute::TileLight> light;
    };
    StrokePictures(std::filesystem::path folder, gpu::Device device, renderer::Renderer renderer,
                   const Box& bounds_object);
    [[nodiscard]] Result<void> bring_up_to_date(sculpt::Sculpture& carving);
    void show_tile(const sculpt::Sculpture& carving, std::uint32_t tile);
    [[nodiscard]] picture::Picture wall_scene(const sculpt::Sculpture& carving) const;
    [[nodiscard]] picture::Picture close_scene(const sculpt::Sculpture& carving) const;

    std::filesystem::path folder_;
    gpu::Device device_;
    renderer::Renderer renderer_;
    std::string device_name_;
    std::vector<ShownTile> shown_;
    Similarity world_from_object_;
    Vec3 center_world_{0.0};
    double bottom_world_m_ = 0.0;  // the workpiece's lowest point
    double radius_world_m_ = 0.0;  // of the workpiece's bounding sphere
};

}  // namespace burin::activities
