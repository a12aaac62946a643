// SPDX-License-Identifier: MIT
// Draws scenes into PNG files of one folder, on a Vulkan device of its own, and prints what it has written.
// One thread. Ownership: of the device and the renderer.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/image.hpp"
#include "gpu/device.hpp"
#include "renderer/frame/renderer.hpp"

namespace burin::app {

class PictureFolder {
public:
    // Makes the folder and opens the device. `option` named the folder, for messages.
    [[nodiscard]] static Result<PictureFolder> create(const std::string& folder, const std::string& option);
    // Makes it where a folder is named; returns nothing for an empty name.
    [[nodiscard]] static Result<std::optional<PictureFolder>> create_if_named(const std::string& folder,
                                                                              const std::string& option);

    // Writes one picture, as seen from the middle between the eyes.
    [[nodiscard]] Result<void> take(const picture::Picture& scene, const std::string& name);
    // Writes one as both eyes see it, side by side.
    [[nodiscard]] Result<void> take_both_eyes(const picture::Picture& scene, const std::string& name);

private:
    PictureFolder(std::string folder, gpu::Device device, renderer::Renderer renderer)
        : folder_(std::move(folder)), device_(std::move(device)), renderer_(std::move(renderer)) {}

    [[nodiscard]] Result<void> write(const std::string& name, const Image& image) const;

    std::string folder_;
    gpu::Device device_;
    renderer::Renderer renderer_;
};

}  // namespace burin::app
