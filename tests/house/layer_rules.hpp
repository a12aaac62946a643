// SPDX-License-Identifier: MIT
// The layer rule, read from what CMake declares and compared with the #include lines of a source tree.
//
// Rules file, one line each, '#' starts a comment:
//   folder NAME: folder...      NAME is a folder with a layer rule, and may include these (and itself)
//   forbid NAME: prefix...      no file of NAME, nor a header of the tree it reaches, includes a header so named
// A generated shader header (shaders/X.spv.hpp) may be included by the folders that may include gpu.
// Pure reading; one thread; cost is one pass over the sources.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace burin::house {

struct LayerRules {
    std::map<std::string, std::vector<std::string>> may_include;  // by folder
    std::map<std::string, std::vector<std::string>> forbidden;    // by folder; prefixes of header names
};

// Fails with the line that it cannot read.
[[nodiscard]] Result<LayerRules> parse_layer_rules(const std::string& text);

struct Include {
    std::string name;  // what stands between the quotes or angle brackets
    int line = 0;
    bool quoted = false;
};

// Every #include of a text, commented-out ones left aside.
[[nodiscard]] std::vector<Include> includes_of(const std::string& source);

// One line for each violation ("haptics/tick.cpp:7: haptics may not include gpu (gpu/device.hpp)"), sorted.
[[nodiscard]] std::vector<std::string> layer_violations(const std::filesystem::path& root, const LayerRules& rules);

// How many source files of the ruled folders layer_violations reads; a test that reads none proves nothing.
[[nodiscard]] std::size_t ruled_files(const std::filesystem::path& root, const LayerRules& rules);

}  // namespace burin::house
