// SPDX-License-Identifier: MIT
#include "session/record/session_recording.hpp"

#include <filesystem>

#include "record/export/table_export.hpp"
#include "session/input/input_line.hpp"
#include "session/record/input_log.hpp"

namespace burin::session {

bool is_session_file(const std::string& path) { return std::filesystem::path(path).extension() == ".session"; }

void append_touched(const haptics::TickRecord& tick, const record::RowShape& shape, std::vector<record::Word>& row) {
    for (std::uint32_t i = 0; i < shape.points; ++i)
        row.push_back(i < tick.contact.point_count ? tick.contact.points[i].object : 0u);
}

std::vector<record::Column> touched_columns(const record::RowShape& shape) {
    std::vector<record::Column> columns;
    for (std::uint32_t i = 0; i < shape.points; ++i)
        columns.push_back({"object" + std::to_string(i), "", "", record::ColumnType::u32});
    return columns;
}

std::vector<record::Word> session_row(const haptics::TickRecord& tick, const record::RowShape& shape) {
    std::vector<record::Word> row = record::row_of(tick, shape);
    append_touched(tick, shape, row);
    return row;
}

Result<std::shared_ptr<SessionRecording>> SessionRecording::create(const std::string& path, RecordingOf session) {
    const Result<std::string> header = input_log_header(session.settings, path);
    if (!header) return std::unexpected(header.error());
    std::shared_ptr<SessionRecording> made(new SessionRecording(path, std::move(session)));
    const RecordingOf& own = made->session_;
    record::RecordedHand hand{own.device.name, own.device, own.probe, own.ring};
    const record::RowShape shape = record::shape_of(own.device, own.probe);
    hand.more_columns = touched_columns(shape);
    hand.more_values = [shape](const haptics::TickRecord& tick, std::vector<record::Word>& row) {
        append_touched(tick, shape, row);
    };
    record::WriterOptions options;
    options.facts = own.facts;
    options.facts.emplace_back(kActivityFact, kLiveActivity);
    options.facts.emplace_back(record::kLogHeaderFact, *header);
    options.objects = own.objects;
    options.vfs = own.vfs;
    options.on_record = [r = made.get()](std::size_t, const haptics::TickRecord& tick) { r->take(tick); };
    std::vector<record::RecordedHand> hands;
    hands.push_back(std::move(hand));
    // The writer's thread calls take() as soon as there are ticks, and there are none before the haptic thread runs.
    auto writer = record::RecordWriter::create(path, std::move(hands), std::move(options));
    if (!writer) return std::unexpected(writer.error());
    made->writer_ = std::move(*writer);
    return made;
}

SessionRecording::SessionRecording(std::string path, RecordingOf session)
    : path_(std::move(path)), session_(std::move(session)), tick_text_(session_.clock) {}

// ---- The frame's thread

Result<void> SessionRecording::line(Nanoseconds time_ns, std::string line) {
    return add({time_ns, std::move(line), 0, {}, {}});
}

Result<void> SessionRecording::frame(Nanoseconds time_ns, const FrameSeen& seen, const StateWords& state) {
    return add({time_ns, {}, seen.tick, seen, state});
}

Result<void> SessionRecording::add(Waiting waiting) {
    if (const auto failed = writer_->failure()) return std::unexpected(*failed);
    const std::lock_guard lock(mutex_);
    if (log_ended_) return std::unexpected(*log_ended_);
    waiting_.push_back(std::move(waiting));
    pass_on();
    return {};
}

void SessionRecording::trial(const TrialMark& mark) {
    if (!mark.name.empty())
        trial_ = writer_->begin_trial(mark.time_ns, mark.name);
    else if (trial_)
        writer_->end_trial(*std::exchange(trial_, std::nullopt), mark.time_ns, mark.state);
}

void SessionRecording::take_ticks() { writer_->take_now(); }

Result<void> SessionRecording::close() {
    take_ticks();
    std::optional<Error> ended;
    {
        const std::lock_guard lock(mutex_);
        if (!log_ended_) write_ticks();
        ended = log_ended_;
    }
    if (const auto closed = writer_->close(); !closed) return closed;
    if (ended) return std::unexpected(*ended);
    return {};
}

SessionRecording::Progress SessionRecording::progress() const {
    const std::uint64_t acknowledged = writer_->acknowledged();
    const std::lock_guard lock(mutex_);
    return {recorded_, acknowledged, session_.ring->refused()};
}

// ---- The writer's thread

void SessionRecording::take(const haptics::TickRecord& tick) {
    const std::lock_guard lock(mutex_);
    ++recorded_;
    if (log_ended_) return;
    if (tick.tick != ticks_ + 1) {
        return end_log({"the disk stood still for so long that " + std::to_string(tick.tick - ticks_ - 1) +
                            " ticks were lost after tick " + std::to_string(ticks_),
                        path_, "up to there it can be replayed; record to a faster disk"});
    }
    if ((tick.flags & haptics::kTickSampleDropped) != 0) {
        return end_log(
            {"the scene stood still for so long that it did not take the sample of tick " + std::to_string(tick.tick),
             path_, "up to there it can be replayed; record the rest anew"});
    }
    check_.tick(tick);
    tick_text_.write(ticks_text_, {tick.time_ns, tick.sample, tick.surface_sequence, tick.parameter_sequence,
                                   (tick.flags & haptics::kTickLate) != 0});
    ++ticks_;
    if (ticks_ - written_ticks_ == kMostTicksALine) write_ticks();
    if (!waiting_.empty()) pass_on();
}

// ---- Either, with the mutex held

// Passes on what waits, up to a frame whose tick has not come.
void SessionRecording::pass_on() {
    while (!waiting_.empty() && waiting_.front().tick <= ticks_) {
        Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        if (next.line.empty()) {
            write_ticks();
            next.frame.check = check_.frame(next.tick, next.state);
            next.line = text_of_time(next.time_ns) + " " + text_of(next.frame);
        }
        note(next.time_ns, std::move(next.line));
    }
}

void SessionRecording::write_ticks() {
    if (ticks_ == written_ticks_) return;
    note(last_ns_, text_of_time(last_ns_) + " ticks " + std::to_string(written_ticks_ + 1) + " " + ticks_text_);
    ticks_text_.clear();
    written_ticks_ = ticks_;
}

void SessionRecording::note(Nanoseconds time_ns, std::string line) {
    last_ns_ = time_ns;
    writer_->note_line(session_.clock.start_ns + time_ns, std::move(line));
}

void SessionRecording::end_log(Error why) {
    write_ticks();
    waiting_.clear();
    writer_->note_event(session_.clock.start_ns + last_ns_, "log ended", why.line());
    log_ended_ = std::move(why);
}

}  // namespace burin::session
