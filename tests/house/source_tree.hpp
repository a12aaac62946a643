// SPDX-License-Identifier: MIT
// The files of a source tree, as the house tests see them. Paths are relative to the root, with '/'. Pure reading.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace burin::house {

// Every regular file below root, sorted; build and out folders at the top and hidden folders other than .ci left aside.
[[nodiscard]] std::vector<std::string> all_files(const std::filesystem::path& root);

// What git tracks or would track; all files where git is missing or there is no repository (a source archive).
[[nodiscard]] std::vector<std::string> repository_files(const std::filesystem::path& root);

// Those of all_files() that are C++ or GLSL.
[[nodiscard]] std::vector<std::string> source_files(const std::filesystem::path& root);
[[nodiscard]] bool is_source(const std::string& path);

// Empty when the file cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

// The same text with comments blanked and line breaks kept; string literals are left as they are.
[[nodiscard]] std::string without_comments(const std::string& source);

// Writes a file and the folders above it; for the trees that the self-tests make up.
void write_text(const std::filesystem::path& path, const std::string& text);

// A fresh empty folder, removed with its content at the end.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace burin::house
