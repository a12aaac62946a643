// SPDX-License-Identifier: MIT
// All input of a session as a text file: what is recorded, and what a user with a script writes by hand. The format is
// described in docs/formats.md, "The input log": a header line with version and settings, then a line an event; in a recording, between
// them, lines for what the threads did (thread_log.hpp).
//
// Reading what was written gives the same events exactly. A file whose last line has no end was torn off by a crash: that line
// is reported and left out, since nobody can tell whether it is whole.
// Failure: an Error that names file, line and remedy. Cost: reading takes memory in proportion to the file (some ten times
// its size at most), writing one write() a line and no waiting for the disk. One thread. Not for the haptic thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/thread_log.hpp"
#include "base/error.hpp"

namespace burin {

inline constexpr int kInputLogVersion = 2;                  // 1, without threads, is read as well
inline constexpr std::uint64_t kMostLogBytes = 256u << 20;  // some six hours of a session with its threads
inline constexpr std::size_t kMostSettingsBytes = 16384;

struct InputLog {
    std::string settings;  // what the session was started with, on one line
    std::vector<InputEvent> events;
    std::optional<ThreadLog> threads;      // what a live session's did; none: made up in simulated time
    std::optional<std::string> torn_line;  // a message, when the last line had no end and was left out
};

[[nodiscard]] Result<InputLog> read_input_log(const std::filesystem::path& path);
[[nodiscard]] Result<InputLog> parse_input_log(std::string_view text, const std::string& name);

// Each event is in the operating system's hands when append() returns: a crash of the program loses none of them and tears at
// most the line being written. A power failure may lose more.
class InputLogWriter {
public:
    // A new file: an existing one is left as it is and refused. settings: one line of valid UTF-8, without control characters or
    // blanks at its ends, at most kMostSettingsBytes.
    [[nodiscard]] static Result<InputLogWriter> create(const std::filesystem::path& path, const std::string& settings);

    InputLogWriter(InputLogWriter&& other) noexcept;
    InputLogWriter& operator=(InputLogWriter&& other) noexcept;
    ~InputLogWriter();

    // Refused: an event that is not sensible, or before the one before it; nothing is written then. After a failure of the file
    // (a full disk) every later event is refused too, so that what is in the file stays a log.
    [[nodiscard]] Result<void> append(const InputEvent& event);
    // A line of what the threads did (thread_log.hpp), without its time. Refused as an event is.
    [[nodiscard]] Result<void> append_threads(Nanoseconds time_ns, const std::string& text);

private:
    InputLogWriter() = default;
    [[nodiscard]] Result<void> come_to(Nanoseconds time_ns);
    [[nodiscard]] Result<void> write_line(std::string line);

    std::string name_;
    int file_ = -1;
    Nanoseconds last_ns_ = 0;
    bool broken_ = false;
};

}  // namespace burin
