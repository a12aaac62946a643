// SPDX-License-Identifier: MIT
// Sessions by the command line whose ticks and events are streamed, against a library that stands in for liblsl.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "devices/drivers/library_beside.hpp"
#include "gpu/device.hpp"
#include "record/record_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

std::string with_stand_in() { return "BURIN_LIBLSL=" + devices::library_beside("libburin_lsl_stand_in.so") + " "; }

// Returns the number before these words; 0: they are not there.
std::size_t number_before(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    if (at == std::string::npos || at == 0) return 0;
    const std::size_t begin = text.find_last_not_of("0123456789", at - 1);
    return std::strtoull(text.c_str() + (begin == std::string::npos ? 0 : begin + 1), nullptr, 10);
}

constexpr const char* kShort = "burin-input 1 streams\n0.1 mouse 160 90\n1.5 close\n";
constexpr const char* kBall = " --workpiece ball:0.08 --resolution 32 --offscreen --width 320 --height 180 ";

}  // namespace

TEST(StreamedSession, GivesEveryTickThatItRecordsAndKeepsTheMarkersThatItHears) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", kShort);
    const auto recorded =
        at.run("BURIN_LSL_STAND_IN_XDF=o.xdf BURIN_LSL_STAND_IN_MARKER='the light is on' " + with_stand_in() + burin +
               " sculpt" + kBall + "--device simulated --input s.txt --record o.session --lsl --lsl-markers Keyboard");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const std::size_t streamed = number_before(recorded.output, " ticks and "),
                      kept = number_before(recorded.output, " ticks recorded");
    EXPECT_GT(streamed, 0u) << recorded.output;
    EXPECT_EQ(streamed, kept) << recorded.output;
    EXPECT_TRUE(recorded.output.contains(", 0 ticks and 0 events lost, 1 markers heard")) << recorded.output;
    EXPECT_TRUE(at.read("o.xdf").starts_with("XDF:"));
    auto reader = record::RecordReader::open(at / "o.session");
    ASSERT_TRUE(reader) << reader.error().line();
    const auto events = reader->events().value();
    EXPECT_EQ(std::ranges::count(events, "lsl marker", &record::EventRecord::name), 1);
    EXPECT_EQ(std::ranges::count(events, "Keyboard: the light is on", &record::EventRecord::value), 1);
    // A marker came from outside: what is done again hears none, and is equal all the same.
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(StreamedSession, ThatIsNotRecordedIsPlayedInRealTimeForBothHands) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("s.txt", kShort);
    const auto run = at.run("BURIN_LSL_STAND_IN_XDF=o.xdf " + with_stand_in() + kBurinCommand + " sculpt" + kBall +
                            "--device right=simulated --device left=simulated --input s.txt --lsl");
    ASSERT_EQ(run.status, 0) << run.output;
    EXPECT_GT(number_before(run.output, " ticks and "), 0u) << run.output;
    EXPECT_TRUE(run.output.contains("0 ticks and 0 events lost")) << run.output;
    const std::string xdf = at.read("o.xdf");
    for (const char* name : {"Burin ticks right", "Burin ticks left", "Burin events"})
        EXPECT_TRUE(xdf.contains(name)) << name;
}

TEST(StreamedSession, OfASearchHasItsTrialsAmongTheEvents) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("s.txt", "burin-input 1 seek\n0.1 mouse 640 360\n0.5 command do start\n4 close\n");
    const auto run = at.run("BURIN_LSL_STAND_IN_XDF=o.xdf " + with_stand_in() + kBurinCommand +
                            " seek garden --targets 1 --input s.txt --offscreen --width 320 --height 180 --lsl");
    EXPECT_TRUE(run.output.contains(" ticks and 0 events lost")) << run.output;
    EXPECT_TRUE(at.read("o.xdf").contains("trial begins: ")) << run.output;
}

// A loop whose hand nobody feels rests once the hand has been still for a second, at 14 ms a tick. A stream of a
// thousand samples a second has no use for that. A tick that rested comes long after the one before, and is not late.
TEST(StreamedSession, TicksOnWhereTheLoopOfAStillHandWouldRest) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("s.txt", "burin-input 1 still\n0.1 mouse 160 90\n4 close\n");
    const auto rests = [&](const std::string& file, const std::string& option) {
        const std::string burin = kBurinCommand;
        const auto recorded = at.run(with_stand_in() + burin + " sculpt" + kBall +
                                     "--device simulated --input s.txt --record " + file + option);
        EXPECT_EQ(recorded.status, 0) << recorded.output;
        std::istringstream rows(
            at.run(burin + " convert " + file + " --to csv --columns 'time_ns,lateness_ns' -").output);
        std::size_t count = 0;
        long long before_ns = 0, time_ns = 0, lateness_ns = 0;
        for (std::string row; std::getline(rows, row); before_ns = time_ns) {
            if (std::sscanf(row.c_str(), "%lld,%lld", &time_ns, &lateness_ns) != 2) continue;
            count += before_ns > 0 && time_ns - before_ns > 10'000'000 && lateness_ns < 1'000'000 ? 1 : 0;
        }
        EXPECT_GT(time_ns, 0) << "there are ticks";
        return count;
    };
    EXPECT_EQ(rests("streamed.session", " --lsl"), 0u);
    EXPECT_GT(rests("resting.session", ""), 0u);
}

// pyxdf (github.com/xdf-modules/pyxdf) as the judge, where Python has it: meta-data, order of the stamps, and
// how many ticks there are.
TEST(StreamedSession, IsReadFromXdfByAReaderThatIsNotOurs) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    if (at.run("/usr/bin/python3 -c 'import pyxdf'").status != 0) GTEST_SKIP() << "python3 has no pyxdf";
    at.write("s.txt", kShort);
    const auto run = at.run("BURIN_LSL_STAND_IN_XDF=o.xdf " + with_stand_in() + kBurinCommand + " sculpt" + kBall +
                            "--device right=simulated --device left=simulated --input s.txt --lsl");
    ASSERT_EQ(run.status, 0) << run.output;
    at.write(
        "judge.py",
        "import pyxdf\n"
        "streams, _ = pyxdf.load_xdf('o.xdf', dejitter_timestamps=False)\n"
        "for s in sorted(streams, key=lambda s: s['info']['name'][0]):\n"
        "    t, info = s['time_stamps'], s['info']\n"
        "    channels = info['desc'][0]['channels'][0]['channel']\n"
        "    print(info['name'][0], info['type'][0], len(channels) == int(info['channel_count'][0]),\n"
        "          all(a < b for a, b in zip(t, t[1:])), 'N' in [c.get('unit', [''])[0] for c in channels])\n"
        "print(sum(len(s['time_stamps']) for s in streams if s['info']['type'][0] == 'Haptics'), 'ticks in all')\n");
    const auto judged = at.run("/usr/bin/python3 judge.py");
    ASSERT_EQ(judged.status, 0) << judged.output;
    EXPECT_TRUE(judged.output.contains("Burin events Markers True True False")) << judged.output;
    for (const char* hand : {"right", "left"})
        EXPECT_TRUE(judged.output.contains(std::string("Burin ticks ") + hand + " Haptics True True True"))
            << judged.output;
    EXPECT_EQ(number_before(judged.output, " ticks in all"), number_before(run.output, " ticks and ")) << judged.output;
}

TEST(StreamedSession, EndsByItselfAndIsRecordedWhereTheLibraryNeverReturns) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const std::string burin = kBurinCommand;
    at.write("s.txt", kShort);
    const auto recorded = at.run("BURIN_LSL_STAND_IN_BLOCKS=1 " + with_stand_in() + burin + " sculpt" + kBall +
                                 "--device simulated --input s.txt --record o.session --lsl");
    EXPECT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("streams: 0 ticks and 0 events streamed")) << recorded.output;
    EXPECT_TRUE(recorded.output.contains("the library does not return, and is left behind")) << recorded.output;
    EXPECT_GT(number_before(recorded.output, " ticks recorded"), 0u) << recorded.output;
    EXPECT_TRUE(recorded.output.contains(", 0 lost")) << recorded.output;
    const auto replayed = at.run(burin + " replay o.session");
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

TEST(StreamedSession, WithoutTheLibraryDoesNotBeginAndSaysWhereItCanBeHad) {
    const Workplace at;
    at.write("s.txt", kShort);
    const std::string begun = std::string(kBurinCommand) + " sculpt" + kBall + "--input s.txt";
    const auto run = at.run("BURIN_LIBLSL=/nowhere/liblsl.so " + begun + " --record o.session --lsl");
    EXPECT_EQ(run.status, 1) << run.output;
    EXPECT_TRUE(run.output.contains("github.com/sccn/liblsl/releases")) << run.output;
    EXPECT_EQ(at.files(), 1u) << "the script alone";
    const auto unasked = at.run("BURIN_LIBLSL=/nowhere/liblsl.so " + std::string(kBurinCommand) + " devices");
    EXPECT_TRUE(unasked.output.contains("absent     --lsl: the library /nowhere/liblsl.so")) << unasked.output;
}

TEST(StreamedSession, AlongAStrokeIsRefused) {
    const Workplace at;
    at.write("stroke.csv", kStrokeHeader + "0,0,0,0,0,0,0,1,0\n");
    const auto run =
        at.run(with_stand_in() + kBurinCommand + " sculpt --workpiece ball:0.08 --stroke stroke.csv --lsl");
    EXPECT_NE(run.status, 0) << run.output;
    EXPECT_TRUE(run.output.contains("--stroke")) << run.output;
}

}  // namespace burin::session
