// SPDX-License-Identifier: MIT
// The wall file: a WallSetup (renderer/stereo/wall.hpp) as TOML. docs/formats.md describes every key.
//
// Reading refuses what it does not understand: a key it does not know is an error that names the nearest one it does.
// Every error says FILE:LINE and the remedy. It does not judge the geometry; check() does. Any thread; allocates.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "renderer/stereo/wall.hpp"

namespace burin {

[[nodiscard]] Result<WallSetup> parse_wall(std::string_view text, const std::string& name);
[[nodiscard]] Result<WallSetup> read_wall(const std::filesystem::path& path);

// Every setting, defaults included, in the setup's own unit. parse_wall() reads it back to the same setup, lengths to
// within 1e-11 of themselves and a micrometre's thousandth.
[[nodiscard]] std::string wall_text(const WallSetup& setup);

}  // namespace burin
