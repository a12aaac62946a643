// SPDX-License-Identifier: MIT
#include "app/cli/picture_folder.hpp"

#include <cstdio>
#include <filesystem>

#include "desk/draw/pictures.hpp"
#include "picture/png.hpp"

namespace burin::app {
namespace {

constexpr ImageSize kFolderPictureSize{1280, 960};

}  // namespace

Result<PictureFolder> PictureFolder::create(const std::string& folder, const std::string& option) {
    if (const auto made = session::make_picture_folder(folder, option); !made) return std::unexpected(made.error());
    Result<gpu::Device> device = gpu::Device::create();
    if (!device) {
        Error e = device.error();
        e.what += ", and " + option + " needs one";
        return std::unexpected(e);
    }
    Result<renderer::Renderer> renderer = renderer::Renderer::create(*device, kFolderPictureSize);
    if (!renderer) return std::unexpected(renderer.error());
    return PictureFolder(folder, std::move(*device), std::move(*renderer));
}

Result<void> PictureFolder::take(const picture::Picture& scene, const std::string& name) {
    const auto image = renderer_.render(scene);
    if (!image) return std::unexpected(image.error());
    const std::filesystem::path path = std::filesystem::path(folder_) / name;
    if (const auto written = picture::write_png(path, image->left); !written) return written;
    std::printf("wrote %s\n", path.string().c_str());
    return {};
}

}  // namespace burin::app
