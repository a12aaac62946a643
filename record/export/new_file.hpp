// SPDX-License-Identifier: MIT
// A file that is written piece by piece and appears under its name only when all of it is on the disk.
// One thread. A failure, or an end without finish(), leaves the name as it was and no temporary file.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::record {

// Fails where something has the name already: what was converted before is never written over. Nothing to check for
// standard output.
[[nodiscard]] Result<void> check_no_file(const std::string& path);

class NewFile {
public:
    // path "-": standard output, which nothing can take back.
    [[nodiscard]] static Result<NewFile> create(const std::string& path);
    ~NewFile();
    NewFile(NewFile&& other) noexcept;
    NewFile& operator=(NewFile&&) = delete;

    [[nodiscard]] Result<void> write(std::string_view bytes);
    // Writes or replaces bytes anywhere; what is left out in between reads as zero. Not on standard output.
    [[nodiscard]] Result<void> write_at(std::size_t offset, std::string_view bytes);
    [[nodiscard]] bool is_standard_output() const { return temporary_.empty(); }
    // Returns the name under which the file is until its end, for a library that writes it by itself.
    [[nodiscard]] const std::string& temporary() const { return temporary_; }
    [[nodiscard]] Result<void> finish();

private:
    NewFile() = default;
    [[nodiscard]] Result<void> flush();
    [[nodiscard]] std::unexpected<Error> failed(int code) const;

    std::string path_, temporary_;
    std::string waiting_;  // for a larger write
    int fd_ = -1;
};

}  // namespace burin::record
