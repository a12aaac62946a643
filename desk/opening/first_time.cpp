// SPDX-License-Identifier: MIT
#include "desk/opening/first_time.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace burin::session {
namespace {

// Returns the folder for settings; empty: there is none. A relative path does not count (XDG Base Directory 0.8).
std::filesystem::path settings_folder() {
    const auto folder_named = [](const char* variable) -> std::filesystem::path {
        const char* const value = std::getenv(variable);
        return value != nullptr && std::string_view(value).starts_with('/') ? value : "";
    };
    if (const auto own = folder_named("XDG_CONFIG_HOME"); !own.empty()) return own;
    const auto home = folder_named("HOME");
    return home.empty() ? home : home / ".config";
}

std::filesystem::path note_of_first_time() {
    const std::filesystem::path folder = settings_folder();
    return folder.empty() ? folder : folder / "burin" / "first-steps-seen";
}

}  // namespace

bool is_first_time() {
    std::error_code ignored;
    const std::filesystem::path seen = note_of_first_time();
    return seen.empty() || !std::filesystem::exists(seen, ignored);
}

void remember_first_time() {
    const std::filesystem::path seen = note_of_first_time();
    if (seen.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(seen.parent_path(), ignored);
    std::ofstream(seen, std::ios::app).flush();  // empty
}

}  // namespace burin::session
