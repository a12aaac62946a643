// SPDX-License-Identifier: MIT
#include "desk/draw/picture_folder.hpp"

#include <system_error>

namespace burin::session {

Result<void> make_picture_folder(const std::filesystem::path& folder, const std::string& option) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::error_code ignored;
    if (std::filesystem::is_directory(folder, ignored)) return {};
    return fail(folder.string(), "cannot be made as a folder for pictures (" + error.message() + ")",
                "choose another " + option + " folder");
}

}  // namespace burin::session
