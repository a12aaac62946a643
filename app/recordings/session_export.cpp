// SPDX-License-Identifier: MIT
#include "app/recordings/session_export.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "app/cli/output_files.hpp"
#include "app/recordings/session_words.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"
#include "record/record_reader.hpp"
#include "session/record/log_export.hpp"

namespace burin::app {
namespace {

// Returns the table of this name: a hand, or a derived one by the beginning of its name.
Result<std::size_t> find_table(const record::RecordReader& reader, const std::string& part) {
    std::vector<std::string_view> names;
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < reader.tables(); ++t) {
        const record::HandRecord& table = reader.table(t);
        if (table.name == part) return t;
        if (!part.empty() && table.is_derived() && table.name.starts_with(part)) found.push_back(t);
        names.push_back(table.name);
    }
    if (part.empty() && reader.hands().size() == 1) return std::size_t{0};
    if (found.size() == 1) return found.front();
    const std::string what = part.empty()       ? "has several hands"
                             : found.size() > 1 ? "has several tables that begin with " + part
                                                : "has no hand or table " + part;
    return fail(reader.path(), what, "--part one of: " + joined(names));
}

// The name of the output where none is given: the recording's, with another ending.
std::string output_of(const SessionExport& options) {
    if (!options.out.empty()) return options.out;
    const std::filesystem::path in(options.in);
    if (options.to == "bids") return std::filesystem::path(in).replace_extension().string() + "-bids";
    return std::filesystem::path(in).replace_extension(options.to == "hdf5" ? "h5" : options.to).string();
}

Result<record::ExportReport> export_table(record::RecordReader& reader, const SessionExport& options,
                                          const std::string& out) {
    if (options.to == "log" && reader.facts().contains(record::kLogHeaderFact))
        return session::export_session_log(reader, out);
    if (options.to == "log") return record::export_log(reader, out);
    BURIN_TRY(table, find_table(reader, options.part));
    BURIN_TRY(columns, record::choose_columns(reader.table(table).columns, options.columns));
    Result<record::TickTimes> times;
    if (!options.trials.empty()) times = record::times_of_trials(reader, options.trials);
    if (!times) return std::unexpected(times.error());
    if (options.to == "npy") return record::export_npy(reader, table, columns, out, *times);
    if (options.to == "hdf5") return record::export_hdf5(reader, table, columns, out, *times);
    if (options.to == "mat") return record::export_mat(reader, table, columns, out, *times);
    if (options.to == "bids")
        return record::export_bids(reader, table, columns, out, {options.subject, options.task}, *times);
    return record::export_csv(reader, table, columns, out, *times);
}

}  // namespace

Result<void> export_session(const SessionExport& options) {
    const std::string out = output_of(options);
    BURIN_TRY_DO(check_overwrites_none(out, std::array{options.in}));
    BURIN_TRY_DO(record::check_no_file(out));
    if (options.to == "log" && !(options.columns.empty() && options.part.empty() && options.trials.empty()))
        return fail("--to log", "has no columns, parts or trials to choose",
                    "leave --columns, --part and --trials out");
    BURIN_TRY(reader, record::RecordReader::open(options.in));
    BURIN_TRY(report, export_table(reader, options, out));
    for (const Error& error : report.damaged) std::fprintf(stderr, "burin: %s\n", error.line().c_str());
    if (out != kStandardOutput && options.to == "log")
        std::printf("%s: %s\n", out.c_str(), counted(report.rows, "line", "lines").c_str());
    else if (out != kStandardOutput)
        std::printf("%s: %s, %s\n", out.c_str(), counted(report.rows, "tick", "ticks").c_str(),
                    counted(report.columns, "column", "columns").c_str());
    if (report.damaged.empty()) return {};
    return fail(options.in, counted(report.damaged.size(), "block is", "blocks are") + " damaged and left out",
                "the rest has been written");
}

}  // namespace burin::app
