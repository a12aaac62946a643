// SPDX-License-Identifier: MIT
// The settings that belong to a world in VRML: NAME.toml beside NAME.wrl. A table [[object]] with the name that the
// world gives an object changes how it is seen, felt, placed and moved; it has the keys of a world in TOML but for the
// mesh (docs/formats.md). So a world that somebody else has drawn gets its feel without a change to its file. Poses and
// scale are relative to where the world has the object: its mesh stands there already. Failure: all problems at once,
// each with line and remedy; a name that the world does not have, with its nearest. Threads: any; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/world_file.hpp"

namespace burin::scene {

// Returns where the settings of a world lie, whether there are some or not.
[[nodiscard]] std::filesystem::path settings_of(const std::filesystem::path& world);
// Returns whether there are some; a link that leads nowhere counts, so that they are not left out without a word.
[[nodiscard]] bool has_settings(const std::filesystem::path& world);

// Changes a world's objects as a text says. `name` stands for the file in messages. Returns all problems; the world is
// then not to be used.
// Returns the metres in a number of the world that the settings are of; 1 where they leave it open.
[[nodiscard]] Result<double> unit_in_settings(std::string_view text, const std::string& name);
[[nodiscard]] std::vector<Error> apply_settings(World& world, std::string_view text, const std::string& name);

}  // namespace burin::scene
