// SPDX-License-Identifier: MIT
// Pictures of a study's stages (burin study run --pictures): for each group and each stage with a world, what the first
// participant who went through it saw in the middle of it, drawn from the recorded motion.
#pragma once

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

// Writes into the study's folder pictures/, over those of the same names: they follow from the recordings.
[[nodiscard]] Result<void> draw_stages(const study::StudyFolder& study);

}  // namespace burin::app
