// SPDX-License-Identifier: MIT
// The journal by itself: what it finds, where it goes on, and what stays of who is erased.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/sha256.hpp"
#include "study/folder/journal.hpp"
#include "tests/study/short_study.hpp"
#include "tests/support/flush_log.hpp"

namespace burin::study {
namespace {

std::string three_lines() {
    std::string text, digest(64, '0');
    for (const char* event : {"one", "two", "three"}) {
        const std::string line = journal_line(digest, Json{{"event", event}, {"time", "2026-11-25T10:00:00Z"}});
        digest = line.substr(0, 64);
        text += line;
    }
    return text;
}

TEST(StudyJournal, NamesAnEditedLineAndUsesTheOthers) {
    std::string text = three_lines();
    text.replace(text.find("two"), 3, "TWO");
    const Journal journal = parse_journal(text);
    ASSERT_EQ(journal.faults.size(), 1u);
    EXPECT_EQ(journal.faults[0].line, 2u);
    ASSERT_EQ(journal.entries.size(), 2u);
    EXPECT_EQ(journal.entries[1].value["event"], "three");
}

TEST(StudyJournal, FindsALineThatWasTakenOutOrMoved) {
    const std::string text = three_lines();
    const std::size_t second = text.find('\n') + 1, third = text.find('\n', second) + 1;
    EXPECT_EQ(parse_journal(text).faults.size(), 0u);
    const Journal cut = parse_journal(text.substr(0, second) + text.substr(third));
    ASSERT_EQ(cut.faults.size(), 1u);
    EXPECT_EQ(cut.faults[0].line, 2u);
    EXPECT_FALSE(parse_journal(text.substr(0, second) + text.substr(third) + text.substr(second, third - second))
                     .faults.empty());
}

TEST(StudyJournal, GoesOnBehindALineThatAPowerCutTore) {
    const Workplace place;
    const std::string whole = three_lines();
    for (const std::size_t missing : {1u, 5u, 60u, 100u}) {
        place.write("journal", whole.substr(0, whole.size() - missing));
        Journal journal = parse_journal(place.read("journal"));
        ASSERT_TRUE(append(place / "journal", journal, Json{{"event", "four"}}));
        ASSERT_TRUE(append(place / "journal", journal, Json{{"event", "five"}}));
        const Journal again = parse_journal(place.read("journal"));
        EXPECT_EQ(again.faults.size(), missing == 1u ? 0u : 1u) << missing;
        ASSERT_GE(again.entries.size(), 4u) << missing;
        EXPECT_EQ(again.entries.back().value["event"], "five");
        EXPECT_TRUE(place.read("journal").starts_with(whole.substr(0, whole.size() - missing)));
    }
}

TEST(StudyJournal, IsOnTheDiskWithEachLineAndInItsFolderWithTheFirst) {
    const Workplace place;
    const std::string path = std::filesystem::weakly_canonical(place / "journal").string();
    Journal journal;
    for (const char* event : {"one", "two"}) {
        const bool is_first = journal.entries.empty();
        forget_flushes();
        ASSERT_TRUE(append(place / "journal", journal, Json{{"event", event}}));
        const std::vector<Flushed> all = all_flushes();
        ASSERT_EQ(all.size(), is_first ? 2u : 1u);
        EXPECT_EQ(all[0].path, path);
        EXPECT_FALSE(all[0].is_folder);
        if (!is_first) break;
        EXPECT_TRUE(all[1].is_folder);
        EXPECT_EQ(all[1].names, std::vector<std::string>{"journal"});
    }
    EXPECT_EQ(journal.entries.size(), 2u);
}

TEST(StudyJournal, TellsOfAClockThatWentBack) {
    std::string digest(64, '0');
    const std::string first = journal_line(digest, Json{{"event", "a"}, {"time", "2026-11-25T10:00:00Z"}});
    const std::string text =
        first + journal_line(first.substr(0, 64), Json{{"event", "b"}, {"time", "2026-11-24T10:00:00Z"}});
    const Journal journal = parse_journal(text);
    EXPECT_EQ(journal.entries.size(), 2u);
    ASSERT_EQ(journal.notes.size(), 1u);
    EXPECT_TRUE(journal.notes[0].contains("line 2"));
}

// Two people's lines by turns, and one of nobody.
std::string lines_of_two() {
    std::string text, digest(64, '0');
    std::size_t number = 0;
    for (const char* id : {"", "p01", "p02", "p01", "p02"}) {
        Json value{{"event", number == 0 ? "study made" : number < 3 ? "enrolled" : "note"}};
        if (*id != '\0') value["participant"] = id;
        value["group"] = "touch";
        value["text"] = std::string("of ") + id;
        value["time"] = formatted("2026-11-25T10:00:0%zuZ", number++);
        const std::string line = journal_line(digest, value);
        digest = line.substr(0, 64);
        text += line;
    }
    return text;
}

TEST(StudyJournal, KeepsItsChainWhenTheWordsAboutAParticipantAreErased) {
    std::string text = lines_of_two();
    text += erasure_of("p01", text);
    ASSERT_TRUE(parse_journal(text).faults.empty());
    const std::string kept = without_words(text, "p01");
    for (const char* word : {"of p01", "10:00:01", "10:00:03", "11:00:00"}) EXPECT_FALSE(kept.contains(word)) << word;
    for (const char* word : {"of p02", "10:00:02", "10:00:04"}) EXPECT_TRUE(kept.contains(word)) << word;
    const Journal journal = parse_journal(kept);
    EXPECT_TRUE(journal.faults.empty());
    EXPECT_EQ(journal.last_digest, parse_journal(text).last_digest);
    ASSERT_EQ(journal.entries.size(), 6u);
    EXPECT_EQ(journal.entries[1].value, (Json{{"participant", "p01"}, {"event", "enrolled"}, {"group", "touch"}}));
    EXPECT_EQ(journal.entries[3].value, (Json{{"participant", "p01"}}));
    EXPECT_EQ(journal.entries[4].value["text"], "of p02");
    EXPECT_EQ(without_words(kept, "p01"), kept);
    // The journal goes on.
    const Workplace place;
    place.write("journal", kept);
    Journal more = journal;
    ASSERT_TRUE(append(place / "journal", more, Json{{"event", "note"}, {"participant", "p02"}, {"text", "later"}}));
    EXPECT_TRUE(parse_journal(place.read("journal")).faults.empty());
}

TEST(StudyJournal, FindsWordsThatWereTakenOutOrChangedAndNobodyErased) {
    const std::string text = lines_of_two();
    const Journal lost = parse_journal(without_words(text + erasure_of("p01", text), "p02"));
    ASSERT_EQ(lost.faults.size(), 2u) << "another's erasure gives no leave";
    EXPECT_EQ(lost.faults[0].line, 3u);
    EXPECT_TRUE(lost.faults[0].what.contains("has lost its words")) << lost.faults[0].what;
    for (const char* word : {"of p02", "10:00:04", "\"touch\",\"text\":\"of p01"}) {
        std::string edited = text;
        edited[edited.find(word) + 1] = 'X';
        EXPECT_EQ(parse_journal(edited).faults.size(), 1u) << word;
    }
}

TEST(StudyJournal, TellsNothingOfErasedWordsByTheirDigest) {
    const Json value{{"event", "note"}, {"participant", "p01"}, {"text", "yes"}, {"time", "2026-11-25T10:00:00Z"}};
    const std::string one = journal_line(std::string(64, '0'), value), two = journal_line(std::string(64, '0'), value);
    EXPECT_NE(one.substr(0, one.find('\t')), two.substr(0, two.find('\t'))) << "the salt is drawn for each";
    EXPECT_FALSE(one.substr(0, one.find('\t')).contains(sha256(value.dump())));
}

TEST(StudyJournal, GoesOnBehindALineThatLostItsWordsToAPowerCut) {
    const Workplace place;
    const std::string whole = lines_of_two();
    const std::size_t last = whole.rfind('\t');
    for (const std::size_t kept : {last, last + 1, last + 20, whole.size() - 1}) {
        place.write("journal", whole.substr(0, kept));
        Journal journal = parse_journal(place.read("journal"));
        const Json next{{"event", "note"}, {"participant", "p01"}, {"text", "again"}};
        for (int i = 0; i < 2; ++i) ASSERT_TRUE(append(place / "journal", journal, next));
        const Journal again = parse_journal(place.read("journal"));
        EXPECT_EQ(again.faults.size(), kept == whole.size() - 1 ? 0u : 1u) << kept;
        ASSERT_GE(again.entries.size(), 6u) << kept;
        EXPECT_EQ(again.entries.back().value["text"], "again");
        EXPECT_EQ(again.entries[again.entries.size() - 2].value["text"], "again");
    }
}

}  // namespace
}  // namespace burin::study
