// SPDX-License-Identifier: MIT
#include "app/study/study_pictures.hpp"

#include <cstdio>
#include <filesystem>

#include "activities/train/stage_pictures.hpp"
#include "app/cli/output_files.hpp"
#include "base/try.hpp"
#include "desk/draw/picture_folder.hpp"
#include "gpu/device.hpp"
#include "picture/png.hpp"
#include "renderer/frame/renderer.hpp"

namespace burin::app {

Result<void> draw_stages(const study::StudyFolder& study) {
    const std::filesystem::path folder = study.path() / "pictures";
    BURIN_TRY_DO(session::make_picture_folder(folder, "--pictures"));
    for (const activities::PagePicture& page : activities::page_pictures(study.protocol())) {
        BURIN_TRY_DO(write_text((folder / page.file).string(), page.svg));
        std::printf("wrote %s\n", (folder / page.file).c_str());
    }
    auto device = gpu::Device::create();
    if (!device) return fail("--pictures", device.error().what, device.error().remedy);
    BURIN_TRY(renderer, renderer::Renderer::create(*device, activities::kStagePicture));
    return activities::draw_stages(study, [&](const picture::Picture& stage, const std::string& file) -> Result<void> {
        BURIN_TRY(image, renderer.render(stage));
        BURIN_TRY_DO(picture::write_png(folder / file, image.left));
        std::printf("wrote %s\n", (folder / file).c_str());
        return {};
    });
}

}  // namespace burin::app
