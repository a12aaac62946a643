// SPDX-License-Identifier: MIT
// Which versions of its libraries a program runs with: asked of the libraries themselves, since a machine may have
// others than the one that it was built on. Those that are compiled in, or do not tell, are left out. Any thread.
#pragma once

#include <string>
#include <vector>

namespace burin::app {

struct LibraryVersion {
    std::string name, version;  // "SQLite", "3.40.1"
};

[[nodiscard]] std::vector<LibraryVersion> library_versions();

}  // namespace burin::app
