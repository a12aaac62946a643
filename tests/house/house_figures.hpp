// SPDX-License-Identifier: MIT
// The house's figures with their bars, for the tests and for scripts/check --house. Each is computed by the rule that a
// test asserts too. Pure reading; one thread; cost is a few passes over the sources.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace burin::house {

// A file of fewer lines is a fragment. A concept is one or two files, not six. How many a folder has is a figure to
// look at, without a bar, since a narrow header before a deep source is no fault.
inline constexpr std::size_t kFragmentLines = 40;

struct FolderFragments {
    std::string folder;
    std::size_t files = 0;  // C++ sources and headers, those of the folder's rooms included
    std::vector<std::string> fragments;

    [[nodiscard]] double percent() const {
        return files == 0 ? 0.0 : 100.0 * static_cast<double>(fragments.size()) / static_cast<double>(files);
    }
};

// Counts each top folder's C++ files and fragments. tests/ and shaders/ are left aside.
[[nodiscard]] std::vector<FolderFragments> fragments_by_folder(const std::filesystem::path& root);

struct Figure {
    std::string name;
    double value = 0.0;
    std::optional<double> bar = 0.0;  // the figure must not exceed it; none: it is only shown
    std::vector<std::string> places;  // where the figure comes from
    std::string remark;
    [[nodiscard]] bool reached() const { return !bar || value <= *bar; }
};

// Returns double type names, cycles of rooms, long lines, missing document paths, places that a tracker and a haptic
// device touch, and each folder's fragments.
[[nodiscard]] std::vector<Figure> house_figures(const std::filesystem::path& root);

// Returns the figures as a table, with the places of those that miss their bar.
[[nodiscard]] std::string table_of(std::span<const Figure> figures);

}  // namespace burin::house
