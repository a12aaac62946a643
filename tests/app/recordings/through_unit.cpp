// SPDX-License-Identifier: MIT
// burin replay --through, as a user's shell runs it: a recorded motion is felt in a world, with the device that it was
// recorded with.
#include <gtest/gtest.h>

#include <filesystem>

#include "activities/world/felt_through.hpp"
#include "base/json.hpp"
#include "record/row_walk.hpp"
#include "tests/app/recordings/small_world.hpp"
#include "tests/support/places.hpp"

namespace burin::app {
namespace {

using namespace test;

const std::string kThroughBurin = kBurinCommand;

}  // namespace

TEST(ThroughAWorld, ItsOwnWorldGivesItsOwnTicksAndTwiceTheSameBits) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kThroughBurin).status, 0);
    copied(at, "kept.session");
    const auto own = at.run(kThroughBurin + " replay a.session --through w.toml --json r.json");
    ASSERT_EQ(own.status, 0) << own.output;
    EXPECT_TRUE(says_so(own, "a.session: 2400 ticks, 21 columns: a new derived table")) << own.output;
    EXPECT_TRUE(says_so(own, "the proxy begins at the hand, at tick 1, (")) << own.output;
    EXPECT_TRUE(says_so(own, "mm from floor")) << own.output;
    EXPECT_TRUE(says_so(own, "touches floor first, at tick ")) << own.output;
    const Json figures = Json::parse(at.read("r.json"))["figures"];
    EXPECT_EQ(figures["force_deviation_max_N"], 0.0) << "the same world gives the same forces";
    ASSERT_EQ(figures["points"].size(), 1u);
    EXPECT_EQ(figures["points"][0]["proxy_deviation_max_m"], 0.0);
    EXPECT_NEAR(figures["points"][0]["nearest_m"].get<double>(), 0.012 - 0.003, 2e-4);
    const std::string bits = at.read("a.session");
    const auto twice = at.run(kThroughBurin + " replay a.session --through w.toml");
    EXPECT_EQ(twice.status, 0);
    EXPECT_TRUE(says_so(twice, "equal to the bit with the derived table that is there")) << twice.output;
    EXPECT_EQ(at.read("a.session"), bits) << "the second time writes nothing";
    EXPECT_EQ(at.run(kThroughBurin + " session compare a.session kept.session").status, 0) << "the ticks are untouched";
    EXPECT_EQ(at.run(kThroughBurin + " replay a.session").status, 0);
}

TEST(ThroughAWorld, AnotherWorldAndOtherMaterialsAreOtherTables) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kThroughBurin).status, 0);
    at.write("hard.toml", cube_world("stiffness = 900"));
    ASSERT_EQ(at.run(kThroughBurin + " replay a.session --through w.toml").status, 0);
    const auto hard = at.run(kThroughBurin + " replay a.session --through hard.toml --json hard.json");
    const auto soft = at.run(kThroughBurin + " replay a.session --through hard.toml --stiffness 150 --json soft.json");
    ASSERT_EQ(hard.status, 0) << hard.output;
    ASSERT_EQ(soft.status, 0) << soft.output;
    const Json of_hard = Json::parse(at.read("hard.json")), of_soft = Json::parse(at.read("soft.json"));
    EXPECT_GT(of_hard["figures"]["force_max_N"].get<double>(), of_soft["figures"]["force_max_N"].get<double>());
    EXPECT_NE(of_hard["table"], of_soft["table"]);
    const auto info = at.run(kThroughBurin + " session info a.session --json info.json");
    const Json derived = Json::parse(at.read("info.json"))["derived"];
    ASSERT_EQ(derived.size(), 3u) << info.output;
    EXPECT_EQ(derived[0]["objects"][1]["name"], "lift");
    EXPECT_TRUE(says_so(at.run(kThroughBurin + " session check a.session"), "2400 ticks read")) << "derived tables too";
    const std::string name = of_soft["table"];
    const auto table = at.run(kThroughBurin + " convert a.session - --to csv --columns tick,object0 --part '" +
                              name.substr(0, 20) + "'");
    EXPECT_TRUE(table.output.starts_with("tick,object0\n1,0\n2,0\n")) << table.output.substr(0, 300);
    EXPECT_TRUE(says_so(at.run(kThroughBurin + " convert a.session - --to csv --part through"), "several tables"))
        << "which?";
    EXPECT_EQ(at.run(kThroughBurin + " replay a.session").status, 0);
}

// A hand that begins within the cube.
TEST(ThroughAWorld, TellsWhereTheProxyBeginsAndWhatIsMissing) {
    const Workplace at;
    write_small_world(at);
    ASSERT_EQ(record_small_world(at, kThroughBurin).status, 0);
    at.write("around.toml",
             "[[object]]\nname = \"block\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nscale = 3.0\nposition = [0.0, "
             "0.03, 0.0]\n");
    const auto inside = at.run(kThroughBurin + " replay a.session --through around.toml");
    EXPECT_EQ(inside.status, 0);
    EXPECT_TRUE(says_so(inside, "inside material, and is moved out")) << inside.output;
    at.write("far.toml",
             "[[object]]\nname = \"far\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.5, 0.0, 0.0]\n");
    const auto outside = at.run(kThroughBurin + " replay a.session --through far.toml --to 500");
    EXPECT_EQ(outside.status, 0);
    EXPECT_TRUE(says_so(outside, "mm from far")) << outside.output;
    EXPECT_TRUE(says_so(outside, "touches nothing; it came within ")) << outside.output;
    EXPECT_FALSE(says_so(outside, "from inside")) << "too far away for that to be the reason: " << outside.output;
    // In a hollow of sheets that the ball meets from the beginning on: it is set where it fits, and felt from there.
    at.write("hollow.toml",
             "[[object]]\nname = \"hollow\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nscale = 3.0\nposition = [0.0, "
             "0.03, 0.0]\nboth_sides = true\n");
    const auto met = at.run(kThroughBurin + " replay a.session --through hollow.toml --radius 0.05 --to 300");
    EXPECT_TRUE(says_so(met, "where the ball overlaps hollow by ")) << met.output;
    EXPECT_TRUE(says_so(met, "touches hollow first, at tick ")) << met.output;
    // A ball of 40 mm whose middle is 12 mm above the cube.
    const auto over = at.run(kThroughBurin + " replay a.session --through w.toml --radius 0.04");
    EXPECT_TRUE(says_so(over, "the ball overlaps floor by 28 mm")) << over.output;
    EXPECT_FALSE(says_so(over, "-28")) << over.output;
    for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
             {" --through none.toml", "none.toml"},
             {" --through w.toml --stiffness -1", "stiffness"},
             {" --through w.toml --from 90000", "has no ticks in this range"},
             {" --through a.session", "a.session"}}) {
        const auto outcome = at.run(kThroughBurin + " replay a.session" + arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_TRUE(says_so(outcome, said)) << outcome.output;
    }
    EXPECT_EQ(at.run(kThroughBurin + " replay a.session --through w.toml --world w.toml").status, 2);
}

// Each point has columns, figures and a beginning of its own, and the wrench a torque.
TEST(ThroughAWorld, AWandIsFeltInAllItsPoints) {
    const Workplace at;
    write_small_world(at);
    write_small_wand(at);
    ASSERT_EQ(record_with_small_wand(at, kThroughBurin).status, 0);
    const auto own = at.run(kThroughBurin + " replay a.session --through w.toml --json own.json");
    ASSERT_EQ(own.status, 0) << own.output;
    EXPECT_TRUE(says_so(own, " ticks, 38 columns: a new derived table")) << own.output;
    EXPECT_TRUE(says_so(own, "the proxy of centre begins at the hand, at tick 1, (")) << own.output;
    EXPECT_TRUE(says_so(own, "the proxy of low begins at the hand, at tick 1, (")) << own.output;
    EXPECT_TRUE(says_so(own, "largest torque ")) << own.output;
    const Json figures = Json::parse(at.read("own.json"))["figures"], points = figures["points"];
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[1]["name"], "low");
    EXPECT_EQ(figures["force_deviation_max_N"], 0.0) << "the same world gives the same wrench";
    EXPECT_EQ(figures["torque_deviation_max_Nm"], 0.0);
    EXPECT_GT(figures["force_max_N"].get<double>(), 0.1);
    for (const Json& point : points) EXPECT_EQ(point["proxy_deviation_max_m"], 0.0) << point["name"];
    EXPECT_FALSE(points[0]["begins_inside"].get<bool>());
    EXPECT_EQ(points[0]["nearest"], "floor");
    const std::string bits = at.read("a.session");
    const auto twice = at.run(kThroughBurin + " replay a.session --through w.toml");
    EXPECT_EQ(twice.status, 0);
    EXPECT_TRUE(says_so(twice, "equal to the bit with the derived table that is there")) << twice.output;
    EXPECT_EQ(at.read("a.session"), bits) << "the second time writes nothing";
    const auto columns = at.run(kThroughBurin +
                                " convert a.session - --to csv --part through --columns "
                                "proxy1_object_y_m,object1,desired_torque_device_x_Nm,commanded_torque_deviation_Nm");
    EXPECT_EQ(columns.status, 0) << columns.output.substr(0, 300);
}

// Held in a block from below: the lower point begins in it, the other outside.
TEST(ThroughAWorld, TellsOfEachPointOfAWandWhereItBegins) {
    const Workplace at;
    write_small_world(at);
    write_small_wand(at);
    ASSERT_EQ(record_with_small_wand(at, kThroughBurin).status, 0);
    at.write("below.toml",
             "[[object]]\nname = \"below\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.0, -0.058, 0.0]\n");
    const auto felt = at.run(kThroughBurin + " replay a.session --through below.toml --to 50 --json r.json");
    ASSERT_EQ(felt.status, 0) << felt.output;
    const Json points = Json::parse(at.read("r.json"))["figures"]["points"];
    EXPECT_FALSE(points[0]["begins_inside"].get<bool>()) << felt.output;
    EXPECT_TRUE(points[1]["begins_inside"].get<bool>()) << felt.output;
    EXPECT_EQ(points[0]["nearest"], "below");
    EXPECT_TRUE(says_so(felt, "inside material, and is moved out")) << felt.output;
}

// A recording holds what its wand was: the file may be gone or another one. Where it holds the digest alone, as older
// ones do, the file must be the same.
TEST(ThroughAWorld, KnowsTheWandFromTheRecording) {
    const Workplace at;
    write_small_world(at);
    write_small_wand(at);
    ASSERT_EQ(record_with_small_wand(at, kThroughBurin).status, 0);
    copied(at, "digest.session");
    copied(at, "nothing.session");
    copied(at, "points.session");
    copied(at, "changed.session");
    change(at, "changed.session", "UPDATE meta SET value = value || '#' WHERE key = 'wand description'");
    change(at, "digest.session", "DELETE FROM meta WHERE key = 'wand description'");
    change(at, "nothing.session", "DELETE FROM meta WHERE key LIKE 'wand %'");
    change(at, "points.session",
           "UPDATE meta SET value = replace(value, 'centre,low', 'low') WHERE key = 'log header'");
    const std::string through = " --through w.toml";
    EXPECT_EQ(at.run(kThroughBurin + " replay digest.session" + through).status, 0);
    write_small_wand(at, "0.07");
    EXPECT_EQ(at.run(kThroughBurin + " replay a.session" + through).status, 0);
    for (const auto& [file, said] : std::vector<std::pair<std::string, std::string>>{
             {"digest.session", "wand.toml: is another wand than the one that was recorded"},
             {"nothing.session", "does not hold the description of its wand, wand.toml"},
             {"changed.session", "holds another description of its wand than its digest says"},
             {"points.session", "has more points than it names"}}) {
        const auto outcome = at.run(kThroughBurin + " replay " + file + through);
        EXPECT_EQ(outcome.status, 1) << file;
        EXPECT_TRUE(says_so(outcome, said)) << outcome.output;
    }
    std::filesystem::remove(at / "wand.toml");
    EXPECT_EQ(at.run(kThroughBurin + " replay a.session" + through).status, 0);
    EXPECT_TRUE(says_so(at.run(kThroughBurin + " replay digest.session" + through), "and is not there"));
}

// A stage names its wand and points itself: no option of a command line did.
TEST(ThroughAWorld, AStageOfAStudyIsFeltInBothPoints) {
    const Workplace at;
    write_small_world(at);
    at.write("high.toml",
             "[[object]]\nname = \"floor\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.0, 0.065, 0.0]\n");
    at.write("script.txt",
             "burin-study-input 1\n0 hand 0 0.165 0.11\n0.5 start\n61 start\n62 next\n62.5 hand 0 0.165 0.11\n"
             "63 start\n64 hand 0 0.09 0\n65 note presses\n");
    ASSERT_EQ(at.run(kThroughBurin + " study init kinesthetic-path s").status, 0);
    ASSERT_EQ(at.run(kThroughBurin + " study enrol s p01").status, 0);
    const auto led = at.run(kThroughBurin + " study run s --participant p01 --input script.txt");
    ASSERT_EQ(led.status, 0) << led.output;
    const std::string kept = "s/data/p01/day1-03-run1.session";
    const auto refused = at.run(kThroughBurin + " replay " + kept + " --through high.toml --radius 0.003");
    EXPECT_EQ(refused.status, 1) << "its journal knows it byte by byte";
    EXPECT_TRUE(says_so(refused, "belongs to the study")) << refused.output;
    EXPECT_EQ(at.run(kThroughBurin + " study check s").status, 0);
    std::filesystem::copy_file(at / kept, at / "stage.session");
    const std::string replay = kThroughBurin + " replay stage.session";
    EXPECT_TRUE(says_so(at.run(replay + " --through high.toml"), "give it by --radius")) << "its points have no size";
    const auto felt = at.run(replay + " --through high.toml --radius 0.003");
    EXPECT_EQ(felt.status, 0) << felt.output;
    EXPECT_TRUE(says_so(felt, "38 columns: a new derived table")) << felt.output;
    EXPECT_TRUE(says_so(felt, "touches floor first")) << felt.output;
    // Ticks are counted through the visit, whose second 63 begins the stage with one of the next frames.
    const std::string begins = "the proxy of bottom begins at the hand, at tick ";
    const std::size_t at_tick = felt.output.find(begins);
    ASSERT_NE(at_tick, std::string::npos) << felt.output;
    EXPECT_NEAR(std::stod(felt.output.substr(at_tick + begins.size())), 63'000.0, 50.0) << felt.output;
}

}  // namespace burin::app
