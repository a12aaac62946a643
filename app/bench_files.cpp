// SPDX-License-Identifier: MIT
#include "app/bench_files.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <span>

#include "geometry/file_io.hpp"

namespace burin {

namespace fs = std::filesystem;

Result<void> check_place(const std::string& path) {
    if (path.empty() || path == kStandardOutput) return {};
    const fs::path folder = fs::absolute(path).parent_path();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored) || access(folder.c_str(), W_OK) != 0) {
        return fail(path, "cannot be written: there is no folder " + folder.string() + " that can be written to",
                    "make the folder, or choose another place");
    }
    if (fs::is_directory(path, ignored)) return fail(path, "is a folder", "give the name of a file");
    return {};
}

Result<void> write_output(const std::string& path, const std::string& text) {
    if (path.empty()) return {};
    if (path == kStandardOutput) {
        std::fputs(text.c_str(), stdout);
        return {};
    }
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace burin
