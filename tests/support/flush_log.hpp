// SPDX-License-Identifier: MIT
// Counts what a program brings to the disk: each fsync() and fdatasync() of this program and of the libraries that it
// links, with the path of what was flushed. Both still flush.
//
// For test programs alone: it takes the place of the C library's functions. Threads: any.
#pragma once

#include <string>
#include <vector>

namespace burin {

struct Flushed {
    std::string path;                     // as the kernel knows it
    std::vector<std::string> names = {};  // of a folder: what lay in it then, sorted; of a file: nothing
    bool is_folder = false;
};

// Forgets what was flushed so far.
void forget_flushes();
// Returns what has been flushed since, in its order.
[[nodiscard]] std::vector<Flushed> all_flushes();

}  // namespace burin
