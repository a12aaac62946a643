// SPDX-License-Identifier: MIT
// Asks the file system about paths without a throw, whatever has become of a folder. Of the standard library's
// functions those throw that take no error code, and so does a loop over a folder that vanishes meanwhile.
//
// A relative path has no place once the working folder has been deleted. Any thread; each answer is true when it is
// given.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.hpp"

namespace burin {

// Tells whether this process stands in a folder that has been deleted, so that no relative path leads anywhere.
[[nodiscard]] bool working_folder_is_gone();

// Says so of a relative path; nothing where the path is absolute or the folder is there.
[[nodiscard]] Result<void> check_working_folder(const std::filesystem::path& path);

// Returns the path from the root on; as it is where it has no place.
[[nodiscard]] std::filesystem::path absolute_path(const std::filesystem::path& path);

// Returns the path from the root on through no link, as far as it exists; nothing where it has no place.
[[nodiscard]] std::optional<std::filesystem::path> resolved_path(const std::filesystem::path& path);

// Return the entries of a folder, sorted by name: of itself, or of all folders below it as well. Entries that vanish
// meanwhile are left out.
[[nodiscard]] Result<std::vector<std::filesystem::path>> entries_of(const std::filesystem::path& folder);
[[nodiscard]] Result<std::vector<std::filesystem::path>> entries_below(const std::filesystem::path& folder);

}  // namespace burin
