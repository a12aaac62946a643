// SPDX-License-Identifier: MIT
#include "geometry/files/named_file.hpp"

#include <string>
#include <system_error>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

namespace fs = std::filesystem;

std::string lowered(const fs::path& name) {
    std::string text = name.string();
    for (char& c : text) c = lower(c);
    return text;
}

// Returns the entry of a folder that differs from the name in capitals alone; empty where there is none.
fs::path entry_like(const fs::path& folder, const fs::path& name) {
    const std::string wanted = lowered(name);
    fs::path found;
    std::error_code code;
    for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, code), end; !code && at != end;
         at.increment(code)) {
        const fs::path entry = at->path().filename();
        if (lowered(entry) == wanted && (found.empty() || entry < found)) found = entry;
    }
    return found;
}

}  // namespace

fs::path file_named(const fs::path& folder, const fs::path& name) {
    const fs::path written = folder / name;
    std::error_code code;
    if (name.empty() || fs::exists(written, code)) return written;
    fs::path path = name.is_absolute() ? name.root_path() : folder;
    for (const fs::path& part : name.relative_path()) {
        const fs::path as_written = path / part;
        if (part.empty() || part == "." || part == ".." || fs::exists(as_written, code)) {
            path = as_written;
            continue;
        }
        const fs::path like = entry_like(path, part);
        if (like.empty()) return written;
        path /= like;
    }
    return path;
}

}  // namespace burin::geometry
