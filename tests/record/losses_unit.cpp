// SPDX-License-Identifier: MIT
// What a recording tells of its losses: each hand of two has its own numbers, and notes that had no room are counted.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "record/examination.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

constexpr std::size_t kLossHands = 2;
constexpr std::array<const char*, kLossHands> kLossNames{"left", "right"};

// Two hands of different rates, whose ticks wait in their rings before the writer begins.
class TwoRecordedHands {
public:
    // Returns how many had no room.
    std::uint64_t push(std::size_t hand, std::uint64_t count, Nanoseconds lateness_ns = 0) {
        std::uint64_t refused = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            haptics::TickRecord record = test::made_tick(++last_tick_[hand], 2);
            record.lateness_ns = lateness_ns;
            refused += rings_[hand].push(record) ? 0 : 1;
        }
        return refused;
    }
    Result<void> begin(const std::string& path, WriterOptions options = {}) {
        std::vector<RecordedHand> hands;
        for (std::size_t i = 0; i < kLossHands; ++i) {
            hands.push_back({kLossNames[i], test::device_with(2), test::probe_of(2), &rings_[i]});
            hands.back().device.rate_Hz = kRates_Hz[i];
        }
        auto made = RecordWriter::create(path, std::move(hands), std::move(options));
        if (!made) return std::unexpected(made.error());
        writer = std::move(*made);
        return {};
    }
    static constexpr std::array<double, kLossHands> kRates_Hz{1000.0, 250.0};
    std::unique_ptr<RecordWriter> writer;

private:
    std::array<Ring<haptics::TickRecord>, kLossHands> rings_{Ring<haptics::TickRecord>(4096),
                                                             Ring<haptics::TickRecord>(4096)};
    std::array<std::uint64_t, kLossHands> last_tick_{};
};

std::uint64_t told_of(const RecordReader& reader, const std::string& what, std::size_t hand) {
    const auto fact = reader.facts().find(what + ", hand " + std::to_string(hand));
    EXPECT_TRUE(fact != reader.facts().end()) << what << hand;
    return fact != reader.facts().end() ? std::stoull(fact->second) : 0;
}

}  // namespace

TEST(RecordedLosses, OfTicksThatNeverRanAreCountedOfEachHandByItsOwnPeriod) {
    for (std::size_t late = 0; late < kLossHands; ++late) {
        const Workplace at;
        TwoRecordedHands hands;
        hands.push(late, 30, 21'000'000);  // 21 periods of 1 ms, or 5 of 4 ms
        hands.push(late, 70);
        hands.push(1 - late, 80, 500'000);
        ASSERT_TRUE(hands.begin(at / "a.session"));
        ASSERT_TRUE(hands.writer->close());
        auto reader = RecordReader::open(at / "a.session");
        ASSERT_TRUE(reader) << reader.error().line();
        const std::uint64_t skipped = 30u * (late == 0 ? 21u : 5u);
        for (std::size_t hand = 0; hand < kLossHands; ++hand) {
            const std::uint64_t own = hand == late ? skipped : 0;
            EXPECT_EQ(told_of(*reader, "ticks never run", hand), own) << hand << ", late: " << late;
            EXPECT_EQ(examine(*reader, hand).never_run, own) << hand << ", late: " << late;
            EXPECT_EQ(reader->facts().at(period_fact(hand)), hand == 0 ? "1000000" : "4000000");
            EXPECT_EQ(told_of(*reader, "ticks lost", hand), 0u);
        }
    }
}

TEST(RecordedLosses, OfTicksThatHadNoRoomInARingAreCountedOfItsHandAlone) {
    for (std::size_t full = 0; full < kLossHands; ++full) {
        const Workplace at;
        TwoRecordedHands hands;
        EXPECT_EQ(hands.push(full, 4096 + 123), 123u);
        EXPECT_EQ(hands.push(1 - full, 77), 0u);
        ASSERT_TRUE(hands.begin(at / "a.session"));
        ASSERT_TRUE(hands.writer->close());
        EXPECT_EQ(hands.writer->acknowledged(full), 4096u);
        EXPECT_EQ(hands.writer->acknowledged(1 - full), 77u);
        const auto reader = RecordReader::open(at / "a.session");
        ASSERT_TRUE(reader) << reader.error().line();
        EXPECT_EQ(told_of(*reader, "ticks lost", full), 123u) << full;
        EXPECT_EQ(told_of(*reader, "ticks lost", 1 - full), 0u) << full;
    }
}

// The disk is full from the first tick on: blocks of both hands wait, and others are being filled, when it is given up.
TEST(RecordedLosses, OfAFullDiskAreEachHandsOwnTicks) {
    constexpr std::array<std::uint64_t, 2> kCounts{2500, 1300};
    for (const bool exchanged : {false, true}) {
        const Workplace at;
        test::FailingDisk& disk = test::failing_disk();
        disk.reset();
        TwoRecordedHands hands;
        std::array<std::uint64_t, kLossHands> pushed{};
        for (std::size_t hand = 0; hand < kLossHands; ++hand) {
            pushed[hand] = kCounts[exchanged ? 1 - hand : hand];
            ASSERT_EQ(hands.push(hand, pushed[hand]), 0u);
        }
        WriterOptions options;
        options.vfs = test::FailingDisk::kName;
        options.patience_ns = 0;
        options.on_record = [&](std::size_t, const haptics::TickRecord&) { disk.is_full = true; };
        ASSERT_TRUE(hands.begin(at / "a.session", options));
        hands.writer->take_now();
        ASSERT_TRUE(hands.writer->failure());
        EXPECT_TRUE(hands.writer->failure()->line().contains("left up to tick 0, right up to tick 0"))
            << hands.writer->failure()->line();
        disk.reset();  // the facts of the end find room
        ASSERT_FALSE(hands.writer->close());
        const auto reader = RecordReader::open(at / "a.session");
        ASSERT_TRUE(reader) << reader.error().line();
        for (std::size_t hand = 0; hand < kLossHands; ++hand) {
            EXPECT_EQ(reader->hands()[hand].rows(), 0u);
            EXPECT_EQ(told_of(*reader, "ticks lost", hand), pushed[hand]) << hand << exchanged;
        }
    }
}

TEST(RecordedLosses, OfNotesThatHadNoRoomAreCounted) {
    const Workplace at;
    TwoRecordedHands hands;
    ASSERT_TRUE(hands.begin(at / "a.session"));
    hands.writer->note_line(1, "little");
    for (int i = 0; i < 3; ++i) hands.writer->note_event(2, "too much", std::string(kMostWaitingBytes, 'c'));
    hands.writer->note_line(3, "not much");
    ASSERT_TRUE(hands.writer->close());
    auto reader = RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader) << reader.error().line();
    std::vector<std::string> lines;
    ASSERT_TRUE(reader->each_line([&](std::int64_t, const std::string& text) { lines.push_back(text); }));
    EXPECT_EQ(lines, (std::vector<std::string>{"little", "not much"}));
    EXPECT_TRUE(reader->events()->empty());
    EXPECT_EQ(reader->facts().at("notes lost"), "3");
}

TEST(RecordedLosses, OfTimesThatStandStillAreCountedAsThoseThatRunBack) {
    const Workplace at;
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session"));
    for (const Nanoseconds later_ns : {1, 2, 2, 2, 3, 1, 5}) {
        haptics::TickRecord record = test::made_tick(++recording.last_tick, 2);
        record.time_ns = 7'000'000'000 + later_ns;
        recording.ring.push(record);
    }
    ASSERT_TRUE(recording.writer->close());
    auto reader = RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader);
    EXPECT_EQ(examine(*reader, 0).backward_times, 3u);
    EXPECT_EQ(examine(*reader, 0).longest_interval_ns, 4);
}

}  // namespace burin::record
