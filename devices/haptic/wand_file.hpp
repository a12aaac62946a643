// SPDX-License-Identifier: MIT
// Reads the description of a wand (TOML; docs/devices.md has the keys): its workspace, frames, limits, points, jig and
// arm. What a file leaves out is the Quanser wand's. All problems are listed at once, each with line and remedy; only a
// file without a problem gives a description.
// Units: the file's angles are in degrees, all else in SI. Threads: any; nothing shared.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"

namespace burin::devices {

using WandOrProblems = std::expected<WandDescription, std::vector<Error>>;

// Reads the text of a description. `name` stands for the file in messages.
// `otherwise` is the wand of whatever the text leaves out.
[[nodiscard]] WandOrProblems parse_wand(std::string_view text, const std::string& name,
                                        const WandDescription& otherwise = {});

// Reads a file. Fails with one Error that lists all problems, one a line where there are several.
[[nodiscard]] Result<WandDescription> read_wand(const std::filesystem::path& path,
                                                const WandDescription& otherwise = {});

}  // namespace burin::devices
