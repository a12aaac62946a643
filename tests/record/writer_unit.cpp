// SPDX-License-Identifier: MIT
// The writer: what it is given is in the file with the same bits, it never touches what is there, and it says what goes
// wrong and how far it came.
#include "record/record_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <condition_variable>
#include <filesystem>

#include "record/database.hpp"
#include "record/examination.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;

// Lets a disk that refuses be given up soon.
WriterOptions on_failing_disk(Nanoseconds patience_ns) {
    WriterOptions options;
    options.vfs = test::FailingDisk::kName;
    options.patience_ns = patience_ns;
    return options;
}

// Waits for something that the writer's thread will do; the bound guards the run alone.
template <typename Condition>
bool comes_true(const Condition& condition) {
    MonotonicClock clock;
    const Nanoseconds end_ns = clock.now_ns() + 60 * kNanosecondsPerSecond;
    while (!condition() && clock.now_ns() < end_ns) clock.sleep_until(clock.now_ns() + 1'000'000);
    return condition();
}

}  // namespace

TEST(RecordWriter, KeepsEveryTickWithEveryBit) {
    const Workplace at;
    const std::string path = at / "a.session";
    test::Recording recording;
    std::uint64_t seen = 0;
    WriterOptions options;
    options.on_record = [&](std::size_t, const haptics::TickRecord& record) { EXPECT_EQ(record.tick, ++seen); };
    ASSERT_TRUE(recording.begin(path, options));
    recording.push(3500);
    ASSERT_TRUE(recording.writer->close());
    EXPECT_EQ(recording.writer->acknowledged(), 3500u);
    EXPECT_EQ(*test::sound_ticks(path), 3500u);
    EXPECT_EQ(seen, 3500u);
    EXPECT_EQ(at.files(), 1u) << "the file travels alone";
    const auto reader = RecordReader::open(path);
    EXPECT_EQ(reader->hands()[0].columns, columns_for(test::device_with(2), test::probe_of(2)));
    EXPECT_TRUE(reader->is_closed());
    EXPECT_EQ(reader->facts().at("end"), "regular");
}

TEST(RecordWriter, TicksAreOnTheDiskAfterASecondOfThemWhileItGoesOn) {
    const Workplace at;
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session"));
    recording.push(2600);
    EXPECT_GE(recording.writer->acknowledged(), 2000u) << "a block is full with the first tick a second later";
    recording.writer.reset();
    EXPECT_EQ(*test::sound_ticks(at / "a.session"), 2600u) << "the destructor closes";
}

TEST(RecordWriter, NeverTouchesAnythingThatExists) {
    const Workplace at;
    test::Recording recording;
    for (const std::string name : {"text", "folder", "link"}) {
        if (name == "text") at.write("text", "precious");
        if (name == "folder") fs::create_directory(at / "folder");
        if (name == "link") fs::create_symlink(at / "nowhere", at / "link");
        const auto refused = recording.begin(at / name);
        ASSERT_FALSE(refused) << name;
        EXPECT_NE(refused.error().line().find("never overwrites"), std::string::npos) << refused.error().line();
        EXPECT_FALSE(check_new_place(at / name)) << name;
    }
    EXPECT_EQ(at.read("text"), "precious");
    at.write("b.session-wal", "ticks of a file that has been taken away");
    EXPECT_FALSE(recording.begin(at / "b.session"));
    EXPECT_FALSE(check_new_place(at / "b.session"));
    EXPECT_EQ(at.read("b.session-wal"), "ticks of a file that has been taken away");
    EXPECT_FALSE(fs::exists(at / "b.session"));
    EXPECT_FALSE(recording.begin(at / "no/such/folder.session"));
    EXPECT_FALSE(recording.begin("/proc/a.session")) << "a folder that takes no files";
}

TEST(RecordWriter, ASecondOneOnTheSameFileIsRefusedAndReadersWaitUntilTheEnd) {
    const Workplace at;
    test::Recording first, second;
    ASSERT_TRUE(first.begin(at / "a.session"));
    first.push(1500);
    EXPECT_FALSE(second.begin(at / "a.session"));
    const auto reader = RecordReader::open(at / "a.session");
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().line().find("in use by another program"), std::string::npos) << reader.error().line();
    first.push(1500);
    ASSERT_TRUE(first.writer->close());
    EXPECT_EQ(*test::sound_ticks(at / "a.session"), 3000u);
}

TEST(RecordWriter, LinesEventsTrialsAndClocksAreKeptInTheirOrder) {
    const Workplace at;
    test::Recording recording;
    WriterOptions options;
    options.facts = {{"program", "test"}};
    ASSERT_TRUE(recording.begin(at / "a.session", options));
    for (int i = 0; i < 100; ++i) recording.writer->note_line(i, "line " + std::to_string(i) + " \"quoted\"'; --");
    const std::int64_t done = recording.writer->begin_trial(5, "one"), open = recording.writer->begin_trial(6, "two");
    EXPECT_NE(done, open);
    recording.writer->note_event(7, "touched", "wall", done);
    recording.writer->end_trial(done, 9, "done");
    recording.push(10);
    ASSERT_TRUE(recording.writer->close());
    auto reader = RecordReader::open(at / "a.session");
    int next = 0;
    ASSERT_TRUE(reader->each_line([&](std::int64_t time_ns, const std::string& text) {
        EXPECT_EQ(time_ns, next);
        EXPECT_EQ(text, "line " + std::to_string(next++) + " \"quoted\"'; --");
    }));
    EXPECT_EQ(next, 100);
    const auto trials = *reader->trials();
    ASSERT_EQ(trials.size(), 2u);
    EXPECT_EQ(trials[0].state, "done");
    EXPECT_EQ(trials[0].ended_ns, 9);
    EXPECT_EQ(trials[1].state, "open") << "a trial that was never ended says so";
    ASSERT_EQ(reader->events()->size(), 1u);
    EXPECT_EQ(reader->events()->front().value, "wall");
    EXPECT_GE(reader->clocks()->size(), 2u);
    EXPECT_EQ(reader->facts().at("program"), "test");
}

TEST(RecordWriter, HandsHaveColumnsAndBlocksOfTheirOwn) {
    const Workplace at;
    Ring<haptics::TickRecord> left(1024), right(1024);
    auto writer = RecordWriter::create(at / "a.session",
                                       {{"left", test::device_with(0), test::probe_of(1), &left},
                                        {"right", test::device_with(8), test::probe_of(20), &right}},
                                       {});
    ASSERT_TRUE(writer);
    for (std::uint64_t tick = 1; tick <= 500; ++tick) {
        left.push(test::made_tick(tick, 1));
        if (tick % 2 == 0) right.push(test::made_tick(tick, 20));
    }
    ASSERT_TRUE((*writer)->close());
    EXPECT_EQ((*writer)->acknowledged(0), 500u);
    EXPECT_EQ((*writer)->acknowledged(1), 500u);
    auto reader = RecordReader::open(at / "a.session");
    ASSERT_EQ(reader->hands().size(), 2u);
    EXPECT_EQ(reader->hands()[0].rows(), 500u);
    EXPECT_EQ(reader->hands()[1].rows(), 250u);
    EXPECT_EQ(examine(*reader, 1).gaps.size(), 249u) << "every other tick";
    EXPECT_EQ(reader->block(1, 0)->at(0, 3), 8u);
}

TEST(RecordWriter, AnHourWithoutTicksAndTimesThatRunBackwardsBeginNewBlocks) {
    const Workplace at;
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session"));
    constexpr Nanoseconds kHour_ns = 3600 * kNanosecondsPerSecond;
    for (const Nanoseconds later_ns : {Nanoseconds{0}, kHour_ns, kHour_ns / 2}) {
        for (int i = 0; i < 100; ++i) {
            haptics::TickRecord record = test::made_tick(++recording.last_tick, 2);
            record.time_ns += later_ns;
            recording.ring.push(record);
        }
    }
    ASSERT_TRUE(recording.writer->close());
    auto reader = RecordReader::open(at / "a.session");
    ASSERT_EQ(reader->hands()[0].blocks.size(), 3u);
    EXPECT_EQ(reader->hands()[0].blocks[1].header.t0_ns, test::made_tick(101).time_ns + kHour_ns);
    const HandExamination found = examine(*reader, 0);
    EXPECT_EQ(found.ticks, 300u);
    EXPECT_TRUE(found.gaps.empty()) << "no tick was lost";
    EXPECT_EQ(found.backward_times, 1u);
}

TEST(RecordWriter, ADiskThatStallsForSecondsLosesNothing) {
    const Workplace at;
    test::FailingDisk& disk = test::failing_disk();
    disk.reset();
    test::Recording recording(kRingTicks);
    ASSERT_TRUE(recording.begin(at / "a.session", on_failing_disk(kNanosecondsPerSecond)));
    std::atomic<bool> stalls{false}, goes_on{false};
    disk.set_before_sync([&] {
        stalls = true;
        goes_on.wait(false);
    });
    for (std::uint64_t tick = 1; tick <= 1100; ++tick) recording.ring.push(test::made_tick(tick, 2));
    ASSERT_TRUE(comes_true([&] { return stalls.load(); }));
    // Ten seconds of ticks come while the disk does nothing.
    for (std::uint64_t tick = 1101; tick <= 11100; ++tick)
        ASSERT_TRUE(recording.ring.push(test::made_tick(tick, 2))) << tick;
    EXPECT_EQ(recording.writer->acknowledged(), 0u) << "nothing is acknowledged that is not on the disk";
    goes_on = true;
    goes_on.notify_all();
    disk.set_before_sync({});
    ASSERT_TRUE(recording.writer->close());
    EXPECT_EQ(*test::sound_ticks(at / "a.session"), 11100u);
}

TEST(RecordWriter, OfADiskThatIsFullWhatWasAcknowledgedStaysAndTheEndSaysHowFarItCame) {
    for (const bool sync_fails : {false, true}) {
        const Workplace at;
        test::FailingDisk& disk = test::failing_disk();
        disk.reset();
        test::Recording recording;
        ASSERT_TRUE(recording.begin(at / "a.session", on_failing_disk(0)));
        recording.push(5200);
        const std::uint64_t acknowledged = recording.writer->acknowledged();
        EXPECT_GE(acknowledged, 5000u);
        (sync_fails ? disk.does_not_sync : disk.is_full) = true;
        recording.push(3000);
        ASSERT_TRUE(recording.writer->failure());
        EXPECT_GE(recording.writer->acknowledged(), acknowledged);
        const std::string line = recording.writer->failure()->line();
        EXPECT_NE(line.find(sync_fails ? "cannot be read or written" : "the disk is full"), std::string::npos) << line;
        EXPECT_NE(line.find("up to tick " + std::to_string(recording.writer->acknowledged())), std::string::npos)
            << line;
        const std::uint64_t kept = recording.writer->acknowledged();
        const auto closed = recording.writer->close();
        ASSERT_FALSE(closed);
        EXPECT_EQ(closed.error().line(), line);
        disk.reset();
        const auto found = test::sound_ticks(at / "a.session");
        ASSERT_TRUE(found) << found.error().line();
        EXPECT_GE(*found, kept);
    }
}

// What the disk refused counts as lost, whether it was in a block that waited, in one that was being filled, or came
// after the end: what is kept and what is lost is all that was made.
TEST(RecordWriter, OfADiskThatIsFullWhatIsKeptAndWhatIsLostIsAllThatWasMade) {
    const Workplace at;
    test::FailingDisk& disk = test::failing_disk();
    disk.reset();
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session", on_failing_disk(kNanosecondsPerSecond / 5)));
    recording.push(2500);
    disk.is_full = true;
    recording.push(2700);  // blocks wait while the disk is given time
    EXPECT_FALSE(recording.writer->failure()) << "blocks were to wait";
    ASSERT_TRUE(comes_true([&] {
        recording.push(1);
        return recording.writer->failure().has_value();
    }));
    recording.push(300);
    disk.reset();  // the facts of the end find room
    ASSERT_FALSE(recording.writer->close());
    const auto reader = RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader) << reader.error().line();
    const std::uint64_t kept = reader->hands()[0].rows();
    ASSERT_GT(kept, 0u);
    ASSERT_TRUE(reader->facts().contains("ticks lost, hand 0"));
    EXPECT_EQ(kept + std::stoull(reader->facts().at("ticks lost, hand 0")), recording.last_tick);
}

TEST(RecordWriter, ADiskThatHasRoomAgainGetsWhatHasWaited) {
    const Workplace at;
    test::FailingDisk& disk = test::failing_disk();
    disk.reset();
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session", on_failing_disk(600 * kNanosecondsPerSecond)));
    recording.push(1500);
    disk.is_full = true;
    recording.push(4000);
    EXPECT_LE(recording.writer->acknowledged(), 1500u);
    EXPECT_FALSE(recording.writer->failure()) << "it is patient";
    disk.is_full = false;
    ASSERT_TRUE(recording.writer->close());
    EXPECT_EQ(*test::sound_ticks(at / "a.session"), 5500u);
}

TEST(RecordWriter, AFileThatIsDeletedIsNoticedAndItsContentsAreSaved) {
    const Workplace at;
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session"));
    recording.push(2500);
    const std::uint64_t kept = recording.writer->acknowledged();
    fs::remove(at / "a.session");
    recording.push(1500);
    ASSERT_TRUE(recording.writer->failure());
    EXPECT_NE(recording.writer->failure()->line().find("taken away"), std::string::npos);
    EXPECT_FALSE(recording.writer->close());
    EXPECT_FALSE(fs::exists(at / "a.session"));
    const auto saved = test::sound_ticks(at / "a.session.saved");
    ASSERT_TRUE(saved) << saved.error().line();
    EXPECT_GE(*saved, kept);
}

TEST(RecordWriter, AFileThatIsMovedAwayKeepsWhatWasAcknowledgedAndWhatTookItsPlaceIsLeftAlone) {
    const Workplace at;
    test::Recording recording;
    ASSERT_TRUE(recording.begin(at / "a.session"));
    recording.push(2500);
    const std::uint64_t kept = recording.writer->acknowledged();
    fs::rename(at / "a.session", at / "moved.session");
    at.write("a.session", "somebody else's");
    recording.push(1500);
    ASSERT_TRUE(recording.writer->failure());
    EXPECT_FALSE(recording.writer->close());
    EXPECT_EQ(at.read("a.session"), "somebody else's");
    const auto found = test::sound_ticks(at / "moved.session");
    ASSERT_TRUE(found) << found.error().line();
    EXPECT_GE(*found, kept);
}

TEST(RecordWriter, TicksThatARingCouldNotHoldAreCountedAndShowAsAGap) {
    const Workplace at;
    test::FailingDisk& disk = test::failing_disk();
    disk.reset();
    test::Recording recording(256);
    ASSERT_TRUE(recording.begin(at / "a.session", on_failing_disk(kNanosecondsPerSecond)));
    std::atomic<bool> stalls{false}, goes_on{false};
    recording.push(1001);
    disk.set_before_sync([&] {
        stalls = true;
        goes_on.wait(false);
    });
    for (std::uint64_t tick = 1002; !stalls; ++tick) {  // until the next block is full, and its transaction hangs
        recording.ring.push(test::made_tick(tick, 2));
        recording.last_tick = tick;
        if (recording.ring.waiting() > 200) comes_true([&] { return stalls || recording.ring.waiting() == 0; });
    }
    std::uint64_t refused = 0, tick = recording.last_tick;
    for (int i = 0; i < 1000; ++i) refused += recording.ring.push(test::made_tick(++tick, 2)) ? 0 : 1;
    EXPECT_GE(refused, 700u);
    goes_on = true;
    goes_on.notify_all();
    disk.set_before_sync({});
    recording.writer->take_now();
    recording.ring.push(test::made_tick(++tick, 2));
    ASSERT_TRUE(recording.writer->close());
    auto reader = RecordReader::open(at / "a.session");
    EXPECT_EQ(reader->facts().at("ticks lost, hand 0"), std::to_string(refused));
    const HandExamination found = examine(*reader, 0);
    ASSERT_EQ(found.gaps.size(), 1u);
    EXPECT_EQ(found.gaps[0].missing, static_cast<std::int64_t>(refused));
    EXPECT_EQ(found.ticks + refused, tick);
}

}  // namespace burin::record
