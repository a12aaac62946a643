// SPDX-License-Identifier: MIT
// burin replay, as a user's shell runs it: a world and a felt stroke are recorded, done again, and felt elsewhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/json.hpp"
#include "record/derived.hpp"
#include "record/row_walk.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kReplayBurin = kBurinCommand;

bool says(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

std::string cube_world(const std::string& material, const std::string& path = {}) {
    return "[[object]]\nname = \"floor\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nmaterial = { " + material +
           " }\n[[object]]\nname = \"lift\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.03, 0.0, 0.0]\n" +
           path;
}

// A cube of 20 mm whose top is at y = 0, and one beside it that rises and falls.
void write_small_world(const Workplace& at) {
    at.write("cube.off",
             "OFF\n8 12 0\n-0.01 -0.02 -0.01\n0.01 -0.02 -0.01\n-0.01 0 -0.01\n0.01 0 -0.01\n-0.01 -0.02 0.01\n"
             "0.01 -0.02 0.01\n-0.01 0 0.01\n0.01 0 0.01\n3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n"
             "3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5\n");
    at.write("w.toml", cube_world("stiffness = 300, static_friction = 0.3",
                                  "[[object.path]]\ntime = 0\n[[object.path]]\ntime = 0.5\n"
                                  "position = [0.0, 0.003, 0.0]\n[[object.path]]\ntime = 1\n"));
    at.write("s.csv", kStrokeHeader +
                          "0,0,0.012,0,0,0,0,1,0\n0.4,0,0.001,0,0,0,0,1,0\n0.8,0.004,0.001,0.002,0,0,0,1,0\n"
                          "1.0,0.015,0.012,0,0,0,0,1,0\n1.3,0.03,0.003,0,0,0,0,1,0\n1.8,0.03,0.003,0,0,0,0,1,0\n");
}

Workplace::Outcome record_small_world(const Workplace& at, const std::string& to = "a.session") {
    return at.run(kReplayBurin + " world w.toml --stroke s.csv --radius 0.003 --record " + to);
}

// Runs statements on a session file, as anybody's SQLite can.
void change(const Workplace& at, const std::string& file, const std::string& sql) {
    auto database = record::Database::open(at / file, record::Database::Use::write);
    ASSERT_TRUE(database);
    const auto done = database->run(sql);
    ASSERT_TRUE(done) << done.error().line();
    ASSERT_TRUE(database->close());
}

std::string copied(const Workplace& at, const std::string& file) {
    std::filesystem::copy_file(at / "a.session", at / file);
    return file;
}

}  // namespace

TEST(RecordedWorld, HoldsEveryTickTheTouchedObjectsAndWhatItWas) {
    const Workplace at;
    write_small_world(at);
    const auto recorded = record_small_world(at);
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(says(recorded, "a.session: 2400 ticks recorded")) << recorded.output;
    EXPECT_TRUE(says(at.run(kReplayBurin + " session check a.session"), "2400 ticks read, 0 blocks damaged, 0 gaps"));
    const auto info = at.run(kReplayBurin + " session info a.session");
    for (const char* words :
         {"object 1: floor", "object 2: lift", "object0", "world sha256", "\"tool_radius_m\":0.003"})
        EXPECT_TRUE(says(info, words)) << words << info.output;
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
    const auto again = record_small_world(at);
    EXPECT_EQ(again.status, 1);
    EXPECT_TRUE(says(again, "never overwrites")) << again.output;
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
    ASSERT_EQ(record_small_world(at).status, 0);
    const auto same = at.run(kReplayBurin + " replay a.session --json r.json");
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_EQ(same.output, "a.session: 2400 ticks, 75 columns: equal to the bit\n");
    EXPECT_TRUE(Json::parse(at.read("r.json"))["difference"].is_null());
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --from 500 --to 1200").output,
              "a.session: 701 ticks, 75 columns: equal to the bit\n");

    // One parameter is another one.
    change(at, copied(at, "b.session"),
           "UPDATE meta SET value = replace(value, '0.003', '0.0031') WHERE key = 'settings'");
    const auto other = at.run(kReplayBurin + " replay b.session --json r2.json");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says(other, "b.session: differs after ")) << other.output;
    const Json difference = Json::parse(at.read("r2.json"))["difference"];
    ASSERT_TRUE(difference.is_object());
    EXPECT_NE(difference["recorded"], difference["again"]);
    const std::string told =
        "tick " + std::to_string(difference["tick"].get<int>()) + ", " + difference["column"].get<std::string>() +
        ": recorded " + difference["recorded"].get<std::string>() + ", again " + difference["again"].get<std::string>();
    EXPECT_TRUE(says(other, told)) << other.output;
    const std::string before = std::to_string(difference["tick"].get<int>() - 1);
    EXPECT_EQ(at.run(kReplayBurin + " replay b.session --to " + before).status, 0) << "what is before is equal";
}

TEST(ReplayOfAWorld, IsRefusedWhereItCannotBeExactOrMakesNoSense) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at).status, 0);
    const auto refused = [&](const std::string& file, const std::string& sql, const std::string& said) {
        change(at, copied(at, file), sql);
        const auto outcome = at.run(kReplayBurin + " replay " + file);
        EXPECT_EQ(outcome.status, 1) << sql;
        EXPECT_TRUE(says(outcome, said)) << outcome.output;
    };
    refused("1", "UPDATE meta SET value = '9.9' WHERE key = 'version'", "was recorded by Burin 9.9");
    refused("2", "UPDATE meta SET value = '{}' WHERE key = 'settings'", "no sound value for tool_radius_m");
    refused("3", "UPDATE meta SET value = 'null' WHERE key = 'settings'", "no sound value for tool_radius_m");
    refused("4", "UPDATE meta SET value = replace(value, '\"reach_m\":', '\"reach_m\":-') WHERE key = 'settings'",
            "cannot be felt");
    refused("12", "UPDATE meta SET value = replace(value, '\"shading\":true', '\"shading\":1') WHERE key = 'settings'",
            "no sound value for shading");
    refused("5", "DELETE FROM meta WHERE key = 'activity'", "does not hold what a replay needs");
    refused("6", "DELETE FROM line WHERE id > 100", "of the scene is missing");
    refused("7", "DELETE FROM block WHERE id = 2", "others were lost");
    refused("8", "UPDATE block SET data = zeroblob(9) WHERE id = 2", "check sum is wrong");
    refused("9", "UPDATE column SET unit = 'mm' WHERE name = 'hip0_object_x_m'", "has other columns");
    refused("10", "UPDATE hand SET name = 'Falcon'", "was recorded with Falcon");
    refused("11", "UPDATE line SET time_ns = 9223372036854775807", "differs after");
    EXPECT_EQ(at.run(kReplayBurin + " replay 7 --to 900").status, 0);
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
    EXPECT_TRUE(says(at.run(kReplayBurin + " replay a.session"), "say where it is now by --world FILE"));
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --world moved.toml").status, 0);
    at.write("w.toml", cube_world("stiffness = 300"));
    const auto another = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(another.status, 1);
    EXPECT_TRUE(says(another, "is another world than the one that was recorded")) << another.output;
}

TEST(ThroughAWorld, ItsOwnWorldGivesItsOwnTicksAndTwiceTheSameBits) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at).status, 0);
    copied(at, "kept.session");
    const auto own = at.run(kReplayBurin + " replay a.session --through w.toml --json r.json");
    ASSERT_EQ(own.status, 0) << own.output;
    EXPECT_TRUE(says(own, "a.session: 2400 ticks, 21 columns: a new derived table")) << own.output;
    EXPECT_TRUE(says(own, "the proxy begins at the hand, at tick 1, (")) << own.output;
    EXPECT_TRUE(says(own, "mm from floor")) << own.output;
    EXPECT_TRUE(says(own, "touches floor first, at tick ")) << own.output;
    const Json figures = Json::parse(at.read("r.json"))["figures"];
    EXPECT_EQ(figures["force_deviation_max_N"], 0.0) << "the same world gives the same forces";
    EXPECT_EQ(figures["proxy_deviation_max_m"], 0.0);
    EXPECT_NEAR(figures["nearest_m"].get<double>(), 0.012 - 0.003, 2e-4);
    const std::string bits = at.read("a.session");
    const auto twice = at.run(kReplayBurin + " replay a.session --through w.toml");
    EXPECT_EQ(twice.status, 0);
    EXPECT_TRUE(says(twice, "equal to the bit with the derived table that is there")) << twice.output;
    EXPECT_EQ(at.read("a.session"), bits) << "the second time writes nothing";
    EXPECT_EQ(at.run(kReplayBurin + " session compare a.session kept.session").status, 0) << "the ticks are untouched";
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session").status, 0);
}

TEST(ThroughAWorld, AnotherWorldAndOtherMaterialsAreOtherTables) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at).status, 0);
    at.write("hard.toml", cube_world("stiffness = 900"));
    ASSERT_EQ(at.run(kReplayBurin + " replay a.session --through w.toml").status, 0);
    const auto hard = at.run(kReplayBurin + " replay a.session --through hard.toml --json hard.json");
    const auto soft = at.run(kReplayBurin + " replay a.session --through hard.toml --stiffness 150 --json soft.json");
    ASSERT_EQ(hard.status, 0) << hard.output;
    ASSERT_EQ(soft.status, 0) << soft.output;
    const Json of_hard = Json::parse(at.read("hard.json")), of_soft = Json::parse(at.read("soft.json"));
    EXPECT_GT(of_hard["figures"]["force_max_N"].get<double>(), of_soft["figures"]["force_max_N"].get<double>());
    EXPECT_NE(of_hard["table"], of_soft["table"]);
    const auto info = at.run(kReplayBurin + " session info a.session --json info.json");
    const Json derived = Json::parse(at.read("info.json"))["derived"];
    ASSERT_EQ(derived.size(), 3u) << info.output;
    EXPECT_EQ(derived[0]["objects"][1]["name"], "lift");
    EXPECT_TRUE(says(at.run(kReplayBurin + " session check a.session"), "2400 ticks read")) << "derived tables too";
    const std::string name = of_soft["table"];
    const auto table = at.run(kReplayBurin + " convert a.session - --to csv --columns tick,object0 --part '" +
                              name.substr(0, 20) + "'");
    EXPECT_TRUE(table.output.starts_with("tick,object0\n1,0\n2,0\n")) << table.output.substr(0, 300);
    EXPECT_TRUE(says(at.run(kReplayBurin + " convert a.session - --to csv --part through"), "several tables"))
        << "which?";
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session").status, 0);
}

// A hand that begins within the cube.
TEST(ThroughAWorld, TellsWhereTheProxyBeginsAndWhatIsMissing) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at).status, 0);
    at.write("around.toml",
             "[[object]]\nname = \"block\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nscale = 3.0\nposition = [0.0, "
             "0.03, 0.0]\n");
    const auto inside = at.run(kReplayBurin + " replay a.session --through around.toml");
    EXPECT_EQ(inside.status, 0);
    EXPECT_TRUE(says(inside, "inside material, and is moved out")) << inside.output;
    at.write("far.toml",
             "[[object]]\nname = \"far\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.5, 0.0, 0.0]\n");
    const auto outside = at.run(kReplayBurin + " replay a.session --through far.toml --to 500");
    EXPECT_EQ(outside.status, 0);
    EXPECT_TRUE(says(outside, "mm from far")) << outside.output;
    EXPECT_TRUE(says(outside, "touches nothing; a proxy that begins outside a surface")) << outside.output;
    for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
             {" --through none.toml", "none.toml"},
             {" --through w.toml --stiffness -1", "stiffness"},
             {" --through w.toml --from 90000", "has no ticks in this range"},
             {" --through a.session", "a.session"}}) {
        const auto outcome = at.run(kReplayBurin + " replay a.session" + arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_TRUE(says(outcome, said)) << outcome.output;
    }
    EXPECT_EQ(at.run(kReplayBurin + " replay a.session --through w.toml --world w.toml").status, 2);
}

TEST(ReplayOfAWandStroke, IsEqualToTheBitInAllPointsAndTellsTheFirstDifference) {
    const Workplace at;
    write_small_world(at);
    const auto recorded = at.run(kReplayBurin +
                                 " world w.toml --stroke s.csv --device simulated-wand --radius 0.003 "
                                 "--points centre,bottom --record a.session");
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    EXPECT_TRUE(says(recorded, "ticks recorded")) << recorded.output;
    const auto info = at.run(kReplayBurin + " session info a.session");
    for (const char* words : {"object 1: floor", "object1", "hip1_object_x_m", "wand stroke"})
        EXPECT_TRUE(says(info, words)) << words << info.output;
    const auto again = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(says(again, "equal to the bit")) << again.output;
    at.write("w.toml", cube_world("stiffness = 310, static_friction = 0.3"));
    const auto changed = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(changed.status, 1);
    EXPECT_TRUE(says(changed, "is another one than was recorded")) << changed.output;
    EXPECT_TRUE(says(changed, "equal ticks: tick ")) << changed.output;
    const auto twice = at.run(kReplayBurin + " world w.toml --stroke s.csv --device simulated-wand --record a.session");
    EXPECT_EQ(twice.status, 1);
    EXPECT_TRUE(says(twice, "never overwrites")) << twice.output;
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
    EXPECT_TRUE(says(same, "a.session: 900 ticks, 74 columns: equal to the bit")) << same.output;
    change(at, copied(at, "b.session"), "UPDATE meta SET value = replace(value, '\"medium\"', '\"soft\"')");
    const auto other = at.run(kReplayBurin + " replay b.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(says(other, "differs after ") && says(other, ": recorded ") && says(other, ", again ")) << other.output;
    // Its motion in a world, with the ball that carved.
    const auto through = at.run(kReplayBurin + " replay a.session --through w.toml");
    EXPECT_EQ(through.status, 0);
    EXPECT_TRUE(says(through, "ball of 0.002")) << through.output;
    // Other inputs, and a recording that cannot be done again.
    std::ofstream(at / "press.csv", std::ios::app) << "0.4,0.013,0.012,0.01,0,0,0,1,0\n";
    const auto changed = at.run(kReplayBurin + " replay a.session");
    EXPECT_EQ(changed.status, 1);
    EXPECT_TRUE(says(changed, "press.csv: is another file than the one that was recorded")) << changed.output;
    change(at, copied(at, "c.session"),
           "UPDATE meta SET value = replace(value, '\"real_time\":false', '\"real_time\":true')");
    EXPECT_TRUE(says(at.run(kReplayBurin + " replay c.session"), "was felt in real time"));
    change(at, copied(at, "d.session"), "UPDATE meta SET value = '[1]' WHERE key = 'settings'");
    EXPECT_TRUE(says(at.run(kReplayBurin + " replay d.session"), "no sound value for source"));
    EXPECT_TRUE(says(at.run(kReplayBurin + " replay d.session --through w.toml"), "give it by --radius"));
    ASSERT_EQ(at.run(sculpt + "cylinder:0.002,0.004 --record e.session").status, 0);
    EXPECT_EQ(at.run(kReplayBurin + " replay e.session").status, 0);
}

}  // namespace burin::app
