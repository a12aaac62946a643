// SPDX-License-Identifier: MIT
#include "study/folder/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "base/sha256.hpp"
#include "base/text.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kDigestLetters = 64;
const std::string kNoDigest(kDigestLetters, '0');

std::string now_utc() {
    const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    std::tm parts{};
    ::gmtime_r(&seconds, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    return text.data() + formatted(".%03dZ", static_cast<int>(now.time_since_epoch().count() % 1000));
}

bool is_digest(std::string_view text) {
    return text.size() == kDigestLetters && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_entry(const Json& value) {
    return value.is_object() && value.contains("event") && value["event"].is_string() && value.contains("time") &&
           value["time"].is_string();
}

}  // namespace

std::string journal_line(const std::string& previous_digest, const Json& value) {
    const std::string json = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return sha256(previous_digest + json) + " " + json + "\n";
}

Journal parse_journal(std::string_view text) {
    Journal journal;
    journal.last_digest = kNoDigest;
    journal.ends_within_line = !text.empty() && text.back() != '\n';
    std::string stated = kNoDigest;  // by the line before, good or not
    std::string latest_time;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view now = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string digest(now.substr(0, kDigestLetters));
        const std::string json(now.size() > kDigestLetters ? now.substr(kDigestLetters + 1) : std::string_view());
        const bool chained = is_digest(digest) && now.size() > kDigestLetters && now[kDigestLetters] == ' ' &&
                             (sha256(stated + json) == digest || sha256(journal.last_digest + json) == digest);
        if (is_digest(digest)) stated = digest;
        const Json value = chained ? Json::parse(json, nullptr, false) : Json();
        if (!chained || !is_entry(value)) {
            const bool torn = end == std::string_view::npos;
            journal.faults.push_back(
                {line,
                 torn ? "was not written to its end" : "does not match its digest: it, or the line before, was changed",
                 torn ? "nothing: it is passed over, and what it told is done again"
                      : "restore the journal from a copy; until then the line is passed over"});
            continue;
        }
        const std::string time = value["time"].get<std::string>();
        if (time < latest_time)
            journal.notes.push_back(formatted("line %zu: the clock went back, from %s to %s", line,
                                              latest_time.substr(0, 40).c_str(), time.substr(0, 40).c_str()));
        latest_time = std::max(latest_time, time);
        journal.last_digest = digest;
        journal.entries.push_back({line, value});
    }
    return journal;
}

Result<void> append(const std::filesystem::path& file, Journal& journal, Json value) {
    value["time"] = now_utc();
    const std::string line = journal_line(journal.last_digest, value);
    const std::string bytes = (journal.ends_within_line ? "\n" : "") + line;
    const auto failed = [&](const char* what) {
        return fail(file.string(), std::string(what) + ": " + std::strerror(errno),
                    "make room on the disk or see to its permissions; what was written before is kept");
    };
    const int handle = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
    if (handle < 0) return failed("cannot be opened");
    Result<void> done;
    for (std::string_view rest = bytes; !rest.empty() && done;) {
        const ssize_t written = ::write(handle, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            journal.ends_within_line = journal.ends_within_line || rest.size() < bytes.size();
            done = failed("cannot be written");
        } else {
            rest.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    if (done && ::fdatasync(handle) != 0) done = failed("cannot be synced to the disk");
    ::close(handle);
    if (!done) return done;
    const std::size_t number = journal.entries.empty() ? 1 : journal.entries.back().line + 1;
    journal.entries.push_back({number, std::move(value)});
    journal.last_digest = line.substr(0, kDigestLetters);
    journal.ends_within_line = false;
    return {};
}

}  // namespace burin::study
