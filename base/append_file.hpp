// SPDX-License-Identifier: MIT
// Appends to an open file, for journals: what was written before stays whatever happens. Any thread but the haptic one.
#pragma once

#include <string_view>

namespace burin {

struct Appended {
    int error = 0;           // errno; 0: all is written
    bool has_begun = false;  // some bytes are in the file, though not all where there is an error
};
// Writes all bytes at the end of a file that was opened with O_APPEND. They outlive this process; a power cut they
// outlive once the file is synced to the disk.
[[nodiscard]] Appended append_whole(int file, std::string_view bytes);

}  // namespace burin
