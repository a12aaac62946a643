// SPDX-License-Identifier: MIT
// burin replay, as a user's shell runs it: a world and a felt stroke are recorded and done again.
#include <gtest/gtest.h>

#include <bit>

#include <filesystem>
#include <fstream>

#include "base/json.hpp"
#include "haptics/tick_flag.hpp"
#include "record/derived.hpp"
#include "record/row_walk.hpp"
#include "tests/app/recordings/small_world.hpp"
#include "tests/support/places.hpp"

namespace burin::app {
namespace {

using namespace test;

const std::string kReplayBurin = kBurinCommand;

}  // namespace

TEST(RecordedWorld, HoldsEveryTickTheTouchedObjectsAndWhatItWas) {
    const Workplace at;
    write_small_world(at);
    const auto recorded = record_small_world(at, kReplayBurin);
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(says_so(recorded, "a.session: 2400 ticks recorded")) << recorded.output;
    EXPECT_TRUE(
        says_so(at.run(kReplayBurin + " session check a.session"), "2400 ticks read, 0 blocks damaged, 0 gaps"));
    const auto info = at.run(kReplayBurin + " session info a.session");
    for (const char* words :
         {"object 1: floor", "object 2: lift", "object0", "world sha256", "\"tool_radius_m\":0.003"})
        EXPECT_TRUE(says_so(info, words)) << words << info.output;
    // The object of each tick: the floor first, then the lift, each only in contact, and nothing in free space.
    auto reader = record::RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader);
    const record::HandRecord& hand = reader->hands()[0];
    const std::size_t object = record::find_column(hand, "object0", record::ColumnType::u32),
                      flags = record::find_column(hand, "flags", record::ColumnType::u32),
                      x = record::find_column(hand, "proxy0_object_x_m", record::ColumnType::f64);
    std::array<std::size_t, 3> ticks{};
    record::RowWalk walk(*reader, 0);
    while (*walk.next()) {
        const record::Word number = walk.at(object);
        ASSERT_LE(number, 2u);
        ++ticks[number];
        const bool in_contact = (walk.at(flags) & haptics::kTickInContact) != 0;
        EXPECT_EQ(number != 0, in_contact);
        if (number != 0) {
            EXPECT_EQ(number, std::bit_cast<double>(walk.at(x)) < 0.015 ? 1u : 2u);
        }
    }
    EXPECT_GT(ticks[1], 200u);
    EXPECT_GT(ticks[2], 200u);
    EXPECT_GT(ticks[0], 200u);
    const auto again = record_small_world(at, kReplayBurin);
    EXPECT_EQ(again.status, 1);
    EXPECT_TRUE(says_so(again, "never overwrites")) << again.output;
}

TEST(RecordedWorld, GivesTheSameFiguresWithAndWithoutARecording) {
    const Workplace at;
    write_small_world(at);
    const std::string explore = kReplayBurin + " world w.toml --stroke s.csv --report r.json";
    ASSERT_EQ(at.run(explore).status, 0);
    const std::string table = at.read("r-felt.csv"), report = at.read("r.json");
    ASSERT_EQ(at.run(explore + " --record a.session").status, 0);
    EXPECT_EQ(at.read("r-felt.csv"), table);
    EXPECT_EQ(at.read("r.json"), report);
}

TEST(ReplayOfAWorld, IsEqualToTheBitAndTellsTheFirstDifference) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kReplayBurin).status, 0);
    const auto same = at.run(kReplayBurin + " replay a.session --json r.json");
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_EQ(same.output, "a.session: 2400 ticks, 80 columns: equal to the bit\n");
    EXPECT_TRUE(Json::parse(at.read("r.json"))["difference"].is_null());
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --from 500 --to 1200").output,
              "a.session: 701 ticks, 80 columns: equal to the bit\n");

    // One parameter is another one.
    change(at, copied(at, "b.session"),
           "UPDATE meta SET value = replace(value, '0.003', '0.0031') WHERE key = 'exploration'");
    const auto other = at.run(kReplayBurin + " replay b.session --json r2.json");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says_so(other, "b.session: differs after ")) << other.output;
    const Json difference = Json::parse(at.read("r2.json"))["difference"];
    ASSERT_TRUE(difference.is_object());
    EXPECT_NE(difference["recorded"], difference["again"]);
    const std::string told =
        "tick " + std::to_string(difference["tick"].get<int>()) + ", " + difference["column"].get<std::string>() +
        ": recorded " + difference["recorded"].get<std::string>() + ", again " + difference["again"].get<std::string>();
    EXPECT_TRUE(says_so(other, told)) << other.output;
    const std::string before = std::to_string(difference["tick"].get<int>() - 1);
    const auto part = at.run(kReplayBurin + " replay b.session --to " + before);
    EXPECT_FALSE(says_so(part, "differs after ")) << "what is before is equal: " << part.output;
}

TEST(ReplayOfAWorld, IsRefusedWhereItCannotBeExactOrMakesNoSense) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kReplayBurin).status, 0);
    const auto refused = [&](const std::string& file, const std::string& sql, const std::string& said) {
        change(at, copied(at, file), sql);
        const auto outcome = at.run(kReplayBurin + " replay " + file);
        EXPECT_EQ(outcome.status, 1) << sql;
        EXPECT_TRUE(says_so(outcome, said)) << outcome.output;
    };
    refused("1", "UPDATE meta SET value = '9.9' WHERE key = 'version'", "was recorded by Burin 9.9");
    refused("2", "UPDATE meta SET value = '{}' WHERE key = 'exploration'", "no sound value for tool_radius_m");
    refused("3", "UPDATE meta SET value = 'null' WHERE key = 'exploration'", "no sound value for tool_radius_m");
    refused("4", "UPDATE meta SET value = replace(value, '\"reach_m\":', '\"reach_m\":-') WHERE key = 'exploration'",
            "cannot be felt");
    refused("12",
            "UPDATE meta SET value = replace(value, '\"shading\":true', '\"shading\":1') WHERE key = 'exploration'",
            "no sound value for shading");
    refused("5", "DELETE FROM meta WHERE key = 'activity'", "does not hold what a replay needs");
    refused("6", "DELETE FROM line WHERE id > 100", "lines are there");
    refused("7", "DELETE FROM block WHERE id = 2", "is followed by tick 2001");
    refused("8", "UPDATE block SET data = zeroblob(9) WHERE id = 2", "check sum is wrong");
    refused("9", "UPDATE column SET unit = 'mm' WHERE name = 'hip0_object_x_m'", "has other columns");
    refused("10", "UPDATE hand SET name = 'Falcon'", "something was changed since it was recorded");
    refused("11", "UPDATE line SET time_ns = 9223372036854775807", "something was changed since it was recorded");
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --to 900").status, 0);
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay a.session --set friction=0.3"), "has a hand of its own"));
    EXPECT_EQ(at.run(kReplayBurin + " replay none.session").status, 1);
    EXPECT_EQ(at.run(kReplayBurin + " replay s.csv").status, 1);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --radius 0.01").status, 2);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --from 9 --to 3").status, 2);
    EXPECT_EQ(at.run(kReplayBurin + " replay").status, 2);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --json a.session").status, 1);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session").status, 0);
    // The world: another comment is the same world, another material is not; one that has moved is named.
    std::ofstream(at / "w.toml", std::ios::app) << "# a comment\n";
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session").status, 0);
    std::filesystem::rename(at / "w.toml", at / "moved.toml");
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay a.session"), "say where it is now by --world FILE"));
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --world moved.toml").status, 0);
    at.write("w.toml", cube_world("stiffness = 300"));
    const auto another = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(another.status, 1);
    EXPECT_TRUE(says_so(another, "is another world than the one that was recorded")) << another.output;
}

// "0 ticks: equal to the bit" looks like success.
TEST(ReplayOfAWorld, OfNoTickAtAllIsAnErrorAndNoEquality) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kReplayBurin).status, 0);
    for (const std::string range : {" --to 0", " --from 2401", " --from 90000 --to 90001"})
        for (const std::string how : {"", " --through w.toml"}) {
            const auto outcome = at.run(kReplayBurin + " replay a.session" + how + range);
            EXPECT_EQ(outcome.status, 1) << how << range;
            EXPECT_TRUE(says_so(outcome, "has no ticks in this range: its first is 1, its last 2400"))
                << outcome.output;
        }
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --from 0 --to 1").output,
              "a.session: 1 ticks, 80 columns: equal to the bit\n");
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --from 2400 --to 9999").output,
              "a.session: 1 ticks, 80 columns: equal to the bit\n");
    change(at, copied(at, "gap.session"), "DELETE FROM block WHERE id = 2");
    EXPECT_EQ(at.run(kReplayBurin + " replay gap.session --from 1001 --to 1002").status, 1) << "they are missing";

    change(at, copied(at, "none.session"), "DELETE FROM block");
    copied(at, "kept.session");
    std::filesystem::copy_file(at / "none.session", at / "also.session");
    for (const std::string command : {" replay none.session", " replay none.session --through w.toml",
                                      " session check none.session", " session compare none.session also.session"}) {
        const auto outcome = at.run(kReplayBurin + command);
        EXPECT_EQ(outcome.status, 1) << command;
        EXPECT_TRUE(says_so(outcome, "none.session: holds no ticks") ||
                    says_so(outcome, "also.session: holds no ticks"))
            << outcome.output;
    }
    EXPECT_EQ(at.run(kReplayBurin + " session check kept.session").status, 0);
}

TEST(ReplayOfAWorld, WritesNothingOverTheRecordingOrAFileThatItNames) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kReplayBurin).status, 0);
    const std::string world = at.read("w.toml");
    std::filesystem::create_directory(at / "sub");
    for (const std::string command :
         {" replay a.session --json ", " replay a.session --through w.toml --json ", " session info a.session --json "})
        for (const std::string file : {"w.toml", "sub/../w.toml", "cube.off", "s.csv", "a.session", "a.session-wal"}) {
            const auto outcome = at.run(kReplayBurin + command + file);
            EXPECT_EQ(outcome.status, 1) << command << file;
            EXPECT_TRUE(says_so(outcome, "would be overwritten") ||
                        says_so(outcome, "is a file of the recording a.session"))
                << outcome.output;
        }
    EXPECT_EQ(at.read("w.toml"), world);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --json r.json").status, 0);
}

TEST(ReplayOfAWandStroke, IsEqualToTheBitInAllPointsAndTellsTheFirstDifference) {
    const Workplace at;
    write_small_world(at);
    const auto recorded = at.run(kReplayBurin +
                                 " world w.toml --stroke s.csv --device simulated-wand --radius 0.003 "
                                 "--points centre,bottom --record a.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(says_so(recorded, "ticks recorded")) << recorded.output;
    const auto info = at.run(kReplayBurin + " session info a.session");
    for (const char* words : {"object 1: floor", "object1", "hip1_object_x_m", "wand points"})
        EXPECT_TRUE(says_so(info, words)) << words << info.output;
    const auto again = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(says_so(again, "equal to the bit")) << again.output;
    at.write("w.toml", cube_world("stiffness = 310, static_friction = 0.3"));
    const auto changed = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(changed.status, 1);
    EXPECT_TRUE(says_so(changed, "is another world than the one that was recorded")) << changed.output;
    EXPECT_FALSE(says_so(changed, "equal ticks")) << changed.output;
    write_small_world(at);
    change(at, copied(at, "b.session"),
           "UPDATE meta SET value = replace(value, '0.003', '0.0031') WHERE key = 'exploration'");
    const auto other = at.run(kReplayBurin + " replay b.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says_so(other, "equal ticks: tick ")) << other.output;
    const auto twice = at.run(kReplayBurin + " world w.toml --stroke s.csv --device simulated-wand --record a.session");
    EXPECT_EQ(twice.status, 1);
    EXPECT_TRUE(says_so(twice, "never overwrites")) << twice.output;
}

// The wand is as its description says: another one, or none, is refused by its name.
TEST(ReplayOfAWandStroke, IsRefusedWithAnotherWand) {
    const Workplace at;
    write_small_world(at);
    write_small_wand(at);
    ASSERT_EQ(record_with_small_wand(at, kReplayBurin).status, 0);
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session").status, 0);
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " session info a.session"), "6 lines of text"));
    write_small_wand(at, "0.07");
    const auto other = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says_so(other, "wand.toml: is another wand than the one that was recorded")) << other.output;
    std::filesystem::remove(at / "wand.toml");
    const auto none = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(none.status, 1);
    EXPECT_TRUE(says_so(none, "wand.toml: is the description of the recording's wand, and is not there"))
        << none.output;
    EXPECT_TRUE(says_so(none, "put it back")) << none.output;
}

TEST(ReplayOfAFeltStroke, IsEqualToTheBitAndTellsTheFirstDifference) {
    const Workplace at;
    write_small_world(at);
    at.write("press.csv", kStrokeHeader +
                              "0,0.01,0.0135,0.01,0,0,0,1,0\n0.1,0.01,0.011,0.01,0,0,0,1,1\n"
                              "0.3,0.013,0.011,0.01,0,0,0,1,1\n");
    const std::string sculpt = kReplayBurin +
                               " sculpt --workpiece block:0.02,0.01,0.02 --resolution 48 --stroke press.csv --hand "
                               "simulated --press 1 --grain 2 --friction 0.2 --tool ";
    ASSERT_EQ(at.run(sculpt + "ball:0.002 --record a.session").status, 0);
    const auto same = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_TRUE(says_so(same, "a.session: 900 ticks, 74 columns: equal to the bit")) << same.output;
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay a.session --json press.csv"), "is a file of the recording"));
    change(at, copied(at, "b.session"), "UPDATE meta SET value = replace(value, '\"medium\"', '\"soft\"')");
    const auto other = at.run(kReplayBurin + " replay b.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says_so(other, "differs after ") && says_so(other, ": recorded ") && says_so(other, ", again "))
        << other.output;
    // Its motion in a world, with the ball that carved.
    const auto through = at.run(kReplayBurin + " replay a.session --through w.toml");
    EXPECT_EQ(through.status, 0);
    EXPECT_TRUE(says_so(through, "ball of 0.002")) << through.output;
    // Other inputs, and a recording that cannot be done again.
    std::ofstream(at / "press.csv", std::ios::app) << "0.4,0.013,0.012,0.01,0,0,0,1,0\n";
    const auto changed = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(changed.status, 1);
    EXPECT_TRUE(says_so(changed, "press.csv: is another file than the one that was recorded")) << changed.output;
    change(at, copied(at, "c.session"),
           "UPDATE meta SET value = replace(value, '\"real_time\":false', '\"real_time\":true')");
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay c.session"), "was felt in real time"));
    change(at, copied(at, "d.session"), "UPDATE meta SET value = '[1]' WHERE key = 'settings'");
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay d.session"), "no sound value for source"));
    EXPECT_TRUE(says_so(at.run(kReplayBurin + " replay d.session --through w.toml"), "give it by --radius"));
    ASSERT_EQ(at.run(sculpt + "cylinder:0.002,0.004 --record e.session").status, 0);
    EXPECT_EQ(at.run(kReplayBurin + " replay e.session").status, 0);
}

// Felt strokes became sessions, and nothing that is felt in them is another.
TEST(ReplayOfAFeltStroke, OfARecordingFromBeforeStrokesWereSessionsIsEqualToTheBit) {
    const std::filesystem::path old = std::filesystem::absolute("tests/app/recordings/old");
    for (const std::string name : {"ball.session", "cylinder.session"}) {
        const Workplace at;
        std::filesystem::copy_file(old / name, at / name);
        const auto reader = record::RecordReader::open(at / name);
        ASSERT_TRUE(reader) << reader.error().line();
        if (reader->fact("compiler") != __VERSION__) GTEST_SKIP() << "another compiler's program";
        const auto again =
            at.run(kReplayBurin + " replay " + name + " --stroke '" + (old / "press.csv").string() + "'");
        EXPECT_EQ(again.status, 0) << again.output;
        EXPECT_TRUE(says_so(again, name + ": 700 ticks, 74 columns: equal to the bit")) << again.output;
    }
}

}  // namespace burin::app
