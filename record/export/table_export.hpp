// SPDX-License-Identifier: MIT
// Writes the ticks of one hand as a table that other programs read: one file a format.
//
// The table is written under a temporary name and renamed at its end (new_file.hpp), so a failure leaves what was
// there. Memory: one block, whatever the recording's length. Damaged blocks are left out and named in the report: a
// table with ticks missing is better than none, and the caller says so.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "record/record_reader.hpp"

namespace burin::record {

struct ExportReport {
    std::uint64_t rows = 0;
    std::size_t columns = 0;
    std::vector<Error> damaged;  // the blocks that are left out
};

// Comma-separated text in UTF-8: a line of names, then a line a tick. Numbers as text_of() writes them, which read back
// to the same bits. csv.cpp
[[nodiscard]] Result<ExportReport> export_csv(RecordReader& reader, std::size_t hand,
                                              const std::vector<std::size_t>& columns, const std::string& path);

// NumPy's format, version 1.0 or 2.0 (numpy.lib.format): one array of records with a field a column, of types <f8, <i8
// and <u4, so that every value keeps its bits. npy.cpp
[[nodiscard]] Result<ExportReport> export_npy(RecordReader& reader, std::size_t hand,
                                              const std::vector<std::size_t>& columns, const std::string& path);

// Goes through the blocks of a hand, and leaves out and reports those that are damaged; ends at the first failure of
// `take`.
[[nodiscard]] Result<void> each_block(RecordReader& reader, std::size_t hand, ExportReport& report,
                                      const std::function<Result<void>(const Block&)>& take);

}  // namespace burin::record
