// SPDX-License-Identifier: MIT
// Documents as files: what is written is read, what is damaged is told, and nothing is overwritten or half written.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "record/store_reading.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytes_of(std::string_view text, std::size_t times = 1) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < times; ++i)
        for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    return bytes;
}

Content small_work() {
    Content content{.facts = {{"source", "ball:0.1"}}, .commands = {"tool ball:0.01", "operation fill"}};
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"head", 0}, bytes_of("h")}, {{"tile", 0}, bytes_of("ab", 500)}, {{"tile", 1}, {}}};
    return content;
}

// Bytes that no compression makes small.
std::vector<std::byte> noise(std::size_t size, std::int64_t seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::vector<std::byte> bytes(size);
    for (std::byte& b : bytes) b = static_cast<std::byte>(random());
    return bytes;
}

Content changed_tile(std::string_view text) {
    Content content;
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"tile", 0}, bytes_of(text)}};
    return content;
}

scene::Pages pages_in(const std::string& path) {
    Result<DocumentReader> reader = DocumentReader::open(path);
    EXPECT_TRUE(reader) << reader.error().line();
    Result<scene::Pages> pages = reader->pages_of("a thing");
    EXPECT_TRUE(pages) << pages.error().line();
    return *pages;
}

std::string why_not(const std::string& path) {
    const Result<DocumentReader> reader = DocumentReader::open(path);
    return reader ? "" : reader.error().line();
}

// Runs SQL on a document.
void change(const std::string& path, const std::string& sql) {
    Result<record::Database> database = record::Database::open(path, record::Database::Use::write);
    ASSERT_TRUE(database);
    const auto done = database->run(sql);
    ASSERT_TRUE(done) << done.error().line();
}

std::size_t files_in(const Workplace& at) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(at / ""), fs::directory_iterator()));
}

class Document : public testing::Test {
protected:
    void SetUp() override { record::test::failing_disk().reset(); }
    void TearDown() override { record::test::failing_disk().reset(); }
    bool is_saved_by(DocumentWriter& writer, Content content, bool changed_alone) const {
        writer.save({.path = path, .name = "work", .content = std::move(content), .changed_alone = changed_alone});
        writer.finish();
        return static_cast<bool>(writer.take_outcomes().at(0).saved);
    }
    Workplace at;
    std::string path = (at / "work.burin").string();
};

}  // namespace

TEST_F(Document, HoldsWhatWasSaved) {
    const Content work = small_work();
    const Result<Saved> saved = write_document(path, work, Place::nothing);
    ASSERT_TRUE(saved) << saved.error().line();
    EXPECT_EQ(saved->pages, 3u);
    Result<DocumentReader> reader = DocumentReader::open(path);
    ASSERT_TRUE(reader) << reader.error().line();
    EXPECT_EQ(reader->fact("source"), "ball:0.1");
    EXPECT_EQ(reader->commands(), work.commands);
    EXPECT_EQ(reader->version(), saved->version);
    ASSERT_EQ(reader->parts().size(), 1u);
    EXPECT_EQ(reader->parts()[0].bytes, 1001u);
    const Result<scene::Pages> pages = reader->pages_of("a thing");
    ASSERT_TRUE(pages);
    EXPECT_EQ(pages->pages, work.parts[0].pages);
    EXPECT_TRUE(pages->damaged.empty());
    EXPECT_EQ(files_in(at), 1u) << "one file, which travels alone";
}

TEST_F(Document, TakesWhatHasChangedAndKeepsTheRest) {
    const Result<Saved> first = write_document(path, small_work(), Place::nothing);
    ASSERT_TRUE(first);
    const Result<Saved> second = update_document(path, changed_tile("new"), first->version);
    ASSERT_TRUE(second) << second.error().line();
    EXPECT_EQ(second->version, (Version{first->version.id, 2}));
    auto expected = small_work().parts[0].pages;
    expected[{"tile", 0}] = bytes_of("new");
    EXPECT_EQ(pages_in(path).pages, expected);
    EXPECT_EQ(files_in(at), 1u);
}

TEST_F(Document, IsNeverOverwrittenUnlessThatIsAsked) {
    at.write("work.burin", "mine");
    const Result<Saved> refused = write_document(path, small_work(), Place::nothing);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("never overwrites")) << refused.error().line();
    EXPECT_EQ(at.read("work.burin"), "mine");
    const Result<Saved> replaced = write_document(path, small_work(), Place::replaced);
    ASSERT_TRUE(replaced);
    EXPECT_TRUE(replaced->replaced);
    EXPECT_EQ(pages_in(path).pages.size(), 3u);
}

TEST_F(Document, OfTwoWindowsIsNotSavedOverTheOthersWork) {
    const Result<Saved> first = write_document(path, small_work(), Place::nothing);
    ASSERT_TRUE(first);
    ASSERT_TRUE(update_document(path, changed_tile("theirs"), first->version));
    const Result<Saved> mine = update_document(path, changed_tile("mine"), first->version);
    ASSERT_FALSE(mine);
    EXPECT_TRUE(mine.error().line().contains("another window")) << mine.error().line();
    EXPECT_EQ(pages_in(path).pages.at({"tile", 0}), bytes_of("theirs"));
}

TEST_F(Document, ThatRefusesASaveStaysAsItWasToTheByte) {
    const Result<Saved> first = write_document(path, small_work(), Place::nothing);
    ASSERT_TRUE(first);
    ASSERT_TRUE(update_document(path, changed_tile("theirs"), first->version));
    const std::string before = at.read("work.burin");
    ASSERT_FALSE(update_document(path, changed_tile("mine"), first->version));
    EXPECT_EQ(at.read("work.burin"), before);
    EXPECT_EQ(files_in(at), 1u);
    // One that a kill has left with a log is brought to rest.
    change(path, "PRAGMA journal_mode = WAL");
    ASSERT_FALSE(update_document(path, changed_tile("mine"), first->version));
    EXPECT_EQ(at.read("work.burin").substr(18, 2), "\1\1");
    EXPECT_EQ(files_in(at), 1u);
    EXPECT_EQ(pages_in(path).pages.at({"tile", 0}), bytes_of("theirs"));
}

TEST_F(Document, IsRefusedKindlyWhereItIsNone) {
    EXPECT_TRUE(why_not(path).contains("check the path")) << why_not(path);
    at.write("work.burin", "");
    EXPECT_TRUE(why_not(path).contains("is empty")) << why_not(path);
    at.write("work.burin", "\n");
    EXPECT_TRUE(why_not(path).contains("is not an SQLite file: it has 1 byte")) << why_not(path);
    at.write("work.burin", std::string(5000, 'x'));
    EXPECT_TRUE(why_not(path).contains("is not an SQLite file")) << why_not(path);
    EXPECT_TRUE(why_not(path).contains("a document that burin has saved")) << why_not(path);
    fs::remove(path);
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    change(path, "PRAGMA user_version = 2");
    EXPECT_TRUE(why_not(path).contains("newer Burin")) << why_not(path);
    change(path, "PRAGMA user_version = 1; PRAGMA application_id = 7");
    EXPECT_TRUE(why_not(path).contains("another program")) << why_not(path);
}

TEST_F(Document, WhoseTableIsAViewIsRefused) {
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    change(path, "DROP TABLE command; CREATE VIEW command AS SELECT 1 AS at, 'tool ball:1' AS text");
    EXPECT_TRUE(why_not(path).contains("no table command")) << why_not(path);
}

TEST_F(Document, ThatWasCutOffIsToldAndNotRead) {
    Content work = small_work();
    for (int tile = 2; tile < 200; ++tile) {
        std::vector<std::byte> bytes;
        for (int i = 0; i < 1000; ++i) bytes.push_back(static_cast<std::byte>((i * i * (tile + 3)) >> 5));
        work.parts[0].pages[{"tile", tile}] = bytes;
    }
    ASSERT_TRUE(write_document(path, work, Place::nothing));
    const auto whole = fs::file_size(path);
    for (const double share : {0.9, 0.5, 0.1}) {
        fs::resize_file(path, static_cast<std::uintmax_t>(share * static_cast<double>(whole)));
        Result<DocumentReader> reader = DocumentReader::open(path);
        if (!reader) continue;  // with a reason
        const Result<scene::Pages> pages = reader->pages_of("a thing");
        EXPECT_TRUE(!pages || !pages->damaged.empty());
    }
}

TEST_F(Document, OpensWithoutAPageThatIsDamagedAndNamesIt) {
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    change(path, "UPDATE page SET crc = crc + 1 WHERE kind = 'tile' AND number = 0");
    const scene::Pages pages = pages_in(path);
    EXPECT_EQ(pages.damaged, (std::vector<scene::PageName>{{"tile", 0}}));
    EXPECT_EQ(pages.pages.size(), 2u);
    // One that claims more than its data hold is no reason to allocate.
    change(path, "UPDATE page SET bytes = 60000000 WHERE kind = 'tile' AND number = 1");
    EXPECT_EQ(pages_in(path).damaged.size(), 2u);
}

TEST_F(Document, WhoseLogWasTakenAwayIsReadAloneAndThatIsTold) {
    path = (at / "50%41?a#b.burin").string();
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    EXPECT_FALSE(record::lacks_its_log(path));
    change(path, "PRAGMA journal_mode = WAL");  // and SQLite takes the log away at the end
    EXPECT_TRUE(record::lacks_its_log(path));
    EXPECT_EQ(pages_in(path).pages, small_work().parts[0].pages);
    EXPECT_EQ(files_in(at), 1u) << "no log and no memory of one is left beside it";
}

TEST_F(Document, OnAFullDiskStaysAsItWas) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    const Result<Saved> first = write_document(path, small_work(), Place::nothing);
    ASSERT_TRUE(first);
    const std::string before = at.read("work.burin");
    disk.is_full = true;
    const auto update = update_document(path, changed_tile("new"), first->version, disk.kName);
    ASSERT_FALSE(update);
    EXPECT_TRUE(update.error().line().contains("save to another disk")) << update.error().line();
    const auto anew = write_document(path, small_work(), Place::replaced, disk.kName);
    ASSERT_FALSE(anew);
    EXPECT_TRUE(anew.error().line().contains("work.burin: the disk is full")) << anew.error().line();
    disk.is_full = false;
    EXPECT_EQ(pages_in(path).pages, small_work().parts[0].pages);
    EXPECT_EQ(at.read("work.burin"), before);
    EXPECT_EQ(files_in(at), 1u) << "and leaves nothing beside it";
    ASSERT_TRUE(update_document(path, changed_tile("new"), first->version));
}

// Whichever flush it is that finds no more room, that of the file when it is closed among them.
TEST_F(Document, LeavesNothingBesideItWhereverTheDiskFillsUp) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    const auto fill_up_at = [&disk](int flush) {
        disk.reset();
        disk.set_before_sync([&disk, flush] { disk.is_full = disk.is_full || disk.syncs >= flush; });
    };
    Content large = small_work();
    for (std::int64_t tile = 2; tile < 40; ++tile) large.parts[0].pages[{"tile", tile}] = noise(5000, tile);
    int refused = 0;
    for (bool fits = false; !fits; ++refused) {
        fill_up_at(refused);
        fits = static_cast<bool>(write_document(path, large, Place::nothing, disk.kName));
        EXPECT_EQ(files_in(at), fits ? 1u : 0u) << refused;
        ASSERT_LT(refused, 100);
    }
    EXPECT_GT(refused, 2) << "else the disk was never full while it was written";
    disk.reset();
    fs::remove(path);
    bool fits = false;
    for (int flush = 0; !fits; ++flush) {
        const auto first = write_document(path, small_work(), Place::replaced);
        ASSERT_TRUE(first) << first.error().line();
        fill_up_at(flush);
        const auto update = update_document(path, large, first->version, disk.kName);
        const bool never_full = !disk.is_full;
        disk.reset();
        EXPECT_EQ(pages_in(path).pages, update ? large.parts[0].pages : small_work().parts[0].pages) << flush;
        EXPECT_FALSE(record::lacks_its_log(path)) << flush;
        EXPECT_TRUE(update || !fs::exists(path + "-wal") || fs::file_size(path + "-wal") == 0) << flush;
        fits = update && never_full;
        ASSERT_LT(flush, 100);
    }
}

TEST_F(Document, ThatTakesThePlaceOfOneWithALogIsNotChangedByIt) {
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    change(path, "PRAGMA journal_mode = WAL");
    for (const char* const ending : {"-wal", "-shm", "-journal"}) at.write("work.burin" + std::string(ending), "left");
    Content other = small_work();
    other.parts[0].pages[{"tile", 7}] = bytes_of("other");
    const Result<Saved> saved = write_document(path, other, Place::replaced);
    ASSERT_TRUE(saved) << saved.error().line();
    EXPECT_EQ(files_in(at), 1u);
    EXPECT_EQ(pages_in(path).pages, other.parts[0].pages);
}

TEST_F(Document, RemovesWhatAKilledSaveHasLeftAndNothingElse) {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const std::string dead = std::to_string(child), alive = std::to_string(::getppid());
    const pid_t second = fork();
    if (second == 0) _exit(0);
    ASSERT_EQ(waitpid(second, nullptr, 0), second);
    for (const char* const ending : {"", "-wal", "-shm"}) at.write("work.burin.saving-" + dead + ending, "half");
    at.write("work.burin.saving-" + std::to_string(second) + "-wal", "a log without its file");
    const std::vector<std::string> others{"work.burin.saving-" + alive, "work.burin.saving-" + dead + "x",
                                          "other.burin.saving-" + dead, "work.burin.saving-"};
    for (const std::string& name : others) at.write(name, "mine");
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    EXPECT_EQ(files_in(at), 1 + others.size());
    for (const std::string& name : others) EXPECT_EQ(at.read(name), "mine") << name;
}

TEST_F(Document, InAFolderThatTakesNoFilesStaysAsItWas) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write anywhere";
    ASSERT_TRUE(write_document(path, small_work(), Place::nothing));
    fs::permissions(at / "", fs::perms::owner_read | fs::perms::owner_exec);
    const auto anew = write_document(path, small_work(), Place::replaced);
    fs::permissions(at / "", fs::perms::owner_all);
    ASSERT_FALSE(anew);
    EXPECT_TRUE(anew.error().line().contains("may write to")) << anew.error().line();
    EXPECT_EQ(pages_in(path).pages.size(), 3u);
}

TEST_F(Document, WhatCouldNotBeSavedGoesAlongWithTheNextSave) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    DocumentWriter writer(disk.kName);
    const auto save = [&](Content content, bool changed_alone) {
        return is_saved_by(writer, std::move(content), changed_alone);
    };
    disk.is_full = true;
    EXPECT_FALSE(save(small_work(), false));
    disk.is_full = false;
    EXPECT_TRUE(save(changed_tile("second"), true));
    EXPECT_EQ(pages_in(path).pages.size(), 3u) << "the first save's pages are there as well";
    EXPECT_EQ(pages_in(path).pages.at({"tile", 0}), bytes_of("second"));
    disk.is_full = true;
    EXPECT_FALSE(save(changed_tile("third"), true));
    disk.is_full = false;
    Content other;
    other.parts.push_back({.part = "a thing"});
    EXPECT_TRUE(save(std::move(other), true));
    EXPECT_EQ(pages_in(path).pages.at({"tile", 0}), bytes_of("third"));
}

// ---- Steps

namespace {

// Work with steps first to done, of which those from new_from on are given.
Content work_with_steps(std::int64_t first, std::int64_t done, std::int64_t new_from, char mark) {
    Content content;
    scene::Pages& part = content.parts.emplace_back(scene::Pages{.part = "a thing"});
    part.pages = {{{"head", 0}, bytes_of("h")}};
    part.steps = {.first = first, .done = done, .last = done};
    for (std::int64_t number = new_from; number <= done; ++number)
        part.steps->pages[{"rays", number}] = bytes_of(std::string(1, mark) + std::to_string(number));
    return content;
}

// Returns the steps in a document, in words: "2 3: a2 b3".
std::string steps_in(const std::string& path) {
    Result<DocumentReader> reader = DocumentReader::open(path);
    EXPECT_TRUE(reader) << reader.error().line();
    const auto steps = reader->steps(reader->parts().at(0));
    if (!steps) return steps.error().line();
    if (!*steps) return "none";
    std::string words = std::to_string((*steps)->first) + " " + std::to_string((*steps)->done) + ":";
    for (std::int64_t number = (*steps)->first - 1; number <= (*steps)->last + 1; ++number) {
        const auto step = reader->step(reader->parts().at(0), number);
        if (!step) continue;
        words += " ";
        for (const std::byte byte : step->pages.at({"rays", 0})) words += static_cast<char>(byte);
    }
    return words;
}

}  // namespace

TEST_F(Document, KeepsTheStepsThatItNamesAndTakesTheNewOnes) {
    const auto saved = write_document(path, work_with_steps(1, 4, 1, 'a'), Place::nothing);
    ASSERT_TRUE(saved) << saved.error().line();
    EXPECT_EQ(steps_in(path), "1 4: a1 a2 a3 a4");
    const auto changed = update_document(path, work_with_steps(2, 5, 4, 'b'), saved->version);
    ASSERT_TRUE(changed) << changed.error().line();
    EXPECT_EQ(steps_in(path), "2 5: a2 a3 b4 b5");
    ASSERT_TRUE(update_document(path, changed_tile("x"), changed->version));
    EXPECT_EQ(steps_in(path), "none") << "a part that changes without them has none";
}

TEST_F(Document, WhoseSaveFailedGivesItsStepsToTheNext) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    DocumentWriter writer(disk.kName);
    const auto save = [&](Content content, bool changed_alone) {
        return is_saved_by(writer, std::move(content), changed_alone);
    };
    ASSERT_TRUE(save(work_with_steps(1, 2, 1, 'a'), false));
    disk.is_full = true;
    EXPECT_FALSE(save(work_with_steps(1, 5, 3, 'b'), true));
    disk.is_full = false;
    EXPECT_TRUE(save(work_with_steps(2, 4, 4, 'c'), true));
    EXPECT_EQ(steps_in(path), "2 4: a2 b3 c4");
}

}  // namespace burin::document
