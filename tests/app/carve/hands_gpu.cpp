// SPDX-License-Identifier: MIT
// Sessions with several hands by the command line: recorded, done again to the bit, and refused by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kHandsBurin = kBurinCommand;
const std::string kTwoHands = "--device right=simulated --device left=simulated";
// A coarse piece; the window is the script's, whose mouse moves by its pixels.
const std::string kSmallPiece = " sculpt --workpiece ball:0.08 --resolution 48 --input " +
                                std::string(kSessionsFolder) + "/two-hands.txt --offscreen ";

// The rows of a column of a part, as the file has them.
std::vector<double> column_of(const Workplace& at, const std::string& file, const std::string& part,
                              const std::string& column) {
    const auto outcome =
        at.run(kHandsBurin + " convert " + file + " - --to csv --part " + part + " --columns " + column);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    std::istringstream lines(outcome.output);
    std::vector<double> rows;
    for (std::string line; std::getline(lines, line);) {
        char* end = nullptr;
        const double value = std::strtod(line.c_str(), &end);
        if (end != line.c_str()) rows.push_back(value);
    }
    return rows;
}

}  // namespace

TEST(Hands, TwoAtOnePieceAreRecordedAndDoneAgainToTheBit) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const auto recorded = at.run(kHandsBurin + kSmallPiece + kTwoHands + " --record " + (at / "two.session").string() +
                                 " --outputs " + (at / "out").string());
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto replayed = at.run(kHandsBurin + " replay two.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    const auto info = at.run(kHandsBurin + " session info two.session");
    EXPECT_TRUE(info.output.contains("\nright: ")) << info.output;
    EXPECT_TRUE(info.output.contains("\nleft: ")) << info.output;
    EXPECT_EQ(at.run(kHandsBurin + " session check two.session").status, 0);
    // The right one has felt the piece; the left one has turned it, and its buttons say so.
    const auto of = [&](const char* part, const char* column) { return column_of(at, "two.session", part, column); };
    EXPECT_TRUE(std::ranges::any_of(of("right", "commanded_force_device_z_N"), [](double n) { return n > 0.5; }));
    EXPECT_TRUE(std::ranges::any_of(of("left", "buttons"), [](double bits) { return bits == 2.0; }));
    EXPECT_TRUE(std::ranges::none_of(of("right", "buttons"), [](double bits) { return bits == 2.0; }));
}

TEST(Hands, ARecordingOfTwoIsRefusedWhereOneIsLeft) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("s.txt", "burin-input 1 test\n0.1 mouse 100 100\n0.3 close\n");
    const std::string short_one = kHandsBurin +
                                  " sculpt --workpiece ball:0.08 --resolution 32 --width 320 --height 180 --input "
                                  "s.txt --offscreen " +
                                  kTwoHands;
    ASSERT_EQ(at.run(short_one + " --record two.session").status, 0);
    const auto replayed = at.run(kHandsBurin + " replay two.session --set hands=");
    EXPECT_EQ(replayed.status, 1);
    EXPECT_TRUE(replayed.output.contains("--device that it was recorded with")) << replayed.output;
    const auto as_text = at.run(short_one + " --record two.log");
    EXPECT_EQ(as_text.status, 1);
    EXPECT_TRUE(as_text.output.contains("record into a session file")) << as_text.output;
}

TEST(Hands, ARecordingFromWhichABlockWasTakenIsNotEqual) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    if (at.run("/usr/bin/python3 -c 'import sqlite3'").status != 0)
        GTEST_SKIP() << "no python3 to change the file with";
    at.write("s.txt", "burin-input 1 test\n0.1 mouse 100 100\n1.0 mouse 120 100\n2.6 mouse 100 100\n3.2 close\n");
    ASSERT_EQ(
        at.run(kHandsBurin +
               " sculpt --workpiece ball:0.08 --resolution 16 --width 320 --height 180 --input s.txt --offscreen " +
               kTwoHands + " --record two.session")
            .status,
        0);
    at.write("cut.py",
             "import sqlite3, shutil, sys\n"
             "hand, skip = sys.argv[1], sys.argv[2]\n"
             "shutil.copy('two.session', 'cut.session')\n"
             "d = sqlite3.connect('cut.session')\n"
             "d.execute('delete from block where id = (select id from block where hand = ? order by tick0 desc '\n"
             "          'limit 1 offset ?)', (hand, skip))\n"
             "d.commit()\n");
    for (const char* const cut : {"0 0", "1 0", "0 1", "1 1"}) {
        ASSERT_EQ(at.run(std::string("/usr/bin/python3 cut.py ") + cut).status, 0);
        const auto replayed = at.run(kHandsBurin + " replay cut.session");
        EXPECT_EQ(replayed.status, 1) << cut << "\n" << replayed.output;
        EXPECT_TRUE(replayed.output.contains("is damaged")) << cut << "\n" << replayed.output;
    }
}

// A recording says what it is of, what was touched in it, and notices rows that a replay of its ticks does not read.
TEST(Hands, ARecordingOfAWorldNamesItsCommandItsTouchesAndWhatWasChangedInIt) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    if (at.run("/usr/bin/python3 -c 'import sqlite3'").status != 0)
        GTEST_SKIP() << "no python3 to change the file with";
    const auto recorded =
        at.run(kHandsBurin + " world " + std::string(kSessionsFolder) + "/../worlds/garden.toml --input " +
               kSessionsFolder + "/garden.txt --offscreen --record a.session --outputs out");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto info = at.run(kHandsBurin + " session info a.session");
    EXPECT_TRUE(info.output.contains("burin world --world")) << info.output;
    EXPECT_FALSE(info.output.contains("burin sculpt")) << info.output;
    const auto bids = at.run(kHandsBurin + " convert a.session set --to bids");
    EXPECT_EQ(bids.status, 0) << bids.output;
    const auto events = at.run("cat set/sub-01/motion/sub-01_task-touch_tracksys-hand_events.tsv");
    EXPECT_TRUE(events.output.contains("\t0\ttouches\tstone\tn/a\n")) << events.output;
    EXPECT_TRUE(events.output.contains("\t0\tleaves\tstone\tn/a\n")) << events.output;

    EXPECT_EQ(at.run(kHandsBurin + " replay a.session").status, 0);
    const auto other = at.run(kHandsBurin + " replay a.session --set device=simulated-wand");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(other.output.contains("is another device than the recorded one, simulated")) << other.output;
    at.write("change.py",
             "import sqlite3, shutil, sys\n"
             "shutil.copy('a.session', 'b.session')\n"
             "d = sqlite3.connect('b.session')\n"
             "d.execute(sys.argv[1])\n"
             "d.commit()\n");
    for (const char* const change :
         {"\"update event set value = 'mushroom' where id = 1\"", "'delete from event where id = 2'",
          "'delete from event'", "\"insert into event(time_ns, name, value) values(1, 'touches', 'stone')\"",
          "\"update meta set value = 'another' where key = 'command'\"", "'delete from clock where id = 1'"}) {
        ASSERT_EQ(at.run(std::string("/usr/bin/python3 change.py ") + change).status, 0) << change;
        const auto replayed = at.run(kHandsBurin + " replay b.session");
        EXPECT_EQ(replayed.status, 1) << change << "\n" << replayed.output;
        EXPECT_FALSE(replayed.output.contains("columns: equal to the bit")) << change << "\n" << replayed.output;
    }
}

TEST(Hands, AReplayRefusesAnotherWandInAnyHandAndChangesWithoutEffect) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    at.write("s.txt", "burin-input 1 test\n0.1 mouse 100 100\n0.3 close\n");
    const std::string wand = "name = \"a wand\"\n[[point]]\nname = \"top\"\noffset = [0, 0.03, 0]\n";
    at.write("w.toml", wand);
    ASSERT_EQ(at.run(kHandsBurin +
                     " sculpt --workpiece ball:0.08 --resolution 16 --width 320 --height 180 --input s.txt --offscreen "
                     "--device right=simulated --device left=simulated-wand:w.toml --record two.session")
                  .status,
              0);
    const std::string replay = kHandsBurin + " replay two.session";
    EXPECT_EQ(at.run(replay).status, 0);
    const auto single = at.run(replay + " --set device=simulated-wand");
    EXPECT_EQ(single.status, 1);
    EXPECT_TRUE(single.output.contains("the recording has several hands")) << single.output;
    const auto as_text = at.run(kHandsBurin + " convert two.session two.log --to log");
    EXPECT_EQ(as_text.status, 1);
    EXPECT_TRUE(as_text.output.contains("a log as text cannot hold")) << as_text.output;
    at.write("w.toml", wand + "# another one\n");
    const auto other = at.run(replay);
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(other.output.contains("is another wand of hand left")) << other.output;
}

TEST(Hands, WhatIsWrongWithADeviceIsSaidBeforeAWindowOpens) {
    const Workplace at;
    const auto of = [&](const std::string& devices) {
        return at.run(kHandsBurin + " sculpt --workpiece ball:0.08 --resolution 16 --live " + devices);
    };
    const auto twice = of("--device right=simulated --device right=simulated-wand");
    EXPECT_EQ(twice.status, 2);
    EXPECT_TRUE(twice.output.contains("a second device of one name")) << twice.output;
    const auto alone = of("--device right=simulated --device simulated");
    EXPECT_EQ(alone.status, 2);
    EXPECT_TRUE(alone.output.contains("does not say whose device it is")) << alone.output;
    const auto carved =
        at.run(kHandsBurin + " sculpt --workpiece ball:0.08 --resolution 16 --stroke none.csv " + kTwoHands);
    EXPECT_EQ(carved.status, 1);
    EXPECT_TRUE(carved.output.contains("several hands, which belong to a session")) << carved.output;
}

TEST(Hands, FourFingersFeelAWorldAndAreDoneAgainToTheBit) {
    if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    const Workplace at;
    const auto recorded = at.run(kHandsBurin + " world " + std::string(kSessionsFolder) +
                                 "/../worlds/garden.toml --device simulated-fingers --input " + kSessionsFolder +
                                 "/fingers.txt --offscreen "
                                 "--width 320 --height 180 --record " +
                                 (at / "fingers.session").string() + " --outputs " + (at / "out").string());
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto replayed = at.run(kHandsBurin + " replay fingers.session");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
    for (const char* finger : {"thumb", "index", "middle", "ring"})
        EXPECT_GT(column_of(at, "fingers.session", finger, "tick").size(), 1000u) << finger;
}

}  // namespace burin::app
