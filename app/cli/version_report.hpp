// SPDX-License-Identifier: MIT
// burin --version: what this program is and works with, for a report of a fault. One thread.
#pragma once

#include <string>

namespace burin::app {

// Returns the version of this very build: the release, and behind it of which commit it is (cmake/BurinVersion.cmake).
[[nodiscard]] std::string version_text();

// Prints version, assets, engines, Vulkan devices, drivers and libraries.
void print_version();

}  // namespace burin::app
