// SPDX-License-Identifier: MIT
// The house's figures with their bars, for the tests and for scripts/check --house. Each is computed by the rule that a
// test asserts too. Pure reading; one thread; cost is a few passes over the sources.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace burin::house {

// A file of fewer lines is a fragment. Few of a folder's files may be: a concept is one or two files, not six.
inline constexpr std::size_t kFragmentLines = 40;
inline constexpr std::size_t kMostFragments_percent = 15;

struct FolderFragments {
    std::string folder;
    std::size_t files = 0;  // C++ sources and headers, those of the folder's rooms included
    std::vector<std::string> fragments;

    [[nodiscard]] bool within(std::size_t percent) const { return 100 * fragments.size() <= percent * files; }
    [[nodiscard]] double percent() const {
        return files == 0 ? 0.0 : 100.0 * static_cast<double>(fragments.size()) / static_cast<double>(files);
    }
};

// Counts each top folder's C++ files and fragments. tests/ and shaders/ are left aside.
[[nodiscard]] std::vector<FolderFragments> fragments_by_folder(const std::filesystem::path& root);

struct Figure {
    std::string name;
    double value = 0.0;
    double bar = 0.0;                 // the figure must not exceed it
    std::vector<std::string> places;  // where the figure comes from
    std::string remark;
    [[nodiscard]] bool reached() const { return value <= bar; }
};

// Returns double type names, cycles of rooms, long lines, missing document paths, places that a tracker and a haptic
// device touch, and each folder's fragments.
[[nodiscard]] std::vector<Figure> house_figures(const std::filesystem::path& root);

// Returns the figures as a table, with the places of those that miss their bar.
[[nodiscard]] std::string table_of(std::span<const Figure> figures);

}  // namespace burin::house
