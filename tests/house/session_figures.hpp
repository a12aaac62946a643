// SPDX-License-Identifier: MIT
// Figures of the middle of the house: how far session/ and desk/ are apart, and how much of our own a source reads.
// Bars are what has been reached: they may only fall. Pure reading; one thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/house/house_figures.hpp"

namespace burin::house {

// Returns the data members that a class in this text declares after `private:`, by their trailing underscore.
[[nodiscard]] std::vector<std::string> private_members(const std::string& source, const std::string& type);

[[nodiscard]] std::vector<Figure> session_figures(const std::filesystem::path& root);

}  // namespace burin::house
