// SPDX-License-Identifier: MIT
#include "study/folder/study_access.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace burin::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAskToWrite =
    "have whoever keeps the study give you permission to write to its folder and all files in it";

bool is_refused(int reason) { return reason == EACCES || reason == EPERM || reason == EROFS; }

std::string not_written(int reason) { return "may not be written: " + std::generic_category().message(reason); }

// Returns 0 or why not, as the effective user.
int why_not_written(const fs::path& place) {
    std::error_code ignored;
    const int wanted = fs::is_directory(place, ignored) ? W_OK | X_OK : W_OK;
    const bool may = ::faccessat(AT_FDCWD, place.c_str(), wanted, AT_EACCESS) == 0;
    return may || !is_refused(errno) ? 0 : errno;
}

}  // namespace

Error no_study(const fs::path& folder, int reason, bool to_write) {
    if (!is_refused(reason)) return {"is no study", folder.string(), "make one with burin study init"};
    if (to_write) return {not_written(reason), folder.string(), kAskToWrite};
    return {"may not be read: " + std::generic_category().message(reason), folder.string(),
            "have whoever keeps the study give you permission to read its folder and all files in it"};
}

Result<void> check_may_write(const fs::path& place) {
    const int reason = why_not_written(place);
    if (reason == 0) return {};
    return fail(place.string(), not_written(reason), kAskToWrite);
}

Result<void> check_may_write_results(const fs::path& place) {
    const int reason = why_not_written(place);
    if (reason == 0) return {};
    return fail(place.string(), not_written(reason),
                "copy the study's folder and name the copy, or " + std::string(kAskToWrite));
}

}  // namespace burin::study
