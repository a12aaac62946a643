// SPDX-License-Identifier: MIT
// Where the emulated libraries of devices' makers are: beside the program, or in the folder above it.
#pragma once

#include <filesystem>
#include <string>

namespace burin::devices {

// Returns the path of a library there; its name alone where it is in neither place.
[[nodiscard]] inline std::string library_beside(const char* name) {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const std::filesystem::path& at : {folder, folder.parent_path()})
        if (std::filesystem::exists(at / name, ignored)) return (at / name).string();
    return name;
}

}  // namespace burin::devices
