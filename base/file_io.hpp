// SPDX-License-Identifier: MIT
// Reads and writes whole files, for import, export and everything else that must not damage a user's file.
//
// Threads: any; nothing shared. Failure: an Error that names the path and the remedy. Cost: the file's size in memory
// and one write with fsync (milliseconds on a disk). Never called from the haptic thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/error.hpp"

namespace burin {

inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{2} << 30;  // enough for 40 million binary STL triangles

// Reads the bytes of a regular file. Refuses folders, pipes and devices (they could block for ever) and files above
// max_bytes.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::filesystem::path& path,
                                                       std::uint64_t max_bytes = kMaxFileBytes);

// Writes the bytes under a temporary name in the target's folder, flushes them to the disk and then renames, so that
// the target holds either its old content or all of the new, whatever happens. A symbolic link is followed; an existing
// target keeps its permissions; a target that is not a regular file, or not writable, is refused. A failure leaves no
// temporary file behind.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Checks, as far as that shows beforehand, whether write_file_atomically() can write there: that nothing but a writable
// file has the name, and that there is a folder in which files can be made. Writes nothing.
[[nodiscard]] Result<void> check_writable(const std::filesystem::path& path);

}  // namespace burin
