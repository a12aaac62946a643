// SPDX-License-Identifier: MIT
// Reads and writes whole files, for import, export and everything else that must not damage a user's file; and tells
// which bytes are text that this program reads. Every text file goes through read_text_file or utf8_text.
//
// Threads: any; nothing shared. Failure: an Error that names the path and the remedy. Cost: the file's size in memory
// and one write with fsync (milliseconds on a disk). Never called from the haptic thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace burin {

inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{2} << 30;  // enough for 40 million binary STL triangles

// Reads the bytes of a regular file. Refuses folders, pipes and devices (they could block for ever) and files above
// max_bytes.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::filesystem::path& path,
                                                       std::uint64_t max_bytes = kMaxFileBytes);

// Returns text without a UTF-8 byte-order mark at its start, which some editors write and no format here knows.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

// Returns the text that a file's bytes hold, without a byte-order mark. Refuses UTF-16 and UTF-32, which begin with
// another mark or have zero bytes between their first letters. `name` stands for the file in the message. The first
// bytes of a binary file may look like anything: ask only where text is expected.
[[nodiscard]] Result<std::string_view> utf8_text(std::string_view bytes, const std::string& name);

// Reads a text file: what utf8_text() leaves of it, with every line end (LF, CR LF or CR) as LF.
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path,
                                                 std::uint64_t max_bytes = kMaxFileBytes);

// Returns the SHA-256 of a file's bytes, as sha256sum prints it.
[[nodiscard]] Result<std::string> file_digest(const std::filesystem::path& path);

// Writes the bytes under a temporary name in the target's folder, flushes them to the disk and then renames, so that
// the target holds either its old content or all of the new, whatever happens. A symbolic link is followed; an existing
// target keeps its permissions; a target that is not a regular file, or not writable, is refused. A failure leaves no
// temporary file behind.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Checks, as far as that shows beforehand, whether write_file_atomically() can write there: that nothing but a writable
// file has the name, and that there is a folder in which files can be made. Writes nothing.
[[nodiscard]] Result<void> check_writable(const std::filesystem::path& path);

}  // namespace burin
