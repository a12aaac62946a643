// SPDX-License-Identifier: MIT
// Brings a folder's entry of a file to the disk. A file that was made or renamed is there for certain after a power cut
// only when its folder says so. Any thread but the haptic one: it waits for the disk.
#pragma once

#include <filesystem>

namespace burin {

// A file system that cannot flush folders loses only that guarantee.
void flush_folder_of(const std::filesystem::path& file);

}  // namespace burin
