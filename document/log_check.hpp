// SPDX-License-Identifier: MIT
// Finds damage in SQLite's log beside a file (NAME-wal). SQLite reads such a log up to the first fault and
// says nothing of what follows. Any thread.
#pragma once

#include <string>

namespace burin::document {

// Returns whether a transaction that was ended in the log of this file cannot be read. One that a kill cut off had not
// been ended.
[[nodiscard]] bool is_log_damaged(const std::string& path);

}  // namespace burin::document
