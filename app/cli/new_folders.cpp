// SPDX-License-Identifier: MIT
#include "app/cli/new_folders.hpp"

#include <system_error>

#include "base/error.hpp"
#include "base/places.hpp"

namespace burin::app {
namespace fs = std::filesystem;
namespace {

// Removes the folders below one that hold no file, and itself where it then holds nothing; follows no links.
void remove_hollow(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::is_directory(fs::symlink_status(folder, ignored))) return;
    for (const fs::path& entry : entries_of(folder).value_or(std::vector<fs::path>())) remove_hollow(entry);
    // Fails for a folder that holds something, which has to stay.
    fs::remove(folder, ignored);
}

// Adds what is not there yet on the way to a folder, the uppermost first.
void add_new_on_way(const fs::path& folder, std::vector<fs::path>& found) {
    std::error_code failed;
    for (fs::path at = fs::absolute(folder, failed).lexically_normal();
         !failed && !at.empty() && !fs::exists(at, failed); at = at.parent_path()) {
        if (at.has_filename()) found.push_back(at);
        if (at == at.parent_path()) return;
    }
}

}  // namespace

NewFolders::NewFolders(const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders)
        if (!folder.empty()) add_new_on_way(folder, new_);
}

NewFolders::~NewFolders() {
    for (const fs::path& folder : new_) remove_hollow(folder);
}

}  // namespace burin::app
