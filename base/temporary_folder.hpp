// SPDX-License-Identifier: MIT
// A folder of its owner's alone, which goes away with what is in it. Blocks on the disk.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace burin {

class TemporaryFolder {
public:
    static Result<TemporaryFolder> create() {
        std::error_code ignored;
        std::string pattern = (std::filesystem::temp_directory_path(ignored) / "burin-replay-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr)
            return fail(pattern, "cannot be made", "let TMPDIR name a folder that you may write to");
        return TemporaryFolder(pattern);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;
    [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }

private:
    explicit TemporaryFolder(std::string path) : path_(std::move(path)) {}
    std::string path_;
};

}  // namespace burin
