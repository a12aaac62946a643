// SPDX-License-Identifier: MIT
// Records a live session into a session file (record/record_writer.hpp): every tick with all its columns, and beside
// them the input log, line by line as a text log has it (docs/formats.md, "The input log").
//
//   haptic thread -> ring of tick records of each part of the hands -> the writer's thread, the rings' only reader
//     -> columns; and the frames' checksums
//   frame's thread -> lines, frames -> wait here for the ticks that a frame has seen -> the same transactions
// What the ticks saw stands in their columns alone; a replay reads them there (tick_source.hpp).
//
// The frame's thread waits for no disk and reads no ring: one that stands still loses nothing. The log ends where it
// could not be replayed beyond: where a tick is missing, because the disk stood still for longer than the ring holds,
// or where the scene did not take a tick's sample. Columns go on all the same; what is lost is counted in the file.
//
// Threads: line(), frame(), trial(), event(), take_ticks(), close() are the frame's thread's, progress() any one's but
// the haptic one's.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "record/record_writer.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/record/session_check.hpp"
#include "session/record/session_file.hpp"
#include "session/record/thread_log.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::session {

// A part of a hand whose ticks are recorded: a table of the file.
struct RecordedPart {
    std::string name;  // unique; empty: the device's
    devices::DeviceDescription device;
    haptics::Probe probe;  // with as many points as any that the part will have
    Ring<haptics::TickRecord>* ring = nullptr;
};

// What a recording is of. The rings must outlive the recording.
struct RecordingOf {
    std::vector<RecordedPart> parts;
    ThreadClock clock;
    std::string settings;  // of the session (settings_line())
    std::vector<std::pair<std::string, std::string>> facts = {};
    std::vector<std::pair<std::int64_t, std::string>> objects = {};
    std::string vfs = {};        // WriterOptions::vfs
    record::OnRecord also = {};  // takes every tick as well, on the writer's thread; null: nobody
};

class SessionRecording {
public:
    // Makes the file; fails where there is one. Before the haptic thread starts.
    [[nodiscard]] static Result<std::shared_ptr<SessionRecording>> create(const std::string& path, RecordingOf session);
    SessionRecording(const SessionRecording&) = delete;
    SessionRecording& operator=(const SessionRecording&) = delete;

    // Takes a line of the log, with its time in it as well. Fails when nothing is recorded any more.
    [[nodiscard]] Result<void> line(Nanoseconds time_ns, std::string line);
    // Takes a frame, whose line follows when its tick has been recorded; its checksum is computed then.
    [[nodiscard]] Result<void> frame(Nanoseconds time_ns, const FrameSeen& seen, const StateWords& state);
    // Begins a trial, or ends the one under way.
    void trial(const TrialMark& mark);
    // Keeps an event.
    void event(EventMark mark);
    // Writes a fact when the recording is closed.
    void fact_of_end(std::string key, std::string value);
    // Returns when all ticks that the ring holds are recorded: at the end, when no tick follows.
    void take_ticks();
    // Brings everything to the disk. Fails with why something is missing.
    [[nodiscard]] Result<void> close();

    struct Progress {
        std::uint64_t recorded = 0;      // ticks, of all parts
        std::uint64_t acknowledged = 0;  // the last tick that is on the disk, of every part
        std::uint64_t lost = 0;          // ticks, to a full ring, or to a disk that failed
    };
    [[nodiscard]] Progress progress() const;
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    struct Waiting {
        Nanoseconds time_ns = 0;
        std::string line;       // of a frame: none yet
        bool is_frame = false;  // which waits for the ticks that it has seen
        FrameSeen frame = {};
        StateWords state{};
    };
    SessionRecording(std::string path, RecordingOf session);
    void take(std::size_t part, const haptics::TickRecord& tick);
    [[nodiscard]] Result<void> add(Waiting waiting);
    [[nodiscard]] bool has_ticks_of(const FrameSeen& frame) const;
    void pass_on();
    void note(Nanoseconds time_ns, std::string line);
    void end_log(Error why);

    std::string path_;
    RecordingOf session_;
    mutable std::mutex mutex_;  // guards what follows
    std::deque<Waiting> waiting_;
    std::vector<std::uint64_t> ticks_;  // taken, of each part
    std::uint64_t recorded_ = 0;        // whether or not the log has ended
    Nanoseconds last_ns_ = 0;           // of the last line
    SessionCheck check_;
    std::optional<Error> log_ended_;
    std::optional<std::int64_t> trial_;             // under way; the frame's thread's
    std::unique_ptr<record::RecordWriter> writer_;  // last: its thread calls take() until it has ended
};

}  // namespace burin::session
