// SPDX-License-Identifier: MIT
// Pictures of a study's stages: for each group and each stage with a world, what the first participant who went through
// it saw in the middle of it, from the recorded motion; and the pages that all have read. Whoever wants them draws
// them. One thread; reads the recordings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"
#include "picture/picture.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::activities {

inline constexpr ImageSize kStagePicture{1280, 800};

// A page as its reader sees it, as SVG.
struct PagePicture {
    std::string file, svg;
};
[[nodiscard]] std::vector<PagePicture> page_pictures(const study::Protocol& protocol);

// Takes a picture and its file's name.
using StageDrawer = std::function<Result<void>(const picture::Picture&, const std::string& file)>;
// Gives the pictures one after the other, by group and in the protocol's order. Stages that nobody went through, or
// whose motion is not recorded, are left out. Ends with the drawer's first failure.
[[nodiscard]] Result<void> draw_stages(const study::StudyFolder& study, const StageDrawer& draw);

}  // namespace burin::activities
