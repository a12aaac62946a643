// SPDX-License-Identifier: MIT
// Rules on the text of single files. Each returns an empty string, or the complaint without the file's name.
// Pure functions; any thread.
#pragma once

#include <string>

namespace burin::house {

// No path of somebody's machine: home folders, the folder somebody happened to clone into.
[[nodiscard]] std::string complaint_on_paths(const std::string& text);

// A source says its licence in the first line, or in the second when the first has to be something else (#version, #!).
[[nodiscard]] std::string complaint_on_licence(const std::string& text);

// A source of more than kMostLines lines is asking to be split along its own seams.
inline constexpr int kMostLines = 500;
[[nodiscard]] std::string complaint_on_length(const std::string& text);

// A header says #pragma once before all else, so that it can be included twice.
[[nodiscard]] std::string complaint_on_guard(const std::string& text);

// A source with a header of its own includes it before all else: so every build proves that the header compiles alone.
[[nodiscard]] std::string complaint_on_first_include(const std::string& text, const std::string& own_header);

// No tabs, no blanks at line ends, a newline at the end, no merge markers, no carriage returns.
[[nodiscard]] std::string complaint_on_whitespace(const std::string& text);

}  // namespace burin::house
