// SPDX-License-Identifier: MIT
// The wall file: a WallSetup (wall/wall.hpp) as TOML. docs/formats.md describes every key.
//
// Reading refuses what it does not understand: an unknown key is an error that names the nearest known one. Every error
// says FILE:LINE and the remedy. The geometry is not checked here but by check(), and the table [tracker] is kept as it
// stands. Any thread; allocates.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "wall/wall.hpp"

namespace burin::wall {

[[nodiscard]] Result<WallSetup> parse_wall(std::string_view text, const std::string& name);
[[nodiscard]] Result<WallSetup> read_wall(const std::filesystem::path& path);

// Writes every setting, defaults included, in the setup's own unit. parse_wall() reads it back to the same setup;
// lengths differ by at most 1e-11 of themselves plus a nanometre.
[[nodiscard]] std::string wall_text(const WallSetup& setup);

}  // namespace burin::wall
