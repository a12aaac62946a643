// SPDX-License-Identifier: MIT
// What the readers of recordings and of documents do alike before they come to what each kind of file holds.
// Failures are Errors that name the file and the remedy. Threads: one at a time for a database.
#pragma once

#include <initializer_list>
#include <map>
#include <string>

#include "record/database.hpp"

namespace burin::record {

// Bounds of a file's facts; what goes beyond them is left out.
inline constexpr std::size_t kMostFacts = 10'000, kMostTextBytes = std::size_t{1} << 20;

// Checks that this is a regular file, without opening it: closing it again would drop the locks that a writer in this
// process holds on it (POSIX locks belong to a process), and opening a pipe would wait. if_empty: what is said of an
// empty one.
[[nodiscard]] Result<void> check_regular(const std::string& path, const char* if_empty, const char* remedy);
// Returns whether the file was left with a log of SQLite beside it, and that is gone: whoever has taken or copied the
// file without FILE-wal has left behind what was written last.
[[nodiscard]] bool lacks_its_log(const std::string& path);
// Takes back what was being added to the file when its program was killed: a connection that only reads cannot, and is
// refused. Where nothing may be written, the reader then says so.
void take_back_what_was_interrupted(const std::string& path);
// Checks that the file has these tables.
[[nodiscard]] Result<void> check_tables(Database& database, const std::string& path,
                                        std::initializer_list<const char*> tables, const char* remedy);
// Reads the facts in table meta: versions, settings, where it came from.
[[nodiscard]] Result<std::map<std::string, std::string>> read_facts(Database& database);

}  // namespace burin::record
