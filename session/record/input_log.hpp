// SPDX-License-Identifier: MIT
// Reads and writes all input of a session as a text file, both recordings and hand-written scripts. The format is
// described in docs/formats.md, "The input log": a header line with version and settings, then one line per event; in a
// recording, lines between them for what the threads did (session/record/thread_log.hpp).
//
// Reading what was written gives the same events exactly. A last line without an end was torn off by a crash: it is
// reported and left out, since nobody can tell whether it is whole.
// Failure: an Error that names file, line and remedy. Cost: reading takes memory in proportion to the file (some ten
// times its size at most); writing takes one write() per line and does not wait for the disk. One thread. Not for the
// haptic thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "session/input/input_event.hpp"
#include "session/record/session_check.hpp"
#include "session/record/thread_log.hpp"

namespace burin::session {

inline constexpr int kInputLogVersion = 2;                  // version 1, without threads, is read as well
inline constexpr std::uint64_t kMostLogBytes = 256u << 20;  // some six hours of a session with its threads
inline constexpr std::size_t kMostSettingsBytes = 16384;

struct InputLog {
    std::string settings;  // what the session was started with, on one line
    std::vector<InputEvent> events;
    std::string device;                    // of a session file: the force-feedback device; empty: not said
    std::optional<ThreadLog> threads;      // of a live session; none: simulated time
    std::optional<std::string> torn_line;  // message about a last line without an end
};

[[nodiscard]] Result<InputLog> read_input_log(const std::filesystem::path& path);
[[nodiscard]] Result<InputLog> parse_input_log(std::string_view text, const std::string& name);

// Returns the first line of a log; name: the file's. Fails on settings that are not one line of valid UTF-8, without
// control characters or blanks at its ends, of at most kMostSettingsBytes.
[[nodiscard]] Result<std::string> input_log_header(const std::string& settings, const std::string& name);

class SessionRecording;

// Writes a log, into a text file or into a session file. In a text file each event is in the operating system's hands
// when append() returns: a crash of the program loses none of them and tears at most the line being written. A power
// failure may lose more. A session file keeps what it has acknowledged (session/record/session_recording.hpp).
class InputLogWriter {
public:
    // Creates a new text file; refuses to touch an existing one.
    [[nodiscard]] static Result<InputLogWriter> create(const std::filesystem::path& path, const std::string& settings);
    // Writes into a session file, which has its header already.
    [[nodiscard]] static InputLogWriter into(std::shared_ptr<SessionRecording> recording);

    InputLogWriter(InputLogWriter&& other) noexcept;
    InputLogWriter& operator=(InputLogWriter&& other) noexcept;
    ~InputLogWriter();

    // Appends an event. Refuses one that is not sensible or is earlier than the one before it, and writes nothing then.
    // After a failure of the file (a full disk) every later event is refused too, so that the file stays a valid log.
    [[nodiscard]] Result<void> append(const InputEvent& event);
    // Appends a line of what the threads did (session/record/thread_log.hpp), given without its time. Refuses as
    // append() does.
    [[nodiscard]] Result<void> append_threads(Nanoseconds time_ns, const std::string& text);
    // Appends the line of a frame to a session file, which sums up its checksum itself.
    [[nodiscard]] Result<void> append_frame(Nanoseconds time_ns, const FrameSeen& frame, const StateWords& state);
    // The session file; null where a text file is written.
    [[nodiscard]] const std::shared_ptr<SessionRecording>& recording() const { return recording_; }

private:
    InputLogWriter() = default;
    [[nodiscard]] Result<void> come_to(Nanoseconds time_ns);
    [[nodiscard]] Result<void> write_line(std::string line);

    std::shared_ptr<SessionRecording> recording_;  // null: a text file
    std::string name_;
    int file_ = -1;
    Nanoseconds last_ns_ = 0;
    bool broken_ = false;
};

}  // namespace burin::session
