// SPDX-License-Identifier: MIT
#include "session/record/input_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "session/input/input_line.hpp"
#include "session/input/input_words.hpp"
#include "session/record/session_recording.hpp"

namespace burin::session {
namespace {

constexpr std::string_view kMagic = "burin-input";

bool is_settings_line(const std::string& settings) {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    return settings.size() <= kMostSettingsBytes && std::ranges::none_of(settings, control) &&
           (settings.empty() || (settings.front() != ' ' && settings.back() != ' '));
}

struct Header {
    int version = 0;
    std::string settings;
};

Result<Header> read_header(std::string_view line, const std::string& where) {
    const std::string remedy =
        "its first line must read: burin-input " + std::to_string(kInputLogVersion) + " SETTINGS";
    if (line.ends_with('\r')) line.remove_suffix(1);
    const bool ours = line.starts_with(kMagic) && line.size() > kMagic.size() && line[kMagic.size()] == ' ';
    if (!ours) return fail(where, "this is no input log", remedy);
    line.remove_prefix(kMagic.size() + 1);
    int version = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), version);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (error != std::errc{} || (!line.empty() && line.front() != ' '))
        return fail(where, "the log has no version", remedy);
    if (version < 1 || version > kInputLogVersion)
        return fail(
            where, "the log is of version " + std::to_string(version),
            "this program reads versions up to " + std::to_string(kInputLogVersion) + "; use the one that wrote it");
    while (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with(' ')) line.remove_suffix(1);
    Header header{version, std::string(line.substr(0, kMostSettingsBytes + 1))};
    if (!is_settings_line(header.settings))
        return fail(where, "the settings are too long or hold control characters", "write them as one short line");
    return header;
}

// Returns the word that follows the time.
std::string_view kind_on(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r";
    for (int skipped = 0; skipped < 2; ++skipped) {
        line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
        const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
        if (skipped == 1) return word;
        line.remove_prefix(word.size());
    }
    return {};
}

// Reads a line of what the threads did; returns its time.
Result<Nanoseconds> read_threads(ThreadLogReader& threads, std::string_view line, std::size_t number,
                                 const std::string& where) {
    if (line.size() > kMostLineBytes) return fail(where, "the line is longer than any", "take it out");
    BURIN_TRY(words, words_of(line, where));
    const auto time_ns = words.size() < 2 ? std::nullopt : time_of_text(words.front());
    if (!time_ns) return fail(where, "it begins with no time", "begin it with seconds since the session's start");
    BURIN_TRY_DO(threads.take({words.begin() + 1, words.end()}, number, where));
    return *time_ns;
}

// Takes the next line off the text; nothing when no line end is left.
std::optional<std::string_view> take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    return line;
}

Error file_error(const std::string& name, const std::string& what, int code, std::string remedy) {
    return {what + ": " + std::strerror(code), name, std::move(remedy)};
}

}  // namespace

Result<InputLog> parse_input_log(std::string_view text, const std::string& name) {
    InputLog log;
    ThreadLogReader threads;
    std::size_t line_number = 1;
    const auto where = [&] { return name + ":" + std::to_string(line_number); };
    const auto header_line = take_line(text);
    auto header = read_header(header_line.value_or(text.substr(0, 100)), where());
    if (!header) return std::unexpected(header.error());
    if (!header_line) return fail(where(), "the header line has no end", "end it with a line feed");
    log.settings = std::move(header->settings);
    Nanoseconds last_ns = 0;
    while (const auto line = take_line(text)) {
        ++line_number;
        Nanoseconds time_ns = 0;
        if (header->version > 1 && ThreadLogReader::knows(kind_on(*line))) {
            BURIN_TRY(taken, read_threads(threads, *line, line_number, where()));
            time_ns = taken;
        } else {
            BURIN_TRY(event, parse_line(*line, where()));
            if (!event) continue;
            time_ns = event->time_ns;
            event->line = line_number;
            if (std::holds_alternative<FrameStart>(event->input)) threads.frame_begins();
            log.events.push_back(std::move(*event));
        }
        if (time_ns < last_ns)
            return fail(where(),
                        "its time " + text_of_time(time_ns) + " is before " + text_of_time(last_ns) +
                            ", that of the event before",
                        "sort the lines by time");
        last_ns = time_ns;
    }
    ++line_number;
    if (!text.empty())
        log.torn_line = where() + ": the last line has no end and is left out; if it is whole, end it with a line feed";
    log.threads = threads.finish();
    return log;
}

Result<InputLog> read_input_log(const std::filesystem::path& path) {
    BURIN_TRY(text, read_text_file(path, kMostLogBytes));
    return parse_input_log(text, path.string());
}

Result<std::string> input_log_header(const std::string& settings, const std::string& name) {
    if (!is_settings_line(settings))
        return fail(name, "the session's settings do not fit on one line of a log", "shorten them");
    const std::string header = std::string(kMagic) + " " + std::to_string(kInputLogVersion);
    return settings.empty() ? header : header + " " + settings;
}

Result<InputLogWriter> InputLogWriter::create(const std::filesystem::path& path, const std::string& settings) {
    const std::string name = path.string();
    BURIN_TRY(header, input_log_header(settings, name));
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0) {
        const std::string remedy =
            errno == EEXIST ? "name another file, or remove this one first" : "name a place where files can be created";
        return std::unexpected(file_error(name, "the input log cannot be created", errno, remedy));
    }
    InputLogWriter writer;
    writer.name_ = name;
    writer.file_ = file;
    BURIN_TRY_DO(writer.write_line(std::move(header)));
    return writer;
}

InputLogWriter InputLogWriter::into(std::shared_ptr<SessionRecording> recording) {
    InputLogWriter writer;
    writer.name_ = recording->path();
    writer.recording_ = std::move(recording);
    return writer;
}

InputLogWriter::InputLogWriter(InputLogWriter&& other) noexcept
    : recording_(std::move(other.recording_)),
      name_(std::move(other.name_)),
      file_(std::exchange(other.file_, -1)),
      last_ns_(other.last_ns_),
      broken_(other.broken_) {}

InputLogWriter& InputLogWriter::operator=(InputLogWriter&& other) noexcept {
    std::swap(recording_, other.recording_);
    std::swap(name_, other.name_);
    std::swap(file_, other.file_);
    last_ns_ = other.last_ns_;
    broken_ = other.broken_;
    return *this;
}

InputLogWriter::~InputLogWriter() {
    if (file_ >= 0) ::close(file_);
}

Result<void> InputLogWriter::append(const InputEvent& event) {
    if (broken_) return fail(name_, "an earlier event could not be written", "free space on the disk and record anew");
    if (!is_sensible(event.input) || event.time_ns > kLongestSession_ns)
        return fail(name_, "an event is out of range and is not recorded",
                    "look for a tracker or device that sends nonsense");
    BURIN_TRY_DO(come_to(event.time_ns));
    return write_line(line_of(event));
}

Result<void> InputLogWriter::append_threads(Nanoseconds time_ns, const std::string& text) {
    if (broken_) return fail(name_, "an earlier event could not be written", "free space on the disk and record anew");
    BURIN_TRY_DO(come_to(time_ns));
    return write_line(text_of_time(time_ns) + " " + text);
}

Result<void> InputLogWriter::append_frame(Nanoseconds time_ns, const FrameSeen& frame, const StateWords& state) {
    BURIN_CHECK(recording_ != nullptr);
    BURIN_TRY_DO(come_to(time_ns));
    return recording_->frame(time_ns, frame, state);
}

Result<void> InputLogWriter::come_to(Nanoseconds time_ns) {
    if (time_ns < last_ns_) return fail(name_, "an event is before the one before it", "record events in their order");
    last_ns_ = time_ns;
    return {};
}

Result<void> InputLogWriter::write_line(std::string line) {
    if (recording_) return recording_->line(last_ns_, std::move(line));
    line += '\n';
    for (std::string_view rest = line; !rest.empty();) {
        const ssize_t written = ::write(file_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            broken_ = true;
            return std::unexpected(file_error(name_, "the input log cannot be written", written < 0 ? errno : ENOSPC,
                                              "free space on the disk and record anew"));
        }
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

}  // namespace burin::session
