// SPDX-License-Identifier: MIT
// Rules on the text of single files: each complaint_on_... returns an empty string, or the complaint without the file's
// name. Below them, the same rules applied to a whole repository. Pure reading; any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace burin::house {

// No path of somebody's machine: home folders, the folder somebody happened to clone into.
[[nodiscard]] std::string complaint_on_paths(const std::string& text);

// A source says its licence in the first line, or in the second when the first has to be something else (#version, #!).
[[nodiscard]] std::string complaint_on_licence(const std::string& text);

// A source of more than kMostLines lines is asking to be split along its own seams.
inline constexpr int kMostLines = 500;
[[nodiscard]] std::string complaint_on_length(const std::string& text);

// Lines of more than kMostColumns characters (UTF-8), counted from 1.
inline constexpr int kMostColumns = 120;
[[nodiscard]] std::vector<int> lines_too_long(const std::string& text);

// The paths of the repository that a document (Markdown) names, relative to its root:
//   where a link leads to, but for other sites and places in the document itself; `folder` is where the document lies
//   what stands between backticks, or in a block of code, with a slash in it, and either begins with one of
//     `top_folders` or has the ending of a file that the repository may hold
// Left aside are patterns (*), what is built (build/, out/), and options and addresses (with = or : in them).
struct NamedPath {
    std::string path;
    int line = 0;
    bool operator==(const NamedPath&) const = default;
};
[[nodiscard]] std::vector<NamedPath> paths_named_in(const std::string& document, const std::string& folder,
                                                    std::span<const std::string> top_folders);

// A header says #pragma once before all else, so that it can be included twice.
[[nodiscard]] std::string complaint_on_guard(const std::string& text);

// A source with a header of its own includes it before all else: so every build proves that the header compiles alone.
[[nodiscard]] std::string complaint_on_first_include(const std::string& text, const std::string& own_header);

// No tabs, no blanks at line ends, a newline at the end, no merge markers, no carriage returns.
[[nodiscard]] std::string complaint_on_whitespace(const std::string& text);

// ---- A whole repository

struct Findings {
    std::size_t looked_at = 0;        // a test that has looked at nothing proves nothing
    std::vector<std::string> places;  // "compute/a.cpp:12"
};

// Finds the source lines of more than kMostColumns.
[[nodiscard]] Findings long_lines(const std::filesystem::path& root);

// Finds the paths that documents name and that do not exist: "docs/formats.md:12: names wall/gone.hpp".
[[nodiscard]] Findings missing_document_paths(const std::filesystem::path& root);
// Finds the files that comments of sources name and that do not exist. The tests of these rules invent names.
[[nodiscard]] Findings missing_comment_paths(const std::filesystem::path& root);

}  // namespace burin::house
