// SPDX-License-Identifier: MIT
// Finds a file by the name that another file has for it. Programs of systems that do not tell capitals apart write
// names as they like: where no file has exactly the name, one counts that differs in capitals alone. Threads: any.
// Cost: a look at each folder of the name; the list of a folder where a part of the name is not there.
#pragma once

#include <filesystem>

namespace burin::geometry {

// Returns the path of the file, below the folder where the name is relative; the path as it is written where there is
// none. Of several that differ in capitals the first in the order of bytes counts.
[[nodiscard]] std::filesystem::path file_named(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace burin::geometry
