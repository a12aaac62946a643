// SPDX-License-Identifier: MIT
// Reads the input log out of a session file that a live session was recorded into. One thread.
#pragma once

#include <string>

#include "record/record_reader.hpp"
#include "session/record/input_log.hpp"

namespace burin::session {

// Returns whether the file begins as SQLite's do; a text log never does.
[[nodiscard]] bool is_database(const std::string& path);

// Reads the log; the device that it was recorded with comes along. Fails on a file whose session was no live one.
// Memory: some ten times the log's text.
[[nodiscard]] Result<InputLog> read_session_log(record::RecordReader& reader);

}  // namespace burin::session
