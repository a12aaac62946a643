// SPDX-License-Identifier: MIT
// What is kept from one save, and from one bad moment of the disk, to the next: facts, the name that a journal is of,
// and how much may wait.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "document/journal.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

constexpr std::size_t kChangeBytes = 3000;

class KeptFacts : public testing::Test {
protected:
    void SetUp() override { disk.reset(); }
    void TearDown() override { disk.reset(); }
    static Content content_with(std::map<std::string, std::string> facts) {
        Content content{.facts = std::move(facts)};
        content.parts.push_back({.part = "a thing"});
        content.parts[0].pages = {{{"tile", 0}, std::vector<std::byte>(4000, std::byte{7})}};
        return content;
    }
    static Change one_change() {
        const std::vector<std::byte> bytes(kChangeBytes, std::byte{9});
        return {.part = 0, .pages = {.part = "a thing", .whole = false, .pages = {{{"rays", 0}, bytes}}}};
    }
    static bool becomes(const std::function<bool()>& is_so) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!is_so() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
        return is_so();
    }
    bool saves(DocumentWriter& writer, const std::string& path, Content content, bool changed_alone) {
        writer.save({.path = path, .name = path, .content = std::move(content), .changed_alone = changed_alone});
        writer.finish();
        return writer.take_outcomes().at(0).saved.has_value();
    }
    Workplace at;
    const std::string path = at / "work.burin", journal_path = at / "work-1.burin";
    record::test::FailingDisk& disk = record::test::failing_disk();
};

}  // namespace

TEST_F(KeptFacts, OfSavesThatFailedAreInTheNextThatDoesNotAndTheNewestCount) {
    DocumentWriter writer(disk.kName);
    ASSERT_TRUE(saves(writer, path, content_with({{"old", "0"}, {"both", "0"}}), false));
    for (const char* const mark : {"1", "2"}) {
        disk.is_full = true;
        EXPECT_FALSE(saves(writer, path, content_with({{"first", mark}, {"both", "first"}, {"two", "first"}}), true));
        EXPECT_FALSE(saves(writer, path, content_with({{"second", mark}, {"two", "second"}}), true));
        disk.is_full = false;
        EXPECT_TRUE(saves(writer, path, content_with({{"third", mark}}), true));
        const auto reader = DocumentReader::open(path);
        ASSERT_TRUE(reader);
        for (const auto& [fact, value] : {std::pair<const char*, const char*>{"old", "0"},
                                          {"first", mark},
                                          {"second", mark},
                                          {"third", mark},
                                          {"both", "first"},
                                          {"two", "second"}})
            EXPECT_EQ(reader->fact(fact), value) << fact;
    }
}

// A journal goes on from each save, wherever that went: who comes after a kill finds the name and the file of the last.
TEST_F(KeptFacts, OfAJournalAreOfTheDocumentThatWasSavedLast) {
    for (const int saved : {1, 2, 3}) {
        DocumentWriter writer;
        const std::string own = at / ("journal-" + std::to_string(saved) + ".burin");
        writer.keep_journal(own, content_with({{kJournalNameFact, "nameless.burin"}}));
        std::string name;
        for (int time = 0; time < saved; ++time) {
            name = "saved-" + std::to_string(saved) + "-" + std::to_string(time) + ".burin";
            writer.note(one_change());
            ASSERT_TRUE(saves(writer, at / name, content_with({}), false));
        }
        writer.note(one_change());
        ASSERT_EQ(writer.end_journal(false), own);
        const auto journal = DocumentReader::open(own), document = DocumentReader::open(at / name);
        ASSERT_TRUE(journal && document);
        EXPECT_EQ(journal->fact(kJournalNameFact), name);
        EXPECT_EQ(journal->fact(kJournalOfFact), (at / name));
        EXPECT_EQ(journal->fact(kBaseIdFact), document->version().id);
        EXPECT_EQ(journal->number(kBaseSavesFact), document->version().saves);
        EXPECT_EQ(journal->changes(), 1) << "since the save";
    }
}

// Work that was recovered is unsaved from the first moment on, and no more once it is saved.
TEST_F(KeptFacts, OfRecoveredWorkSayNoMoreThatItIsUnsavedOnceItIsSaved) {
    for (const bool saves_it : {false, true})
        for (const int changes : {0, 2}) {
            const Workplace killed;
            auto journal = Journal::begin(at / ("work-" + std::to_string(changes) + (saves_it ? "s.burin" : ".burin")),
                                          content_with({{kJournalNameFact, "work.burin"}, {kUnsavedFact, "1"}}));
            ASSERT_TRUE(journal);
            for (int i = 0; i < changes; ++i) ASSERT_TRUE(journal->add({one_change()}));
            EXPECT_TRUE(journal->is_needed());
            if (saves_it) {
                ASSERT_TRUE(journal->take_over(content_with({{kJournalNameFact, "work.burin"}})));
            }
            EXPECT_EQ(journal->is_needed(), !saves_it);
            // As a kill leaves it.
            for (const auto& file : std::filesystem::directory_iterator(at / ""))
                std::filesystem::copy_file(file.path(), killed / file.path().filename().string());
            EXPECT_EQ(left_journals((killed / "").string()).size(), saves_it ? 0u : 1u) << changes;
            journal->discard();
            journal->end();
        }
}

// What may wait for a disk that is full is bounded each time anew.
TEST_F(KeptFacts, LeaveRoomForWhatWaitsEachTimeThatTheDiskIsFull) {
    constexpr std::int64_t kWaiting = 4;
    DocumentWriter writer(disk.kName, std::chrono::milliseconds(2), (kWaiting + 1) * kChangeBytes);
    writer.keep_journal(journal_path, content_with({{kJournalNameFact, "work.burin"}}));
    std::int64_t number = 0;
    for (int time = 0; time < 4; ++time) {
        for (int i = 0; i < 3; ++i, ++number) writer.note(one_change());
        ASSERT_TRUE(becomes([&] { return writer.safe_up_to() == number; })) << time;
        disk.is_full = true;
        for (int i = 0; i < kWaiting; ++i, ++number) {
            writer.note(one_change());
            writer.finish();
        }
        disk.is_full = false;
        ASSERT_TRUE(becomes([&] { return writer.safe_up_to() == number; })) << time;
        EXPECT_FALSE(writer.wants_all()) << time;
    }
    EXPECT_EQ(writer.end_journal(false), journal_path);
    const auto journal = DocumentReader::open(journal_path);
    ASSERT_TRUE(journal);
    EXPECT_EQ(journal->changes(), number);
}

}  // namespace burin::document
