// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {
namespace {

struct LogEntry {
    std::int64_t time_ns = 0;
    std::string text;  // kind and what it says
};

// A text in one line.
Result<std::vector<LogEntry>> events_and_trials(RecordReader& reader) {
    const auto events = reader.events();
    const auto trials = reader.trials();
    if (!events) return std::unexpected(events.error());
    if (!trials) return std::unexpected(trials.error());
    std::vector<LogEntry> entries;
    for (const EventRecord& event : *events)
        entries.push_back({event.time_ns, "event " + event.name + " " + event.value});
    for (const TrialRecord& trial : *trials) {
        entries.push_back({trial.begun_ns, "trial " + std::to_string(trial.id) + " begins: " + trial.name});
        if (trial.state != "open")
            entries.push_back({trial.ended_ns, "trial " + std::to_string(trial.id) + " ends: " + trial.state});
    }
    std::ranges::stable_sort(entries, {}, &LogEntry::time_ns);
    return entries;
}

std::string log_head(const RecordReader& reader) {
    std::string head = "# log of a Burin session: time_ns, kind, text\n";
    for (const auto& [key, value] : reader.facts()) head += "# " + in_a_line(key + ": " + value) + "\n";
    for (const HandRecord& hand : reader.hands())
        head += in_a_line("# hand " + hand.name + ": " + std::to_string(hand.rows()) + " ticks of " +
                          std::to_string(hand.columns.size()) + " columns") +
                "\n";
    return head;
}

// Writes an input log as it was: its first line, and then its lines as they are.
Result<ExportReport> export_input_log(RecordReader& reader, const std::string& header, const std::string& path) {
    BURIN_TRY(file, NewFile::create(path));
    Result<void> written = file.write(in_a_line(header) + "\n");
    ExportReport report{.rows = 1, .columns = 0, .damaged = {}};
    const auto read = reader.each_line([&](std::int64_t, const std::string& text) {
        if (written) written = file.write(in_a_line(text) + "\n");
        ++report.rows;
    });
    if (!read) return std::unexpected(read.error());
    if (!written) return std::unexpected(written.error());
    BURIN_TRY_DO(file.finish());
    return report;
}

}  // namespace

std::string in_a_line(std::string text) {
    std::ranges::replace_if(text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

Result<ExportReport> export_log(RecordReader& reader, const std::string& path) {
    if (const auto header = reader.facts().find(kLogHeaderFact); header != reader.facts().end())
        return export_input_log(reader, header->second, path);
    BURIN_TRY(others, events_and_trials(reader));
    BURIN_TRY(file, NewFile::create(path));
    Result<void> written = file.write(log_head(reader));
    ExportReport report;
    const auto put = [&](std::int64_t time_ns, const std::string& text) {
        if (!written) return;
        written = file.write(std::to_string(time_ns) + " " + in_a_line(text) + "\n");
        ++report.rows;
    };
    auto next = others.begin();
    const auto read = reader.each_line([&](std::int64_t time_ns, const std::string& text) {
        for (; next != others.end() && next->time_ns <= time_ns; ++next) put(next->time_ns, next->text);
        put(time_ns, "line " + text);
    });
    if (!read) return std::unexpected(read.error());
    for (; next != others.end(); ++next) put(next->time_ns, next->text);
    if (!written) return std::unexpected(written.error());
    BURIN_TRY_DO(file.finish());
    return report;
}

}  // namespace burin::record
