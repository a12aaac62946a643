// SPDX-License-Identifier: MIT
#include "session/record/session_recording.hpp"

#include <algorithm>
#include <filesystem>

#include "base/try.hpp"
#include "haptics/tick_record.hpp"
#include "record/export/table_export.hpp"
#include "record/touched_columns.hpp"
#include "session/input/input_line.hpp"
#include "session/record/input_log.hpp"

namespace burin::session {

Result<std::shared_ptr<SessionRecording>> SessionRecording::create(const std::string& path, RecordingOf session) {
    BURIN_TRY(header, input_log_header(session.settings, path));
    std::shared_ptr<SessionRecording> made(new SessionRecording(path, std::move(session)));
    const RecordingOf& own = made->session_;
    std::vector<record::RecordedHand> hands;
    for (const RecordedPart& part : own.parts) {
        record::RecordedHand hand{part.name.empty() ? part.device.name : part.name, part.device, part.probe, part.ring};
        const record::RowShape shape = record::shape_of(part.device, part.probe);
        hand.more_columns = record::touched_columns(shape);
        hand.more_values = [shape](const haptics::TickRecord& tick, std::vector<record::Word>& row) {
            record::append_touched(tick, shape, row);
        };
        hands.push_back(std::move(hand));
    }
    record::WriterOptions options;
    options.facts = own.facts;
    options.facts.emplace_back(kActivityFact, kLiveActivity);
    options.facts.emplace_back(kEventsFact, "touches, devices, activity");
    options.facts.emplace_back(record::kLogHeaderFact, header);
    options.objects = own.objects;
    options.vfs = own.vfs;
    options.on_record = [r = made.get()](std::size_t part, const haptics::TickRecord& tick) { r->take(part, tick); };
    // The writer's thread calls take() as soon as there are ticks, and there are none before the haptic thread runs.
    BURIN_TRY(writer, record::RecordWriter::create(path, std::move(hands), std::move(options)));
    made->writer_ = std::move(writer);
    return made;
}

SessionRecording::SessionRecording(std::string path, RecordingOf session)
    : path_(std::move(path)),
      session_(std::move(session)),
      ticks_(session_.parts.size()),
      check_(session_.parts.size()) {}

// ---- The frame's thread

Result<void> SessionRecording::line(Nanoseconds time_ns, std::string line) {
    return add({time_ns, std::move(line), false, {}, {}});
}

Result<void> SessionRecording::frame(Nanoseconds time_ns, const FrameSeen& seen, const StateWords& state) {
    return add({time_ns, {}, true, seen, state});
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

void SessionRecording::event(EventMark mark) {
    writer_->note_event(mark.time_ns, std::move(mark.name), std::move(mark.value));
}

void SessionRecording::fact_of_end(std::string key, std::string value) {
    writer_->note_fact(std::move(key), std::move(value));
}

void SessionRecording::take_ticks() { writer_->take_now(); }

Result<void> SessionRecording::close() {
    take_ticks();
    std::optional<Error> ended;
    {
        const std::lock_guard lock(mutex_);
        ended = log_ended_;
    }
    BURIN_TRY_DO(writer_->close());
    if (ended) return std::unexpected(*ended);
    return {};
}

SessionRecording::Progress SessionRecording::progress() const {
    Progress progress{0, writer_->acknowledged(), 0};
    for (std::size_t part = 0; part < session_.parts.size(); ++part) {
        progress.acknowledged = std::min(progress.acknowledged, writer_->acknowledged(part));
        progress.lost += session_.parts[part].ring->refused();
    }
    std::uint64_t on_disk = 0;
    for (std::size_t part = 0; part < session_.parts.size(); ++part) on_disk += writer_->acknowledged(part);
    const bool failed = writer_->failure().has_value();
    const std::lock_guard lock(mutex_);
    progress.recorded = recorded_;
    // Nothing of what waited for a disk that failed will get there.
    if (failed && recorded_ > on_disk) progress.lost += recorded_ - on_disk;
    return progress;
}

// ---- The writer's thread

void SessionRecording::take(std::size_t part, const haptics::TickRecord& tick) {
    if (session_.also) session_.also(part, tick);
    const std::lock_guard lock(mutex_);
    ++recorded_;
    if (log_ended_) return;
    std::uint64_t& last = ticks_[part];
    if (tick.tick != last + 1) {
        return end_log({"the disk stood still for so long that " + std::to_string(tick.tick - last - 1) +
                            " ticks were lost after tick " + std::to_string(last),
                        path_, "up to there it can be replayed; record to a faster disk"});
    }
    if ((tick.flags & haptics::kTickSampleDropped) != 0) {
        return end_log(
            {"the scene stood still for so long that it did not take the sample of tick " + std::to_string(tick.tick),
             path_, "up to there it can be replayed; record the rest anew"});
    }
    check_.tick(part, tick);
    last = tick.tick;
    if (!waiting_.empty()) pass_on();
}

// ---- Either, with the mutex held

bool SessionRecording::has_ticks_of(const FrameSeen& frame) const {
    for (std::size_t part = 0; part < ticks_.size(); ++part)
        if (frame.ticks[part] > ticks_[part]) return false;
    return true;
}

// Passes on what waits, up to a frame whose ticks have not come.
void SessionRecording::pass_on() {
    while (!waiting_.empty() && (!waiting_.front().is_frame || has_ticks_of(waiting_.front().frame))) {
        Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        if (next.is_frame) {
            next.frame.check = check_.frame(next.frame.ticks, next.state);
            next.line = text_of_time(next.time_ns) + " " + text_of(next.frame);
        }
        note(next.time_ns, std::move(next.line));
    }
}

void SessionRecording::note(Nanoseconds time_ns, std::string line) {
    last_ns_ = time_ns;
    writer_->note_line(session_.clock.start_ns + time_ns, std::move(line));
}

void SessionRecording::end_log(Error why) {
    waiting_.clear();
    writer_->note_event(session_.clock.start_ns + last_ns_, kLogEndedEvent, why.line());
    log_ended_ = std::move(why);
}

}  // namespace burin::session
