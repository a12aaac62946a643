// SPDX-License-Identifier: MIT
// Where the emulated libraries of devices' makers are: beside the program, in the folder above it (of tests), or in
// PREFIX/lib/burin/emulators of a program that is installed as PREFIX/bin/burin.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/try.hpp"

namespace burin::devices {

// Returns the path of a library there; its name alone where it is in none of these places.
[[nodiscard]] inline std::string library_beside(const char* name) {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const std::filesystem::path& at : {folder, folder.parent_path(), folder.parent_path() / "lib/burin/emulators"})
        if (std::filesystem::exists(at / name, ignored)) return (at / name).string();
    return name;
}

// Refuses an @ with nothing behind it in what follows a device's name.
[[nodiscard]] inline Result<void> check_library_named(const std::string& where, const std::string& text) {
    const std::size_t at = text.find('@');
    if (at == std::string::npos || at + 1 < text.size()) return {};
    return fail(where, "names no library behind @", "write the library's file there, or leave the @ out");
}

// Returns which library a device is opened by: the one that is named behind an @, an emulated device's, which has to be
// beside the program, or the maker's usual one. `address` is what stands before the @ and `library` what stands behind
// it, which must not be empty where one is named. `where` names the device in an Error.
[[nodiscard]] inline Result<std::string> library_chosen(const std::string& where, bool is_named,
                                                        const std::string& library, const std::string& address,
                                                        const char* emulated, const std::string& usual) {
    BURIN_TRY_DO(check_library_named(where, is_named ? "@" + library : ""));
    if (is_named) return library;
    if (!address.starts_with("emulated")) return usual;
    std::string beside = library_beside(emulated);
    if (beside == emulated)
        return fail(where, "the emulated library " + beside + " is not beside the program",
                    "build it too, and keep it in the program's folder, the one above or its lib/burin/emulators: no "
                    "maker's library "
                    "is needed");
    return beside;
}

}  // namespace burin::devices
