// SPDX-License-Identifier: MIT
#include "study/folder/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>
#include <set>

#include "base/append_file.hpp"
#include "base/flush_folder.hpp"
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

constexpr const char *kWordsKey = "words_sha256", *kSaltKey = "salt";
constexpr char kBeforeWords = '\t';  // stands in no JSON on one line

bool is_entry(const Json& value) {
    return value.is_object() && value.contains("event") && value["event"].is_string() && value.contains("time") &&
           value["time"].is_string();
}

std::string text_of(const Json& value, const char* key) {
    const auto found = value.find(key);
    return found != value.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool is_true(const Json& value, const char* key) {
    const auto found = value.find(key);
    return found != value.end() && found->is_boolean() && found->get<bool>();
}

std::string dumped(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string drawn_salt() {
    std::random_device device;
    return formatted("%08x%08x%08x%08x", device(), device(), device(), device());
}

// What stays of an entry about a participant when the words are erased: that there was one in this group, and that they
// have withdrawn; how many places of each list were taken until then; and that a learner was no person.
Json public_part(const Json& value) {
    Json kept{{"participant", value["participant"]}};
    const std::string event = text_of(value, "event");
    const auto keep = [&](const char* key) {
        if (value.contains(key)) kept[key] = value[key];
    };
    if (event == "enrolled" || event == "withdrawn") keep("event");
    if (event == "enrolled") keep("group");
    if (event == "enrolled" && is_true(value, "simulated")) keep("simulated");
    if (event == "withdrawn") {
        keep("erase");
        keep("places_taken");
    }
    return kept;
}

// A line, taken apart; the digest is empty where the line has none.
struct JournalText {
    std::string digest, open, words;
    bool has_words = false;
};
JournalText taken_apart(std::string_view line) {
    JournalText parts;
    parts.digest = line.substr(0, kDigestLetters);
    if (!is_digest(parts.digest) || line.size() <= kDigestLetters || line[kDigestLetters] != ' ') {
        if (!is_digest(parts.digest)) parts.digest.clear();
        return parts;
    }
    std::string_view rest = line.substr(kDigestLetters + 1);
    const std::size_t tab = rest.find(kBeforeWords);
    parts.open = rest.substr(0, tab);
    parts.has_words = tab != std::string_view::npos;
    if (parts.has_words) parts.words = rest.substr(tab + 1);
    return parts;
}

// The entry that a chained line holds; not an object where its words are others than PUBLIC says.
Json entry_of(const JournalText& line) {
    Json open = Json::parse(line.open, nullptr, false);
    if (!open.is_object()) return {};
    if (!line.has_words) {
        open.erase(kWordsKey);
        return open;
    }
    if (sha256(line.words) != text_of(open, kWordsKey)) return {};  // also where PUBLIC names none
    Json words = Json::parse(line.words, nullptr, false);
    if (words.is_object()) words.erase(kSaltKey);
    return words;
}

// Of lines whose words are gone: only an erased participant's may be.
void find_lost_words(Journal& journal, const std::vector<std::size_t>& without) {
    std::set<std::string> erased;
    for (const JournalEntry& entry : journal.entries)
        if (text_of(entry.value, "event") == "withdrawn" && is_true(entry.value, "erase"))
            erased.insert(text_of(entry.value, "participant"));
    for (const std::size_t line : without) {
        const auto entry = std::ranges::find(journal.entries, line, &JournalEntry::line);
        if (erased.contains(text_of(entry->value, "participant"))) continue;
        journal.faults.push_back({line, "has lost its words, and its participant was never erased",
                                  "restore the journal from a copy; until then the line is passed over"});
        journal.entries.erase(entry);
    }
    std::ranges::stable_sort(journal.faults, {}, &JournalFault::line);
}

}  // namespace

std::string journal_line(const std::string& previous_digest, const Json& value) {
    std::string open = dumped(value), words;
    if (!text_of(value, "participant").empty()) {
        Json salted = value;
        salted[kSaltKey] = drawn_salt();
        words = dumped(salted);
        Json kept = public_part(value);
        kept[kWordsKey] = sha256(words);
        open = dumped(kept);
        words.insert(words.begin(), kBeforeWords);
    }
    return sha256(previous_digest + open) + " " + open + words + "\n";
}

std::string without_words(std::string_view text, const std::string& participant) {
    const std::string quoted = "\"" + participant + "\"";
    std::string kept;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        const std::string_view ending = text.substr(end, 1);
        text.remove_prefix(std::min(end + 1, text.size()));
        const JournalText parts = taken_apart(line);
        const Json open = Json::parse(parts.open, nullptr, false);
        if (open.is_object() && text_of(open, "participant") == participant && open.contains(kWordsKey))
            kept += parts.digest + " " + parts.open;
        else if (!open.is_object() && line.contains(quoted))
            kept += parts.digest;
        else
            kept += line;
        kept += ending;
    }
    return kept;
}

Journal parse_journal(std::string_view text) {
    Journal journal;
    journal.last_digest = kNoDigest;
    journal.ends_within_line = !text.empty() && text.back() != '\n';
    std::string stated = kNoDigest;      // by the line before, good or not
    std::string last_sound = kNoDigest;  // of the last good line that is not without its words, as a torn one may be
    std::string latest_time;
    std::vector<std::size_t> without;  // words
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view now = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const JournalText parts = taken_apart(now);
        const auto follows = [&](const std::string& before) { return sha256(before + parts.open) == parts.digest; };
        const bool chained =
            !parts.digest.empty() && (follows(stated) || follows(journal.last_digest) || follows(last_sound));
        if (!parts.digest.empty()) stated = parts.digest;
        const Json value = chained ? entry_of(parts) : Json();
        const bool erased = !parts.has_words && end != std::string_view::npos && value.is_object() &&
                            !text_of(value, "participant").empty();
        if (!chained || !(erased || is_entry(value))) {
            const bool torn = end == std::string_view::npos;
            journal.faults.push_back(
                {line,
                 torn ? "was not written to its end" : "does not match its digest: it, or the line before, was changed",
                 torn ? "it is passed over, and what it told is done again"
                      : "restore the journal from a copy; until then the line is passed over"});
            continue;
        }
        if (erased)
            without.push_back(line);
        else
            last_sound = parts.digest;
        const std::string time = text_of(value, "time");
        if (!time.empty() && time < latest_time)
            journal.notes.push_back(formatted("line %zu: the clock went back, from %s to %s", line,
                                              latest_time.substr(0, 40).c_str(), time.substr(0, 40).c_str()));
        latest_time = std::max(latest_time, time);
        journal.last_digest = parts.digest;
        journal.entries.push_back({line, value, parts.has_words});
    }
    find_lost_words(journal, without);
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
    if (const Appended appended = append_whole(handle, bytes); appended.error != 0) {
        journal.ends_within_line = journal.ends_within_line || appended.has_begun;
        errno = appended.error;
        done = failed("cannot be written");
    }
    if (done && ::fdatasync(handle) != 0) done = failed("cannot be synced to the disk");
    ::close(handle);
    if (!done) return done;
    if (journal.entries.empty()) flush_folder_of(file);  // its first line: the file may be new
    const std::size_t number = journal.entries.empty() ? 1 : journal.entries.back().line + 1;
    const bool has_words = !text_of(value, "participant").empty();
    journal.entries.push_back({number, std::move(value), has_words});
    journal.last_digest = line.substr(0, kDigestLetters);
    journal.ends_within_line = false;
    return {};
}

}  // namespace burin::study
