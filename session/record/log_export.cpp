// SPDX-License-Identifier: MIT
#include "session/record/log_export.hpp"

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <utility>

#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "session/record/session_log.hpp"
#include "session/record/tick_source.hpp"

namespace burin::session {
namespace {

// The lines of ticks up to one that a frame has seen, or all that are left, each beginning with a time.
class TickLines {
public:
    // Null: there are none to write.
    TickLines(std::unique_ptr<TickSource> source, const ThreadClock& clock)
        : source_(std::move(source)), text_(clock) {}

    [[nodiscard]] Result<std::string> up_to(std::uint64_t last, const std::string& time) {
        std::string lines;
        while (source_ && ticks_ < last) {
            std::string line = time + " ticks " + std::to_string(ticks_ + 1) + " ";
            std::size_t of_line = 0;
            for (; of_line < kMostTicksALine && ticks_ < last; ++of_line, ++ticks_) {
                BURIN_TRY(tick, source_->next(0));
                if (!tick) source_.reset();
                if (!tick) break;
                text_.write(line, *tick);
            }
            if (of_line > 0) lines += line + "\n";
        }
        return lines;
    }

private:
    std::unique_ptr<TickSource> source_;
    TickText text_;
    std::uint64_t ticks_ = 0;
};

// Returns the tick that a line says a frame has seen, all for the line that ends the log, and nothing for other lines.
std::optional<std::uint64_t> seen_by(const std::string& line) {
    const std::size_t kind = line.find(' ') + 1;
    if (line.compare(kind, 4, "end ") == 0) return UINT64_MAX;
    if (line.compare(kind, 4, "saw ") != 0) return std::nullopt;
    std::uint64_t tick = 0;
    std::from_chars(line.data() + kind + 4, line.data() + line.size(), tick);
    return tick;
}

}  // namespace

Result<record::ExportReport> export_session_log(record::RecordReader& reader, const std::string& path) {
    const Result<InputLog> log = read_session_log(reader);
    if (!log) return std::unexpected(log.error());
    if (log->threads && reader.hands().size() > 1)
        return fail(reader.path(), "has the ticks of several parts of hands, which a log as text cannot hold",
                    "replay the session file itself; --to csv has its ticks");
    std::unique_ptr<TickSource> source;
    if (log->threads && log->threads->ticks.count == 0) {
        BURIN_TRY(columns, ticks_of_columns(reader));
        source = std::move(columns);
    }
    TickLines ticks(std::move(source), log->threads ? log->threads->clock : ThreadClock{});
    BURIN_TRY(file, record::NewFile::create(path));
    Result<void> written = file.write(reader.facts().at(record::kLogHeaderFact) + "\n");
    record::ExportReport report{.rows = 1, .columns = 0, .damaged = {}};
    const auto put = [&](const std::string& text) {
        report.rows += static_cast<std::uint64_t>(std::ranges::count(text, '\n'));
        if (written) written = file.write(text);
    };
    const auto read = reader.each_line([&](std::int64_t, const std::string& line) {
        if (const auto seen = written ? seen_by(line) : std::nullopt) {
            const Result<std::string> before = ticks.up_to(*seen, line.substr(0, line.find(' ')));
            if (!before) written = std::unexpected(before.error());
            if (before) put(*before);
        }
        put(record::in_a_line(line) + "\n");
    });
    if (!read) return std::unexpected(read.error());
    if (!written) return std::unexpected(written.error());
    BURIN_TRY_DO(file.finish());
    return report;
}

}  // namespace burin::session
