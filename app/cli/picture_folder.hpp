// SPDX-License-Identifier: MIT
// Draws scenes into PNG files of one folder, on a Vulkan device of its own, and prints what it has written.
// One thread. Ownership: of the device and the renderer.
#pragma once

#include <string>

#include "base/error.hpp"
#include "gpu/device.hpp"
#include "renderer/frame/renderer.hpp"

namespace burin::app {

class PictureFolder {
public:
    // Makes the folder and opens the device. `option` named the folder, for messages.
    [[nodiscard]] static Result<PictureFolder> create(const std::string& folder, const std::string& option);

    // Writes one picture, as seen from the middle between the eyes.
    [[nodiscard]] Result<void> take(const picture::Picture& scene, const std::string& name);

private:
    PictureFolder(std::string folder, gpu::Device device, renderer::Renderer renderer)
        : folder_(std::move(folder)), device_(std::move(device)), renderer_(std::move(renderer)) {}

    std::string folder_;
    gpu::Device device_;
    renderer::Renderer renderer_;
};

}  // namespace burin::app
