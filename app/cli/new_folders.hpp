// SPDX-License-Identifier: MIT
// Folders that a command makes before it is known whether its run begins: one that is refused leaves none of them.
#pragma once

#include <filesystem>
#include <vector>

namespace burin::app {

// Remembers which folders are not there yet, and removes those of them, and of the folders in them, that are empty
// when it ends. Empty names are none. Cost: a listing of each new folder.
class NewFolders {
public:
    explicit NewFolders(const std::vector<std::filesystem::path>& folders);
    ~NewFolders();
    NewFolders(const NewFolders&) = delete;
    NewFolders& operator=(const NewFolders&) = delete;

    // Leaves all as it is: the run has begun.
    void keep() { new_.clear(); }

private:
    std::vector<std::filesystem::path> new_;
};

}  // namespace burin::app
