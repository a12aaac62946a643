// SPDX-License-Identifier: MIT
#include "base/places.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <system_error>

namespace burin {
namespace {

namespace fs = std::filesystem;

template <typename Iterator>
Result<std::vector<fs::path>> entries(const fs::path& folder) {
    BURIN_TRY_DO(check_working_folder(folder));
    std::error_code error;
    std::vector<fs::path> found;
    for (Iterator at(folder, error), end; !error && at != end; at.increment(error)) found.push_back(at->path());
    if (error) return fail(folder.string(), "cannot be read: " + error.message(), "check the path and its permissions");
    std::ranges::sort(found);
    return found;
}

}  // namespace

bool working_folder_is_gone() {
    std::error_code error;
    return fs::current_path(error).empty();
}

Result<void> check_working_folder(const fs::path& path) {
    if (path.is_absolute() || !working_folder_is_gone()) return {};
    return fail(path.string(), "has no place: the working folder has been deleted",
                "change to a folder that exists (cd), or give a path that begins with /");
}

fs::path absolute_path(const fs::path& path) {
    std::error_code error;
    fs::path absolute = fs::absolute(path, error);
    return error ? path : absolute;
}

std::optional<fs::path> resolved_path(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    if (error) return std::nullopt;
    fs::path resolved = fs::weakly_canonical(absolute, error);
    return error ? std::nullopt : std::optional(std::move(resolved));
}

Result<std::vector<fs::path>> entries_of(const fs::path& folder) { return entries<fs::directory_iterator>(folder); }

Result<std::vector<fs::path>> entries_below(const fs::path& folder) {
    return entries<fs::recursive_directory_iterator>(folder);
}

}  // namespace burin
