// SPDX-License-Identifier: MIT
#include "base/flush_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace burin {

void flush_folder_of(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    static_cast<void>(::fsync(fd));
    ::close(fd);
}

}  // namespace burin
