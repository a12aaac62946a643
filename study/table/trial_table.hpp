// SPDX-License-Identifier: MIT
// A table of trials, one row a trial, as burin study analyse reads it (CSV, docs/formats.md). Numbers stay in the
// file's own units, which its column names state. All faults of a text are found at once. Any thread; allocates no
// more than the text is long.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "study/statistics/exact.hpp"

namespace burin::study {

struct Trial {
    std::string participant;              // a code, never a name
    std::string group;                    // the training that the participant had
    int number = 0;                       // which trial of the participant
    double deviation = 0.0;               // at least 0, in the table's unit
    double time = 0.0;                    // above 0, in the table's unit
    Decimal exact_deviation, exact_time;  // the same as they are written
    std::string stage{}, world{}, day{};  // of a study's trials; empty: the table does not say
};

// A row without measures that says why: it is shown and not analysed.
struct LostTrial {
    std::string participant, group;
    int number = 0;
    std::string stage{}, world{}, day{}, reason{};
};

struct TrialTable {
    std::vector<Trial> trials;               // in the file's order
    std::vector<LostTrial> lost;             // likewise
    std::vector<std::string> groups;         // of trials, each once, in the order in which they appear
    std::string time_unit;                   // "s" or "min"
    std::string deviation_unit;              // "m", "mm", or empty where the column's name states none
    std::vector<std::string> other_columns;  // read by nobody
};

// A fault of the text, by line and column, both counted from 1; the column counts characters.
struct TableFault {
    std::size_t line = 0, column = 0;
    std::string what, remedy;
};

// "FILE:LINE:COLUMN: what; remedy"
[[nodiscard]] std::string line_of(const TableFault& fault, const std::string& file);

// A table is to be used only where there are no faults.
struct ParsedTable {
    TrialTable table;
    std::vector<TableFault> faults;  // by line, then column
};
[[nodiscard]] ParsedTable parse_trials(std::string_view text);

inline constexpr std::uint64_t kMostTableBytes = std::uint64_t{16} << 20;
// More rows are a fault, behind which nothing is read: they are samples of a trial rather than trials.
inline constexpr std::size_t kMostRows = 20'000;

// Fails only where the file cannot be read, or is larger than kMostTableBytes.
[[nodiscard]] Result<ParsedTable> read_trials(const std::filesystem::path& path);

}  // namespace burin::study
