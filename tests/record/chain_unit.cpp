// SPDX-License-Identifier: MIT
// The chain of digests: a file as it was recorded passes, and each kind of change that a hand can make afterwards
// shows.
#include "record/chain.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "record/database.hpp"
#include "record/derived.hpp"
#include "record/examination.hpp"
#include "record/record_reader.hpp"
#include "record/record_writer.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;

// Six seconds of ticks in transactions of a second, with everything else that a recording holds.
std::string recorded(const Workplace& at, const std::string& name = "a.session") {
    const std::string path = at / name;
    test::Recording recording;
    WriterOptions options;
    options.facts = {{"program", "burin"}, {"settings", "{\"radius_m\": 0.003}"}};
    options.objects = {{1, "Cube"}, {2, "Tube"}};
    EXPECT_TRUE(recording.begin(path, options));
    const std::int64_t trial = recording.writer->begin_trial(5'100'000'000, "first");
    for (int second = 0; second < 6; ++second) {
        recording.writer->note_line(second, "line " + std::to_string(second));
        recording.writer->note_event(second, "act", "value " + std::to_string(second), trial);
        recording.push(1000);
    }
    recording.writer->end_trial(trial, 9'000'000'000, "done");
    EXPECT_TRUE(recording.writer->close());
    return path;
}

ChainExamination examined(const std::string& path) {
    Result<RecordReader> reader = RecordReader::open(path);
    if (!reader) {
        ADD_FAILURE() << reader.error().line();
        return {};
    }
    const Result<ChainExamination> found = reader->examine_chain();
    if (!found) ADD_FAILURE() << found.error().line();
    return found.value_or(ChainExamination{});
}

void edit(const std::string& path, const std::string& sql) {
    Result<Database> database = Database::open(path, Database::Use::write);
    ASSERT_TRUE(database) << database.error().line();
    const Result<void> done = database->run(sql);
    ASSERT_TRUE(done) << done.error().line() << " " << sql;
    ASSERT_TRUE(database->close());
}

}  // namespace

TEST(Chain, HoldsInAFileAsItWasRecorded) {
    const Workplace at;
    const ChainExamination found = examined(recorded(at));
    EXPECT_TRUE(found.is_there);
    EXPECT_GE(found.links, 3);
    EXPECT_EQ(found.last_digest.size(), 64u);
    for (const std::string& fault : found.faults) ADD_FAILURE() << fault;
}

// One change for each thing that a file holds and that a hand can take out, put in or alter.
TEST(Chain, ShowsEveryKindOfChange) {
    const Workplace at;
    const std::string whole = recorded(at);
    const char* changes[] = {
        "DELETE FROM block WHERE id = 1",
        "DELETE FROM block WHERE id = 3",
        "DELETE FROM block WHERE id = (SELECT max(id) FROM block)",
        "DELETE FROM block WHERE id <= 2",
        "UPDATE block SET t0_ns = t0_ns + 1 WHERE id = 2",
        "UPDATE block SET data = (SELECT data FROM block WHERE id = 1), crc = (SELECT crc FROM block WHERE id = 1), "
        "tick0 = (SELECT tick0 FROM block WHERE id = 1) WHERE id = 2",
        "INSERT INTO block(hand, tick0, rows, t0_ns, crc, data) SELECT hand, tick0, rows, t0_ns, crc, data FROM block "
        "WHERE id = 1",
        "UPDATE line SET text = 'another' WHERE id = 2",
        "DELETE FROM line WHERE id = 4",
        "INSERT INTO line(time_ns, text) VALUES(1, 'later')",
        "UPDATE event SET time_ns = time_ns + 1 WHERE id = 2",
        "UPDATE event SET trial = NULL WHERE id = 3",
        "UPDATE event SET value = 'value 9' WHERE id = 1",
        "DELETE FROM event WHERE id = 6",
        "UPDATE trial SET state = 'aborted'",
        "UPDATE trial SET ended_ns = ended_ns - 1",
        "UPDATE trial SET begun_ns = begun_ns + 1",
        "UPDATE trial SET name = 'second'",
        "DELETE FROM trial",
        "UPDATE clock SET utc_ns = utc_ns + 3600000000000 WHERE id = 2",
        "UPDATE meta SET value = replace(value, '0.003', '0.0031') WHERE key = 'settings'",
        "UPDATE meta SET value = '0' WHERE key LIKE 'ticks lost%' OR key LIKE 'tick period%'",
        "UPDATE meta SET value = 'regular ' WHERE key = 'end'",
        "DELETE FROM meta WHERE key = 'program'",
        "INSERT INTO meta VALUES('operator', 'nobody')",
        "UPDATE hand SET name = 'another'",
        "UPDATE column SET name = 'b_m' WHERE position = 5",
        "UPDATE column SET unit = 'mm' WHERE position = 5",
        "UPDATE object SET name = 'Ball' WHERE number = 1",
        "DELETE FROM object WHERE number = 2",
        "INSERT INTO object VALUES('', 3, 'Cone')",
        "DELETE FROM chain",
        "DELETE FROM chain WHERE id = 1",
        "DELETE FROM chain WHERE id = 3",
        "DELETE FROM chain WHERE id = (SELECT max(id) FROM chain)",
        "UPDATE chain SET digest = lower(hex(randomblob(32))) WHERE id = 2",
        "UPDATE chain SET facts = '' WHERE id = 1",
    };
    for (const char* change : changes) {
        const std::string copy = at / "copy.session";
        fs::copy_file(whole, copy, fs::copy_options::overwrite_existing);
        edit(copy, change);
        EXPECT_FALSE(examined(copy).faults.empty()) << change;
    }
}

TEST(Chain, ShowsWhatWasCutOffTheEndTogetherWithItsLinks) {
    const Workplace at;
    const std::string path = recorded(at);
    edit(path,
         "DELETE FROM chain WHERE id > 3;"
         "DELETE FROM block WHERE id > (SELECT max(block) FROM chain);"
         "DELETE FROM line WHERE id > (SELECT max(line) FROM chain);"
         "DELETE FROM event WHERE id > (SELECT max(event) FROM chain);"
         "DELETE FROM clock WHERE id > (SELECT max(clock) FROM chain)");
    const ChainExamination found = examined(path);
    ASSERT_FALSE(found.faults.empty());
    EXPECT_TRUE(found.faults.front().contains("last transactions are gone")) << found.faults.front();
}

TEST(Chain, NamesThePlaceOfAChange) {
    const Workplace at;
    const std::string path = recorded(at);
    edit(path, "DELETE FROM block WHERE id = 3");
    const ChainExamination found = examined(path);
    ASSERT_EQ(found.faults.size(), 1u);
    EXPECT_TRUE(found.faults[0].contains("block")) << found.faults[0];
}

TEST(Chain, LetsDerivedTablesBeAdded) {
    const Workplace at;
    const std::string path = recorded(at);
    edit(path,
         "INSERT INTO meta VALUES('derived tube', '{}');"
         "INSERT INTO object VALUES('tube', 1, 'Wall');"
         "INSERT INTO derived(name, program, columns, hand, tick0, rows, t0_ns, crc, data) "
         "VALUES('tube', 'burin', 'name,unit,frame,type' || char(10) || 'tick,,,i64' || char(10), 0, 1, 1, 1, 1, "
         "x'00')");
    for (const std::string& fault : examined(path).faults) ADD_FAILURE() << fault;
}

TEST(Chain, IsMissingInAFileOfAnEarlierVersionWhichIsNoFault) {
    const Workplace at;
    const std::string path = recorded(at);
    edit(path, "DROP TABLE chain");
    const ChainExamination found = examined(path);
    EXPECT_FALSE(found.is_there);
    EXPECT_TRUE(found.faults.empty());
}

TEST(Chain, OfTwoRecordingsDiffers) {
    const Workplace at;
    EXPECT_NE(examined(recorded(at)).last_digest, examined(recorded(at, "b.session")).last_digest);
}

// ---- Ticks that were due and never ran

TEST(Examination, CountsTicksThatNeverRanFromTheLatenessOfThoseThatDid) {
    const Workplace at;
    const std::string path = at / "stalled.session";
    test::Recording recording;
    ASSERT_TRUE(recording.begin(path));
    Nanoseconds time_ns = 5'000'000'000;
    for (std::uint64_t i = 1; i <= 1000; ++i) {
        haptics::TickRecord tick = test::made_tick(i, 2);
        // Every tenth tick comes 30.4 ms late: 30 deadlines have passed by then.
        tick.lateness_ns = i % 10 == 0 ? 30'400'000 : 999'999;
        time_ns += i % 10 == 0 ? 31'400'000 : 1'000'000;
        tick.time_ns = time_ns;
        ASSERT_TRUE(recording.ring.push(tick));
        if (i % 256 == 0) recording.writer->take_now();
    }
    ASSERT_TRUE(recording.writer->close());
    Result<RecordReader> reader = RecordReader::open(path);
    ASSERT_TRUE(reader);
    const HandExamination found = examine(*reader, 0);
    EXPECT_EQ(found.ticks, 1000u);
    ASSERT_TRUE(found.never_run);
    EXPECT_EQ(*found.never_run, 3000u);
    EXPECT_EQ(found.longest_interval_ns, 31'400'000);
    EXPECT_EQ(reader->facts().at("ticks never run, hand 0"), "3000");
}

}  // namespace burin::record
