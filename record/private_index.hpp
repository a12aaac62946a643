// SPDX-License-Identifier: MIT
// How a file is read whose writer was killed, without making anything beside it.
//
// SQLite reads a file with a log (FILE-wal) by an index of that log, which it keeps in FILE-shm for all who have the
// file open. A reader would leave that file behind, and could make none on a full disk or in a folder that may only be
// read. So readers here keep the index in their own memory. Whoever writes with Burin has the file for itself, or adds
// to its log alone (record/derived.cpp), and a reader's lock on the file keeps a program that closes it from bringing
// the log into it: only a program that has FILE-shm open already has to be told what the reader reads, and
// is_index_shared() finds that one.
// Threads: any. Cost: 32 KiB for each 4000 pages of a log, as long as the file is open.
#pragma once

#include <string>

namespace burin::record {

// Returns the name of a file system of SQLite's that keeps the index of a log in memory; registers it at the first
// call.
[[nodiscard]] const char* private_index_vfs();
// Returns whether some program has FILE-shm open now.
[[nodiscard]] bool is_index_shared(const std::string& path);

}  // namespace burin::record
