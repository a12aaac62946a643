// SPDX-License-Identifier: MIT
// Tables that are computed from a recording and kept in it, and the motion that they are computed from.
#include "record/derived.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "record/compare.hpp"
#include "record/export/table_export.hpp"
#include "record/motion.hpp"
#include "tests/record/made_ticks.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::record {
namespace {

void recorded_for_deriving(const std::string& path, std::uint64_t ticks) {
    test::Recording recording(8192);
    ASSERT_TRUE(recording.begin(path));
    recording.push(ticks);
    ASSERT_TRUE(recording.writer->close());
}

DerivedTable squares() {
    return {"squares",
            "test 1",
            0,
            {{"tick", "", "", ColumnType::i64}, {"square", "m", "object", ColumnType::f64}},
            {{1, "one"}, {3, "three"}},
            "{}"};
}

// Adds the table of the squares of 1 to `last`.
Result<void> add_squares(const std::string& path, std::int64_t last, const DerivedTable& table = squares()) {
    Result<DerivedWriter> writer = DerivedWriter::create(table);
    if (!writer) return std::unexpected(writer.error());
    for (std::int64_t tick = 1; tick <= last; ++tick) {
        const std::array row{static_cast<Word>(tick), std::bit_cast<Word>(static_cast<double>(tick * tick))};
        if (const auto added = writer->add(tick, 1000 * tick, row); !added) return added;
    }
    return writer->finish(path);
}

}  // namespace

TEST(DerivedTable, IsReadBackBesideTheTicksAndConverted) {
    const Workplace at;
    recorded_for_deriving(at / "a", 2500);
    recorded_for_deriving(at / "b", 2500);
    ASSERT_TRUE(add_squares(at / "a", 2345));
    auto reader = RecordReader::open(at / "a"), untouched = RecordReader::open(at / "b");
    ASSERT_TRUE(reader) << reader.error().line();
    ASSERT_EQ(reader->tables(), 2u);
    const HandRecord& table = reader->table(1);
    EXPECT_TRUE(table.is_derived());
    EXPECT_EQ(table.name, "squares");
    EXPECT_EQ(table.program, "test 1");
    EXPECT_EQ(table.columns, squares().columns);
    EXPECT_EQ(table.objects, squares().objects);
    EXPECT_TRUE(reader->table(0).objects.empty());
    EXPECT_EQ(reader->facts().at("derived squares"), "{}");
    EXPECT_EQ(table.rows(), 2345u);
    RowWalk walk(*reader, 1);
    for (std::int64_t tick = 1; tick <= 2345; ++tick) {
        ASSERT_TRUE(*walk.next());
        ASSERT_EQ(static_cast<std::int64_t>(walk.at(0)), tick);
        ASSERT_EQ(std::bit_cast<double>(walk.at(1)), static_cast<double>(tick * tick));
    }
    EXPECT_FALSE(*walk.next());
    EXPECT_FALSE(compare(*reader, *untouched)->difference) << "what was recorded is untouched";
    ASSERT_TRUE(export_csv(*reader, 1, {0, 1}, at / "a.csv"));
    EXPECT_TRUE(at.read("a.csv").starts_with("tick,square\n1,1\n2,4\n3,9\n"));
}

TEST(DerivedTable, OneThatExistsIsNotReplacedAndAnotherComesBesideIt) {
    const Workplace at;
    recorded_for_deriving(at / "a", 10);
    ASSERT_TRUE(add_squares(at / "a", 5));
    const auto again = add_squares(at / "a", 7);
    ASSERT_FALSE(again);
    EXPECT_NE(again.error().line().find("exists, and is not written over"), std::string::npos);
    DerivedTable other = squares();
    other.program = "test 2";
    ASSERT_TRUE(add_squares(at / "a", 7, other));
    const auto reader = RecordReader::open(at / "a");
    ASSERT_EQ(reader->derived().size(), 2u);
    EXPECT_EQ(reader->derived()[0].rows(), 5u);
    EXPECT_EQ(reader->derived()[1].rows(), 7u);
}

TEST(DerivedTable, ARecordingFromBeforeThereWereNamesOfObjectsIsReadAndTakesOne) {
    const Workplace at;
    recorded_for_deriving(at / "a", 10);
    auto database = Database::open(at / "a", Database::Use::write);
    ASSERT_TRUE(database->run("DROP TABLE object"));
    ASSERT_TRUE(database->close());
    const auto before = RecordReader::open(at / "a");
    ASSERT_TRUE(before) << before.error().line();
    EXPECT_TRUE(before->hands()[0].objects.empty());
    ASSERT_TRUE(add_squares(at / "a", 5));
    EXPECT_EQ(RecordReader::open(at / "a")->derived()[0].objects, squares().objects);
}

// A file and its journal as a kill leaves them, while pages of the transaction are in the file already.
TEST(DerivedTable, OneThatAKillInterruptedIsTakenBackByTheNextReader) {
    const Workplace at;
    recorded_for_deriving(at / "a", 2500);
    auto database = Database::open(at / "a", Database::Use::write);
    ASSERT_TRUE(database->run("PRAGMA cache_size = 2; BEGIN IMMEDIATE"));
    for (int i = 0; i < 50; ++i)
        ASSERT_TRUE(
            database->run("INSERT INTO derived(name, program, columns, hand, tick0, rows, t0_ns, crc, data) "
                          "VALUES('x', 'y', '', 0, 1, 1, 1, 1, zeroblob(100000))"));
    std::filesystem::copy_file(at / "a", at / "b");
    std::filesystem::copy_file(at / "a-journal", at / "b-journal");
    const auto reader = RecordReader::open(at / "b");
    ASSERT_TRUE(reader) << reader.error().line();
    EXPECT_TRUE(reader->derived().empty());
    EXPECT_EQ(*test::sound_ticks(at / "b"), 2500u);
    EXPECT_FALSE(std::filesystem::exists(at / "b-journal"));
}

TEST(DerivedTable, IsRefusedWhereTheFileIsDamagedOrNone) {
    const Workplace at;
    EXPECT_FALSE(add_squares(at / "none", 5));
    at.write("text", "no database, but long enough to be taken for one at first sight");
    EXPECT_FALSE(add_squares(at / "text", 5));
    recorded_for_deriving(at / "a", 10);
    ASSERT_TRUE(add_squares(at / "a", 5));
    auto database = Database::open(at / "a", Database::Use::write);
    ASSERT_TRUE(database->run("UPDATE derived SET columns = 'x'"));
    ASSERT_TRUE(database->close());
    const auto reader = RecordReader::open(at / "a");
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().line().find("derived table that this program does not know"), std::string::npos);
}

TEST(Motion, IsReadBackAsItWasRecorded) {
    const Workplace at;
    recorded_for_deriving(at / "a", 1200);
    auto reader = RecordReader::open(at / "a");
    const auto columns = MotionColumns::find(*reader, 0);
    ASSERT_TRUE(columns) << columns.error().line();
    RowWalk walk(*reader, 0);
    for (std::uint64_t tick = 1; tick <= 1200; ++tick) {
        ASSERT_TRUE(*walk.next());
        const RecordedTick found = columns->at(walk.block(), walk.row());
        const haptics::TickRecord wanted = test::made_tick(tick, 2);
        ASSERT_EQ(found.tick, static_cast<std::int64_t>(tick));
        ASSERT_EQ(found.time_ns, wanted.time_ns);
        ASSERT_EQ(found.lateness_ns, wanted.lateness_ns);
        ASSERT_EQ(found.sample.time_ns, wanted.sample.time_ns);
        ASSERT_EQ(found.sample.position_device_m, wanted.sample.position_device_m);
        ASSERT_EQ(found.sample.orientation_device, wanted.sample.orientation_device);
        ASSERT_EQ(found.sample.buttons, wanted.sample.buttons);
        ASSERT_EQ(found.sample.joints[1], wanted.sample.joints[1]);
        ASSERT_EQ(found.surface_sequence, wanted.surface_sequence);
        ASSERT_EQ(found.object_from_device.scale, 1.0);
    }
    auto database = Database::open(at / "a", Database::Use::write);
    ASSERT_TRUE(database->run("UPDATE column SET name = 'other' WHERE name = 'buttons'"));
    ASSERT_TRUE(database->close());
    const auto renamed = RecordReader::open(at / "a");
    const auto missing = MotionColumns::find(*renamed, 0);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().line().find("has no column buttons"), std::string::npos);
}

// Each number of a sample and of the motion is another, and comes back as itself.
TEST(Motion, OfAOneWayDriveIsReadBackNumberByNumber) {
    const Workplace at;
    Ring<haptics::TickRecord> ring(64);
    devices::DeviceDescription device = test::device_with(4);
    device.drives_one_way = true;
    std::vector<haptics::TickRecord> ticks;
    for (std::uint64_t tick = 1; tick <= 20; ++tick) {
        haptics::TickRecord record = test::made_tick(tick, 2);
        const double t = 0.01 * static_cast<double>(tick);
        record.sample.drive = {{0.1 + t, -0.2 - t, 0.3 - t}, {-0.4 + t, 0.5 + t, 0.6 - t}, 0.07 + t, 0.8 + t, 5u};
        record.sample.drive.state += static_cast<std::uint32_t>(tick);
        record.sample.fault = static_cast<devices::DeviceFault>(tick % 3);
        record.motion.object_from_device = {uneven_offset(tick), uneven_turn(tick), kUnevenScales[tick % kUnevenPoses]};
        record.parameter_sequence = 1000 + tick;
        ticks.push_back(record);
        ring.push(record);
    }
    auto writer = RecordWriter::create(at / "a", {{"made", device, test::probe_of(2), &ring}}, {});
    ASSERT_TRUE(writer);
    ASSERT_TRUE((*writer)->close());
    auto reader = RecordReader::open(at / "a");
    ASSERT_TRUE(reader);
    const auto columns = MotionColumns::find(*reader, 0);
    ASSERT_TRUE(columns) << columns.error().line();
    RowWalk walk(*reader, 0);
    for (const haptics::TickRecord& wanted : ticks) {
        ASSERT_TRUE(*walk.next());
        const RecordedTick found = columns->at(walk.block(), walk.row());
        EXPECT_EQ(found.sample.drive.along_device, wanted.sample.drive.along_device);
        EXPECT_EQ(found.sample.drive.moves_device, wanted.sample.drive.moves_device);
        EXPECT_EQ(found.sample.drive.length_m, wanted.sample.drive.length_m);
        EXPECT_EQ(found.sample.drive.measured_N, wanted.sample.drive.measured_N);
        EXPECT_EQ(found.sample.drive.state, wanted.sample.drive.state);
        EXPECT_EQ(found.sample.fault, wanted.sample.fault);
        for (std::size_t joint = 0; joint < 4; ++joint)
            EXPECT_EQ(found.sample.joints[joint], wanted.sample.joints[joint]) << joint;
        EXPECT_EQ(found.object_from_device, wanted.motion.object_from_device);
        EXPECT_EQ(found.parameter_sequence, wanted.parameter_sequence);
    }
}

TEST(Compare, OfARangeLooksAtItsTicksAlone) {
    const Workplace at;
    recorded_for_deriving(at / "a", 2500);
    recorded_for_deriving(at / "b", 1800);
    auto a = RecordReader::open(at / "a"), b = RecordReader::open(at / "b");
    const auto part = compare(*a, *b, {}, {900, 1700});
    ASSERT_TRUE(part && !part->difference);
    EXPECT_EQ(part->ticks, 801u);
    EXPECT_TRUE(compare(*a, *b, {}, {900, 1900})->difference);
}

}  // namespace burin::record
