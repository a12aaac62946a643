// SPDX-License-Identifier: MIT
// Comparing two recordings, and tables that other programs read.
#include "record/compare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include "record/export/table_export.hpp"
#include "record/touched_columns.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

// Records ticks 1 to `last` in blocks of so long; one value of one tick may differ.
void recorded_so(const std::string& path, std::uint64_t last, Nanoseconds block_ns, std::uint64_t changed = 0) {
    test::Recording recording(8192);
    WriterOptions options;
    options.block_ns = block_ns;
    ASSERT_TRUE(recording.begin(path, options));
    for (std::uint64_t tick = 1; tick <= last; ++tick) {
        haptics::TickRecord record = test::made_tick(tick, 2);
        if (tick == changed) record.contact.points[1].force_device_N.y = -0.0;
        recording.ring.push(record);
    }
    ASSERT_TRUE(recording.writer->close());
}

}  // namespace

TEST(Compare, EqualTicksAreEqualWhateverBlocksTheyLieIn) {
    const Workplace at;
    recorded_so(at / "a", 2500, kNanosecondsPerSecond);
    recorded_so(at / "b", 2500, 77'000'000);
    auto a = RecordReader::open(at / "a"), b = RecordReader::open(at / "b");
    EXPECT_NE(a->hands()[0].blocks.size(), b->hands()[0].blocks.size());
    const auto found = compare(*a, *b);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->difference);
    EXPECT_EQ(found->ticks, 2500u);
    EXPECT_EQ(found->columns, columns_for(RowShape{2, 2}).size());
}

TEST(Compare, TheFirstDifferenceIsNamedByTickColumnAndBothValues) {
    const Workplace at;
    recorded_so(at / "a", 1500, kNanosecondsPerSecond);
    recorded_so(at / "b", 1500, kNanosecondsPerSecond, 1234);
    auto a = RecordReader::open(at / "a"), b = RecordReader::open(at / "b");
    const auto found = compare(*a, *b);
    ASSERT_TRUE(found && found->difference);
    EXPECT_EQ(found->ticks, 1233u);
    EXPECT_EQ(found->difference->line(), "made, tick 1234, force1_device_y_N: -1234 in the first, -0 in the second");
    EXPECT_FALSE(compare(*a, *b, "force0*,tick")->difference);
    EXPECT_FALSE(compare(*a, *b, "nothing"));
}

// A version appends columns: what the older recording has is compared, and either may be the older one.
TEST(Compare, ARecordingFromBeforeThereWereWallsIsComparedInTheColumnsThatItHas) {
    const RowShape shape{2, 2};
    std::vector<Column> all = columns_for(shape), before = all;
    std::ranges::copy(touched_columns(shape), std::back_inserter(all));
    before.insert(before.end(), all.begin() + static_cast<std::ptrdiff_t>(before.size()),
                  all.begin() + static_cast<std::ptrdiff_t>(before.size()) + shape.points);
    EXPECT_EQ(before.back().name, "object1");
    EXPECT_TRUE(can_be_replayed(all, shape));
    EXPECT_TRUE(can_be_replayed(before, shape));
    before.pop_back();
    EXPECT_FALSE(can_be_replayed(before, shape)) << "no version had these";
    std::swap(all[3], all[4]);
    EXPECT_FALSE(can_be_replayed(all, shape));

    const Workplace at;
    recorded_so(at / "old", 300, kNanosecondsPerSecond);
    test::Recording newer(8192);
    newer.more_columns = {{"energy_share", "", "", ColumnType::f64}};
    newer.more_values = [](const haptics::TickRecord&, std::vector<Word>& row) { row.push_back(0); };
    ASSERT_TRUE(newer.begin(at / "new", {}));
    for (std::uint64_t tick = 1; tick <= 300; ++tick) newer.ring.push(test::made_tick(tick, 2));
    ASSERT_TRUE(newer.writer->close());
    auto a = RecordReader::open(at / "old"), b = RecordReader::open(at / "new");
    for (const auto& found : {compare(*a, *b), compare(*b, *a)}) {
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->difference);
        EXPECT_EQ(found->ticks, 300u);
        EXPECT_EQ(found->columns, columns_for(shape).size());
    }
}

// One bit changed in each column in turn, in the row of a stored tick: it is found, and its column named.
TEST(Compare, ARowThatIsComputedAgainIsComparedInEveryColumn) {
    for (const RowShape shape : {RowShape{0, 1}, RowShape{2, 2}, RowShape{8, 4}}) {
        HandRecord hand;
        hand.name = "made";
        hand.columns = columns_for(shape);
        Block block(hand.types());
        for (const std::uint64_t tick : {6u, 7u, 8u}) block.add(row_of(test::made_tick(tick, shape.points), shape));
        const std::vector<Word> row = row_of(test::made_tick(7, shape.points), shape);
        EXPECT_FALSE(difference_in_row(hand, block, 1, row));
        for (std::size_t c = 0; c < row.size(); ++c) {
            for (const int bit : {0, hand.columns[c].type == ColumnType::u32 ? 31 : 63}) {
                std::vector<Word> again = row;
                again[c] ^= Word{1} << bit;
                const auto found = difference_in_row(hand, block, 1, again);
                ASSERT_TRUE(found) << hand.columns[c].name;
                EXPECT_EQ(found->column, hand.columns[c].name);
                EXPECT_EQ(found->tick, 7);
                EXPECT_NE(found->first, found->second) << hand.columns[c].name;
            }
        }
    }
}

TEST(Compare, ZeroesOfBothSignsDifferAndTicksThatOneAloneHasAreNamed) {
    const Workplace at;
    recorded_so(at / "a", 10, kNanosecondsPerSecond);
    recorded_so(at / "b", 12, kNanosecondsPerSecond);
    auto a = RecordReader::open(at / "a"), b = RecordReader::open(at / "b");
    EXPECT_EQ(compare(*a, *b)->difference->line(), "made, tick 11: only the second has it");
    EXPECT_EQ(compare(*b, *a)->difference->line(), "made, tick 11: only the first has it");
}

TEST(Export, CommaSeparatedTextHoldsEveryValueWithItsBits) {
    const Workplace at;
    recorded_so(at / "a", 1100, kNanosecondsPerSecond);
    auto reader = RecordReader::open(at / "a");
    const auto columns = *choose_columns(reader->hands()[0].columns, "tick,time_ns,position_device*,triangle1");
    const auto report = export_csv(*reader, 0, columns, at / "a.csv");
    ASSERT_TRUE(report) << report.error().line();
    EXPECT_EQ(report->rows, 1100u);
    std::istringstream table(at.read("a.csv"));
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line, "tick,time_ns,position_device_x_m,position_device_y_m,position_device_z_m,triangle1");
    std::uint64_t tick = 0;
    while (std::getline(table, line)) {
        const haptics::TickRecord wanted = test::made_tick(++tick, 2);
        const char* at_text = line.c_str();
        char* end = nullptr;
        EXPECT_EQ(std::strtoull(at_text, &end, 10), tick);
        EXPECT_EQ(std::strtoll(end + 1, &end, 10), wanted.time_ns);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(std::strtod(end + 1, &end), wanted.sample.position_device_m[i]);
        EXPECT_EQ(std::strtoul(end + 1, &end, 10), wanted.contact.points[1].active_triangle);
        EXPECT_EQ(*end, '\0');
    }
    EXPECT_EQ(tick, 1100u);
}

TEST(Export, WritesNothingWhereItCannotWriteAll) {
    const Workplace at;
    recorded_so(at / "a", 10, kNanosecondsPerSecond);
    auto reader = RecordReader::open(at / "a");
    EXPECT_FALSE(export_csv(*reader, 0, {0}, at / "no/folder.csv"));
    EXPECT_FALSE(export_npy(*reader, 0, {0}, "-"));
    at.write("b.csv", "old");
    ASSERT_TRUE(export_csv(*reader, 0, {0}, at / "b.csv"));
    EXPECT_TRUE(at.read("b.csv").starts_with("tick\n1\n2\n"));
    EXPECT_EQ(at.files(), 2u) << "no temporary file is left";
}

TEST(Export, NumPyReadsTheArrayAndFindsTheValuesOfTheText) {
    const Workplace at;
    recorded_so(at / "a", 1100, kNanosecondsPerSecond);
    auto reader = RecordReader::open(at / "a");
    const auto all = *choose_columns(reader->hands()[0].columns, "");
    ASSERT_TRUE(export_csv(*reader, 0, all, at / "a.csv"));
    ASSERT_TRUE(export_npy(*reader, 0, all, at / "a.npy"));
    if (at.run("/usr/bin/python3 -c 'import numpy'").status != 0) GTEST_SKIP() << "python3-numpy is not installed";
    at.write("equal.py", R"(
import csv, numpy
a = numpy.load('a.npy')
rows = list(csv.reader(open('a.csv')))
assert list(a.dtype.names) == rows[0] and len(a) == len(rows) - 1 == 1100
for i, row in enumerate(rows[1:]):
    for name, text in zip(rows[0], row):
        kind = a.dtype[name].kind
        value = float(text) if kind == 'f' else int(text)
        assert a[name][i] == value or (value != value and a[name][i] != a[name][i]), (i, name, text)
print('equal', a['time_ns'][-1])
)");
    const auto outcome = at.run("/usr/bin/python3 equal.py");
    EXPECT_EQ(outcome.output, "equal 6100000000\n");
}

}  // namespace burin::record
