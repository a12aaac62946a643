// SPDX-License-Identifier: MIT
// A study's journal: lines that are only ever appended, "DIGEST PUBLIC" or "DIGEST PUBLIC<tab>WORDS", PUBLIC and WORDS
// being JSON. DIGEST is the SHA-256 of the digest of the line before (64 zeros for the first) and of PUBLIC as it
// stands. So a line that is edited, put in or taken out is found; lines cut off the end are not, unless the last digest
// was noted elsewhere (burin study status prints it).
//
// An entry about a participant is WORDS: all of it, time included, and a salt of 128 random bits. Its PUBLIC is what
// stays for ever: the participant's code, the SHA-256 of WORDS, and of enrolment and withdrawal what others need. Words
// can be erased with the chain as whole as before: no digest of a line covers them but by theirs, and the salt keeps
// anybody from guessing them from that. Where words are gone and nobody of that code was erased, the line is damaged.
//
// A power cut leaves at most one torn line. The next line chains to the last good one, and the torn one stays.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::study {

struct JournalEntry {
    std::size_t line = 0;  // from 1
    // An object with "event" and "time", both texts; of a line whose words were erased, PUBLIC without the digest.
    Json value;
    bool has_words = false;
};

struct JournalFault {
    std::size_t line = 0;
    std::string what, remedy;
};

// What is good of a journal, and what is not. Pure.
struct Journal {
    std::vector<JournalEntry> entries;
    std::vector<JournalFault> faults;  // damage: these lines are not used
    std::vector<std::string> notes;    // a clock that went back
    std::string last_digest;           // of the last good line
    bool ends_within_line = false;
};
[[nodiscard]] Journal parse_journal(std::string_view text);
// Salts the words of an entry about a participant from the system's randomness.
[[nodiscard]] std::string journal_line(const std::string& previous_digest, const Json& value);
// Returns the journal without the words about a participant; also of damaged lines that hold the code, whose digest
// alone stays. Pure.
[[nodiscard]] std::string without_words(std::string_view text, const std::string& participant);

inline constexpr std::uint64_t kMostJournalBytes = std::uint64_t{64} << 20;

// Appends an entry with the present time and syncs it to the disk before it returns; the journal in memory follows.
// The folder's lock must be held.
[[nodiscard]] Result<void> append(const std::filesystem::path& file, Journal& journal, Json value);

}  // namespace burin::study
