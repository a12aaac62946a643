// SPDX-License-Identifier: MIT
// A session that is killed while its journal is being made leaves a whole one, or one that holds nothing and goes
// without a word.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>

#include "document/document_reader.hpp"
#include "document/journal.hpp"
#include "record/database.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;

// The number of a process that has ended.
std::string dead_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    EXPECT_EQ(::waitpid(child, nullptr, 0), child);
    return std::to_string(child);
}

Content whole_content() {
    Content content{.facts = {{kJournalNameFact, "work.burin"}, {kUnsavedFact, "1"}}};
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"tile", 0}, std::vector<std::byte>(5000, std::byte{7})}};
    return content;
}

// Makes a file by SQL.
void make_by(const std::string& path, const std::string& sql, const Workplace& at) {
    at.write(fs::path(path).lexically_relative(at / "").string(), "");
    auto database = record::Database::open(path, record::Database::Use::write);
    ASSERT_TRUE(database);
    const auto done = database->run(sql);
    ASSERT_TRUE(done) << done.error().line();
    ASSERT_TRUE(database->close());
}

std::string document_mark() { return "PRAGMA application_id = " + std::to_string(kDocumentKind.application_id) + "; "; }

}  // namespace

// At each flush, what is on the disk is taken as what a kill leaves.
TEST(HollowJournal, IsAllThatAKillWhileOneIsMadeCanLeave) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    disk.reset();
    const Workplace at;
    const std::string path = at / "work-1.burin", dead = dead_process();
    int flushes = 0, whole = 0;
    disk.set_before_sync([&] {
        const fs::path killed = at / ("killed-" + std::to_string(flushes++));
        fs::create_directory(killed);
        for (const char* const ending : {"", "-wal", "-journal"})
            if (fs::exists(path + ending)) fs::copy_file(path + ending, killed / ("work-" + dead + ".burin" + ending));
    });
    ASSERT_TRUE(Journal::begin(path, whole_content(), disk.kName));
    disk.reset();
    ASSERT_GT(flushes, 1);
    for (int flush = 0; flush < flushes; ++flush) {
        const fs::path killed = at / ("killed-" + std::to_string(flush));
        const auto left = left_journals(killed.string());
        if (left.empty()) {
            EXPECT_TRUE(fs::is_empty(killed)) << flush;
            continue;
        }
        ++whole;
        ASSERT_EQ(left.size(), 1u) << flush;
        EXPECT_EQ(left[0].unreadable, "") << flush;
        auto reader = DocumentReader::open(left[0].path);
        ASSERT_TRUE(reader) << reader.error().line();
        EXPECT_EQ(reader->pages_of("a thing")->pages, whole_content().parts[0].pages) << flush;
    }
    EXPECT_LT(whole, flushes) << "none was caught half made";
}

TEST(HollowJournal, GoesWhereItsProcessIsDeadAndStaysElsewhere) {
    const std::string dead = dead_process(), later = dead_process(), alive = std::to_string(::getppid());
    for (const std::string& process :
         {dead, dead + "-" + later, alive, alive + "-" + dead, dead + "x", std::string("work")}) {
        const Workplace at;
        const auto named = [&](int number) { return at / ("w" + std::to_string(number) + "-" + process + ".burin"); };
        at.write(named(0).filename().string(), "");
        at.write(named(0).filename().string() + "-journal", std::string(512, '\0'));
        make_by(named(1), document_mark() + "CREATE TABLE t(x); DROP TABLE t", at);
        make_by(named(2), document_mark() + "PRAGMA user_version = 1; " + document_tables(), at);
        const bool goes = process == dead || process == dead + "-" + later;
        const std::size_t files = at.files();
        static_cast<void>(left_journals((at / "").string()));
        EXPECT_EQ(at.files(), goes ? 0 : files) << process;
    }
}

TEST(HollowJournal, IsNoneThatHoldsAnythingOrMayHave) {
    const Workplace at;
    const std::string dead = dead_process();
    const auto named = [&](int number) { return at / ("w" + std::to_string(number) + "-" + dead + ".burin"); };
    const std::string tables = document_mark() + "PRAGMA user_version = 1; " + document_tables();
    make_by(named(0), "CREATE TABLE foreign_one(x)", at);
    make_by(named(1), tables + "INSERT INTO meta VALUES('a', 'b')", at);
    make_by(named(2), tables + "INSERT INTO part VALUES(0, 'a thing')", at);
    make_by(named(3), tables + "INSERT INTO command VALUES(0, 'tool ball:0.01')", at);
    make_by(named(4), tables + "INSERT INTO change VALUES(0, 'rays', 1, 0, 0, x'')", at);
    make_by(named(5), tables + "PRAGMA journal_mode = WAL", at);  // its log is not beside it
    make_by(named(6), "PRAGMA application_id = 7; CREATE TABLE t(x); DROP TABLE t", at);
    at.write(named(7).filename().string(), "x");
    static_cast<void>(left_journals((at / "").string()));
    for (int number = 0; number < 8; ++number) EXPECT_TRUE(fs::exists(named(number))) << number;
}

}  // namespace burin::document
