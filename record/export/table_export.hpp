// SPDX-License-Identifier: MIT
// Writes the ticks of one hand, or a table that was derived from them, so that other programs read it: one file a
// format. `table` is an index into RecordReader::table(), `columns` are indices into its columns.
//
// The output is written under a temporary name and renamed at its end (new_file.hpp), so a failure leaves what was
// there. Memory: one block, whatever the recording's length. Damaged blocks are left out and named in the report: a
// table with ticks missing is better than none, and the caller says so.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "record/record_reader.hpp"

namespace burin::record {

// The fact in table meta that holds the first line of an input log whose other lines are those of table line.
inline constexpr const char* kLogHeaderFact = "log header";

// Stretches of time whose ticks are written, both ends included, such as those of trials; none: all ticks.
struct TickTimes {
    struct Stretch {
        std::int64_t from_ns = 0, to_ns = 0;
    };
    std::vector<Stretch> stretches = {};

    [[nodiscard]] bool hold(std::int64_t time_ns) const;
};

// Returns the times of the trials that a list names: numbers, names, or names' beginnings with a star, with commas
// between them. Fails on one that fits none. A trial that is open lasts to the end.
[[nodiscard]] Result<TickTimes> times_of_trials(RecordReader& reader, std::string_view list);

struct ExportReport {
    std::uint64_t rows = 0;
    std::size_t columns = 0;
    std::vector<Error> damaged;  // the blocks that are left out
};

// Comma-separated text in UTF-8: a line of names, then a line a tick. Numbers as text_of() writes them, which read back
// to the same bits. csv.cpp
[[nodiscard]] Result<ExportReport> export_csv(RecordReader& reader, std::size_t table,
                                              const std::vector<std::size_t>& columns, const std::string& path,
                                              const TickTimes& times = {});

// NumPy's format, version 1.0 or 2.0 (numpy.lib.format): one array of records with a field a column, of types <f8, <i8
// and <u4, so that every value keeps its bits. npy.cpp
[[nodiscard]] Result<ExportReport> export_npy(RecordReader& reader, std::size_t table,
                                              const std::vector<std::size_t>& columns, const std::string& path,
                                              const TickTimes& times = {});

// HDF5 (1.8 and later): group /ticks with a dataset a column, whose attributes `unit` and `frame` say what it holds,
// of types f64, i64 and u32, little-endian, in chunks packed by deflate; /meta/key and /meta/value with the facts,
// /objects/number and /objects/name. hdf5.cpp
[[nodiscard]] Result<ExportReport> export_hdf5(RecordReader& reader, std::size_t table,
                                               const std::vector<std::size_t>& columns, const std::string& path,
                                               const TickTimes& times = {});

// MAT-file, level 5 (MATLAB's "MAT-File Format", versions 5 to 7): a column vector of double, int64 or uint32 a column,
// and the texts burin_columns, burin_meta and burin_objects. Reads the recording twice: a vector lies in one piece, and
// its length stands before it. Fails on a vector above 2 GiB, which MATLAB does not read. mat.cpp
[[nodiscard]] Result<ExportReport> export_mat(RecordReader& reader, std::size_t table,
                                              const std::vector<std::size_t>& columns, const std::string& path,
                                              const TickTimes& times = {});

// Labels of a BIDS data set: letters and digits.
struct BidsLabels {
    std::string subject = "01", task = "touch";
};
[[nodiscard]] Result<void> check_labels(const BidsLabels& labels);

// A folder as the Brain Imaging Data Structure 1.9 has motion (its motion extension): dataset_description.json,
// participants.tsv, README and sub-.../motion/ with *_motion.tsv, *_motion.json, *_channels.tsv, *_channels.json and,
// where there are trials, *_events.tsv. The first channel is the latency since the first tick; what is not a number is
// n/a. Nothing may have the folder's name. bids.cpp
[[nodiscard]] Result<ExportReport> export_bids(RecordReader& reader, std::size_t table,
                                               const std::vector<std::size_t>& columns, const std::string& path,
                                               const BidsLabels& labels = {}, const TickTimes& times = {});

// The log as text. Of a live session the input log as a text recording has it, line by line, which can be replayed
// (kLogHeaderFact). Else what was noted: facts and columns as comments, then lines, events and trials by time, one a
// line: time_ns, kind, text. log.cpp
[[nodiscard]] Result<ExportReport> export_log(RecordReader& reader, const std::string& path);

// Returns the text with a space for each end of a line, for formats with a fact a line. log.cpp
[[nodiscard]] std::string in_a_line(std::string text);

// Goes through the blocks of a table, with those of their rows alone that the times hold, and leaves out and reports
// blocks that are damaged; ends at the first failure of `take`.
[[nodiscard]] Result<void> each_block(RecordReader& reader, std::size_t table, const TickTimes& times,
                                      ExportReport& report, const std::function<Result<void>(const Block&)>& take);

}  // namespace burin::record
