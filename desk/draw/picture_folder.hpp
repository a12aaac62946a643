// SPDX-License-Identifier: MIT
// Folders that pictures are written to.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"

namespace burin::session {

// Makes a folder that pictures are to be written to, with those above it, unless it is there. option: what named it.
[[nodiscard]] Result<void> make_picture_folder(const std::filesystem::path& folder, const std::string& option);

}  // namespace burin::session
