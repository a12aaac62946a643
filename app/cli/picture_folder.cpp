// SPDX-License-Identifier: MIT
#include "app/cli/picture_folder.hpp"

#include <cstdio>
#include <filesystem>

#include "base/try.hpp"
#include "desk/draw/picture_folder.hpp"
#include "picture/png.hpp"

namespace burin::app {
namespace {

constexpr ImageSize kFolderPictureSize{1280, 960};

}  // namespace

Result<PictureFolder> PictureFolder::create(const std::string& folder, const std::string& option) {
    BURIN_TRY_DO(session::make_picture_folder(folder, option));
    Result<gpu::Device> device = gpu::Device::create();
    if (!device) {
        Error e = device.error();
        e.what += ", and " + option + " needs one";
        return std::unexpected(e);
    }
    BURIN_TRY(renderer, renderer::Renderer::create(*device, kFolderPictureSize));
    return PictureFolder(folder, std::move(*device), std::move(renderer));
}

Result<std::optional<PictureFolder>> PictureFolder::create_if_named(const std::string& folder,
                                                                    const std::string& option) {
    if (folder.empty()) return std::nullopt;
    return create(folder, option);
}

Result<void> PictureFolder::take(const picture::Picture& scene, const std::string& name) {
    BURIN_TRY(image, renderer_.render(scene));
    return write(name, image.left);
}

Result<void> PictureFolder::take_both_eyes(const picture::Picture& scene, const std::string& name) {
    BURIN_TRY(image, renderer_.render(scene));
    return write(name, side_by_side(image));
}

Result<void> PictureFolder::write(const std::string& name, const Image& image) const {
    const std::filesystem::path path = std::filesystem::path(folder_) / name;
    BURIN_TRY_DO(picture::write_png(path, image));
    std::printf("wrote %s\n", path.string().c_str());
    return {};
}

}  // namespace burin::app
