// SPDX-License-Identifier: MIT
// The reader and bad files: an error that names the file and the remedy, and what is sound is read.
#include "record/record_reader.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "record/examination.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;

// Records so many ticks.
void recorded(const std::string& path, std::uint64_t ticks) {
    test::Recording recording;
    ASSERT_TRUE(recording.begin(path));
    recording.push(ticks);
    ASSERT_TRUE(recording.writer->close());
}

// Changes a file as another program could.
void change(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    char* why = nullptr;
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &why), SQLITE_OK) << (why != nullptr ? why : "");
    sqlite3_free(why);
    sqlite3_close(database);
}

// Expects a refusal whose message has these words, the file's name and a remedy.
void expect_refused(const std::string& path, const std::string& words) {
    const auto refused = RecordReader::open(path);
    ASSERT_FALSE(refused) << words;
    EXPECT_NE(refused.error().what.find(words), std::string::npos) << refused.error().line();
    EXPECT_NE(refused.error().where.find(path), std::string::npos) << refused.error().line();
    EXPECT_FALSE(refused.error().remedy.empty());
}

}  // namespace

TEST(RecordReader, RefusesWhatIsNoSessionFile) {
    const Workplace at;
    at.write("empty", "");
    at.write("short", "SQLite format 3");
    at.write("text", std::string(5000, 'x'));
    fs::create_directory(at / "folder");
    ASSERT_EQ(mkfifo((at / "pipe").c_str(), 0600), 0);
    expect_refused(at / "missing", "cannot be read");
    expect_refused(at / "empty", "is empty");
    expect_refused(at / "short", "is not an SQLite file");
    expect_refused(at / "text", "is not an SQLite file");
    expect_refused(at / "folder", "is not a regular file");
    expect_refused(at / "pipe", "is not a regular file");
    change(at / "other", "CREATE TABLE block(x)");
    expect_refused(at / "other", "another program");
    at.write("byte", "x");
    expect_refused(at / "byte", "is not an SQLite file: it has 1 byte");
    change(at / "nothing", "CREATE TABLE a(x); DROP TABLE a");
    expect_refused(at / "nothing", "is an SQLite file that holds nothing");
}

TEST(RecordReader, RefusesOtherVersionsTablesAndColumns) {
    struct Case {
        const char *sql, *words;
    };
    const Case cases[]{
        {"PRAGMA user_version = 2", "version 2"},
        {"PRAGMA user_version = -1", "no version"},
        {"DROP TABLE block", "no table block"},
        {"DROP TABLE block; CREATE VIEW block AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) "
         "SELECT id, 0 AS hand, id AS tick0, 1 AS rows, 0 AS t0_ns, 0 AS crc, '' AS data FROM n",
         "no table block"},
        {"DROP TABLE line; CREATE VIRTUAL TABLE line USING fts5(text)", "no table line"},
        {"DELETE FROM column WHERE position = 3", "column 3 of made is missing"},
        {"DELETE FROM column", "has no columns"},
        {"UPDATE column SET type = 'f16' WHERE position = 5", "does not know"},
        {"UPDATE column SET name = '' WHERE position = 5", "does not know"},
        {"UPDATE hand SET hand = -7", "hands that no recording has"},
        {"UPDATE block SET hand = 9", "which it does not name"},
        {"ALTER TABLE block DROP COLUMN rows", "no such column"},
        {"WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 100) "
         "INSERT INTO hand SELECT i, 'h' FROM n",
         "hands that no recording has"},
    };
    const Workplace at;
    recorded(at / "sound", 100);
    int number = 0;
    for (const Case& c : cases) {
        const std::string path = at / std::to_string(++number);
        fs::copy_file(at / "sound", path);
        change(path, c.sql);
        expect_refused(path, c.words);
    }
    EXPECT_EQ(*test::sound_ticks(at / "sound"), 100u);
}

TEST(RecordReader, NamesDamagedBlocksAndReadsTheOthers) {
    const Workplace at;
    recorded(at / "a.session", 4500);
    change(at / "a.session",
           "UPDATE block SET data = zeroblob(length(data)) WHERE id = 1;"
           "UPDATE block SET rows = 1000000000000 WHERE id = 2;"
           "UPDATE block SET crc = crc + 1 WHERE id = 3;"
           "INSERT INTO block(hand, tick0, rows, t0_ns, crc, data) VALUES(0, 9, 1, 0, -1, 'text')");
    auto reader = RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader);
    const HandExamination found = examine(*reader, 0);
    EXPECT_EQ(found.damaged.size(), 4u);
    EXPECT_EQ(found.ticks, 1500u);
    EXPECT_NE(found.damaged[0].where.find("block 1 of made, from tick 1"), std::string::npos) << found.damaged[0].where;
    const auto sound = reader->block(0, 3);
    ASSERT_TRUE(sound);
    EXPECT_EQ(sound->at(0, 0), 3001u);
}

TEST(RecordReader, OfAFileThatWasCutOffNothingCrashesAndSoundBlocksAreRead) {
    const Workplace at;
    recorded(at / "sound", 6500);
    const std::string bytes = at.read("sound");
    std::uint64_t read_in_all = 0;
    for (std::size_t size = 0; size < bytes.size(); size += 1777) {
        at.write("cut", bytes.substr(0, size));
        auto reader = RecordReader::open(at / "cut");
        if (!reader) {
            EXPECT_FALSE(reader.error().remedy.empty());
            continue;
        }
        const HandExamination found = examine(*reader, 0);
        EXPECT_LT(found.ticks, 6500u);
        read_in_all += found.ticks;
    }
    static_cast<void>(read_in_all);  // depends on where SQLite put its pages
}

TEST(RecordReader, ChangedBytesNeverGiveOtherTicks) {
    const Workplace at;
    recorded(at / "sound", 1200);
    const std::string bytes = at.read("sound");
    // All values of a block that is read are as made: its sum tells else. What stands in other tables has none.
    for (std::size_t place = 100; place < bytes.size(); place += 997) {
        std::string changed = bytes;
        changed[place] = static_cast<char>(changed[place] ^ 0x55);
        at.write("changed", changed);
        auto reader = RecordReader::open(at / "changed");
        if (!reader || reader->hands().empty()) continue;
        for (std::size_t n = 0; n < reader->hands()[0].blocks.size(); ++n) {
            const auto block = reader->block(0, n);
            if (!block || block->columns() != row_of(test::made_tick(1, 2), {2, 2}).size()) continue;
            for (std::uint32_t row = 0; row < block->rows(); ++row)
                ASSERT_EQ(row_of(test::made_tick(block->at(0, row), 2), {2, 2})[5], block->at(5, row)) << place;
        }
        static_cast<void>(reader->structure_fault());
    }
}

TEST(RecordReader, ReadsAFileThatNobodyMayWriteInAFolderThatNobodyMayWrite) {
    const Workplace at;
    fs::create_directory(at / "fixed");
    recorded(at / "fixed/a.session", 1200);
    fs::permissions(at / "fixed/a.session", fs::perms::owner_read);
    fs::permissions(at / "fixed", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(*test::sound_ticks(at / "fixed/a.session"), 1200u);
    EXPECT_EQ(std::distance(fs::directory_iterator(at / "fixed"), {}), 1);
    fs::permissions(at / "fixed", fs::perms::owner_all);
}

TEST(RecordReader, TellsWhetherTheWallClockWasSet) {
    EXPECT_EQ(wall_clock_moved_ns({}), 0);
    EXPECT_EQ(wall_clock_moved_ns({{0, 100}, {50, 150}, {90, 191}}), 1);
    EXPECT_EQ(wall_clock_moved_ns({{0, 100}, {50, 3'600'000'000'150}, {90, 190}}), 3'600'000'000'000);
    EXPECT_GT(wall_clock_moved_ns({{INT64_MIN, INT64_MAX}, {INT64_MAX, INT64_MIN}}), 0);
}

}  // namespace burin::record
