// SPDX-License-Identifier: MIT
// What stands in the way of who may read a study's folder and not write it, or not even read it.
#pragma once

#include <filesystem>

#include "base/error.hpp"

namespace burin::study {

// Returns why a folder cannot be opened as a study. reason: the errno of what was tried; to_write: to write it.
[[nodiscard]] Error no_study(const std::filesystem::path& folder, int reason, bool to_write);
// Checks that this process may write a file of a study, or make files in a folder of it, that is there. What is not
// there passes.
[[nodiscard]] Result<void> check_may_write(const std::filesystem::path& place);
// Checks likewise what analysis and report write: unlike a participant's trials, that may be written in a copy.
[[nodiscard]] Result<void> check_may_write_results(const std::filesystem::path& place);

}  // namespace burin::study
