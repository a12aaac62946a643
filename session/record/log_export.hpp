// SPDX-License-Identifier: MIT
// Writes a live session's log out of its session file as text, which can be done again like any text log: the lines as
// they are, and the ticks' lines made of the columns. A text log holds the ticks of one hand with one part; others are
// refused. One thread; blocks on the disk.
#pragma once

#include <string>

#include "record/export/table_export.hpp"
#include "record/record_reader.hpp"

namespace burin::session {

// Fails where the file has no log of a live session, and where anything has the path's name.
[[nodiscard]] Result<record::ExportReport> export_session_log(record::RecordReader& reader, const std::string& path);

}  // namespace burin::session
