// SPDX-License-Identifier: MIT
#include "base/append_file.hpp"

#include <unistd.h>

#include <cerrno>

namespace burin {

Appended append_whole(int file, std::string_view bytes) {
    Appended appended;
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            appended.error = written < 0 ? errno : ENOSPC;
            return appended;
        }
        appended.has_begun = true;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return appended;
}

}  // namespace burin
