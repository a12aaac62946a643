// SPDX-License-Identifier: MIT
// The pictures of a session: the workpiece close by before and after, and both eyes' views of the wall.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "app/carving.hpp"
#include "app/staging.hpp"
#include "renderer/renderer.hpp"

namespace burin {

class Pictures {
public:
    // Opens the Vulkan device and makes sure that the folder can be written. The workpiece is `bounds_object`.
    [[nodiscard]] static Result<Pictures> create(const std::filesystem::path& folder, const Box& bounds_object);

    // before.png: the workpiece alone, seen from nearby.
    [[nodiscard]] Result<void> take_before(Carving& carving);
    // after.png likewise; left.png, right.png and stereo.png (left | right): the wall as the tracked viewer sees it.
    [[nodiscard]] Result<void> take_after(Carving& carving, const Staging& staging);
    // What the middle between the eyes sees of the wall: for books, where one picture has to do.
    [[nodiscard]] Result<Image> view_of_wall(Carving& carving, const Staging& staging);

    [[nodiscard]] const std::string& device_name() const { return device_name_; }
    [[nodiscard]] double scene_scale() const { return world_from_object_.scale; }

private:
    Pictures(std::filesystem::path folder, gpu::Device device, Renderer renderer, const Box& bounds_object);
    [[nodiscard]] Result<void> bring_up_to_date(Carving& carving);
    [[nodiscard]] Scene wall_scene(const Carving& carving) const;
    [[nodiscard]] Scene close_scene(const Carving& carving) const;

    std::filesystem::path folder_;
    gpu::Device device_;
    Renderer renderer_;
    std::string device_name_;
    Similarity world_from_object_;
    Vec3 center_world_{0.0};
    double bottom_world_m_ = 0.0;  // the workpiece's lowest point
    double radius_world_m_ = 0.0;  // of a ball around the workpiece
};

}  // namespace burin
