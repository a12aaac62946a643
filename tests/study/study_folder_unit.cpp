// SPDX-License-Identifier: MIT
// A study's folder as its user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/json.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "record/record_reader.hpp"
#include "study/folder/study_folder.hpp"
#include "tests/study/lost_study.hpp"
#include "tests/study/short_study.hpp"

namespace burin::study {
namespace {

TEST(StudyDigest, IsThatOfTheStandard) {
    // FIPS 180-4's examples, and a message as long as the padding's seam.
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(StudyCommands, GoFromAProtocolToAReport) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    const auto ran = place.run(kBurinStudy + "run s --simulated");
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_TRUE(ran.output.contains("hand and wand are simulated")) << ran.output;
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 0);
    const auto analysed = place.run(kBurinStudy + "analyse s");
    EXPECT_EQ(analysed.status, 0) << analysed.output;
    EXPECT_TRUE(analysed.output.contains("8 trials, 2 groups")) << analysed.output;
    const auto reported = place.run(kBurinStudy + "report s");
    ASSERT_EQ(reported.status, 0) << reported.output;
    ASSERT_EQ(place.run(kBurinStudy + "report s").status, 0);  // beside the first
    const std::string html = place.read("s/reports/001/report.html");
    for (const char* part : {"simulated learners", "SHA-256", "Group haptic: 2 allocated", "Failed attempts",
                             "failed attempts in 4 trials"})
        EXPECT_TRUE(html.contains(part)) << part;
    EXPECT_EQ(html, place.read("s/reports/002/report.html"));
}

TEST(StudyCommands, GiveTheSameTrialsAfterAnInterruption) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    std::filesystem::copy(place / "s", place / "t", std::filesystem::copy_options::recursive);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated --threads 1").status, 0);
    // A journal that ends in the middle of the second person's first trial.
    const std::string whole = place.read("s/journal.jsonl");
    const std::size_t second = whole.find("\"stage begun\",\"participant\":\"sim002\",\"day\":1,\"place\":6");
    ASSERT_NE(second, std::string::npos);
    place.write("t/journal.jsonl", whole.substr(0, whole.find('\n', second) + 1));
    std::filesystem::copy(place / "s/data/sim001", place / "t/data/sim001");
    const auto before = place.run(kBurinStudy + "status t");
    EXPECT_TRUE(before.output.contains("aborted: test (day 1, stage 6)")) << before.output;
    // Killed before the first transaction: a recording without anything in it, which replay passes over.
    std::filesystem::create_directories(place / "t/data/sim002");
    for (const char* ended : {"03", "04", "05"})
        for (const char* kind : {".json", ".session"}) {
            const std::string file = std::string("data/sim002/day1-") + ended + "-run1" + kind;
            std::filesystem::copy(place / ("s/" + file), place / ("t/" + file));
        }
    place.write("t/data/sim002/day1-06-run1.session", "");
    ASSERT_EQ(place.run(kBurinStudy + "run t --simulated").status, 0);
    // All but the run: the trial that was cut off was begun twice.
    auto at_once = rows_of_csv(place.read("s/trials.csv")), in_two = rows_of_csv(place.read("t/trials.csv"));
    ASSERT_EQ(at_once.size(), in_two.size());
    for (std::size_t i = 0; i < at_once.size(); ++i) {
        const bool is_cut_off = at_once[i].at("participant") == "sim002" && at_once[i].at("place") == "6";
        EXPECT_EQ(in_two[i].at("run"), is_cut_off ? "2" : "1");
        in_two[i]["run"] = at_once[i].at("run");
        EXPECT_EQ(at_once[i], in_two[i]);
    }
    const auto replayed = place.run(kBurinStudy + "replay t --participant sim002");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(place.run(kBurinStudy + "status t").output.contains("1 stages were aborted"));
}

TEST(StudyCommands, ReplayWhatWasRecordedToTheBit) {
    const Workplace place;
    ASSERT_EQ(make_study(place, "--participants 2 --seed 3").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "replay s").status, 1);  // nothing yet
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated").status, 0);
    const auto replayed = place.run(kBurinStudy + "replay s");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    // Two people, each: show_model, interactive and led training, two tests.
    EXPECT_TRUE(replayed.output.contains("10 recordings")) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("All equal what was stored")) << replayed.output;
    // A kill may cost a second: transactions, a block of ticks each, are much less than that apart.
    auto reader = record::RecordReader::open((place / "s/data/sim001/day1-04-run1.session").string());
    ASSERT_TRUE(reader);
    ASSERT_GE(reader->hands().front().blocks.size(), 4u);
    for (std::size_t b = 0; b < reader->hands().front().blocks.size(); ++b) {
        const auto block = reader->block(0, b);
        ASSERT_TRUE(block);
        EXPECT_LE(block->rows(), 251u);
    }
    // The attempts stand in the trial's own file, for whoever wants their ticks alone.
    auto trial = record::RecordReader::open((place / "s/data/sim001/day1-06-run1.session").string());
    ASSERT_TRUE(trial);
    const auto attempts = trial->trials();
    ASSERT_TRUE(attempts && !attempts->empty());
    const Json measured = Json::parse(place.read("s/data/sim001/day1-06-run1.json"));
    EXPECT_EQ(attempts->back().name, "test");
    EXPECT_EQ(attempts->back().state, "done");
    EXPECT_NEAR(1e-9 * static_cast<double>(attempts->back().ended_ns - attempts->back().begun_ns),
                measured.at("time_s").get<double>(), 2e-9);
    EXPECT_EQ(attempts->size(), 1u + measured.at("failed_attempts").get<std::size_t>());
    const std::string convert = std::string(kBurinCommand) + " convert s/data/sim001/day1-06-run1.session ";
    const auto ticks = place.run(convert + "t.csv --to csv --trials test");
    EXPECT_EQ(ticks.status, 0) << ticks.output;
    EXPECT_TRUE(place.read("t.csv").contains("object1"));
    ASSERT_EQ(place.run(convert + "b --to bids").status, 0);
    EXPECT_TRUE(std::ranges::any_of(std::filesystem::recursive_directory_iterator(place / "b"),
                                    [](const auto& entry) { return entry.path().string().ends_with("_events.tsv"); }));
    const auto one = place.run(kBurinStudy + "replay s --participant sim002");
    EXPECT_TRUE(one.output.contains("5 recordings")) << one.output;
}

TEST(StudyCommands, GiveTheSameFiguresOnOneAndOnTwoThreads) {
    const Workplace place;
    ASSERT_EQ(make_study(place, "--participants 4 --seed 11").status, 0);
    std::filesystem::copy(place / "s", place / "t", std::filesystem::copy_options::recursive);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated --threads 1").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "run t --simulated --threads 2 --without-motion").status, 0);
    EXPECT_EQ(place.read("s/trials.csv"), place.read("t/trials.csv"));
    for (const char* id : {"sim001", "sim002", "sim003", "sim004"}) {
        for (const char* stage : {"03", "04", "05", "06", "07"}) {
            const std::string file = std::string("/data/") + id + "/day1-" + stage + "-run1.json";
            EXPECT_FALSE(place.read("s" + file).empty()) << file;
            EXPECT_EQ(place.read("s" + file), place.read("t" + file)) << file;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(place / "t/data/sim001/day1-06-run1.session"));
}

TEST(StudyCommands, RefuseToMixEffectsInOneStudy) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated --effect 1.5").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "run s --simulated --effect 1.5").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "run s --simulated").status, 1);
    EXPECT_TRUE(place.run(kBurinStudy + "report s").output.contains("effect 1.5 SD"));
}

TEST(StudyCommands, RefuseAProtocolThatWasEditedAfterwards) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    place.write("s/protocol.toml", place.read("s/protocol.toml") + "\n");
    const auto outcome = place.run(kBurinStudy + "run s --simulated");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(outcome.output.contains("not the protocol that this study was made with")) << outcome.output;
}

TEST(StudyCommands, OverwriteNothing) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    const std::string journal = place.read("s/journal.jsonl");
    const auto outcome = make_study(place, "--participants 8");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(outcome.output.contains("exists already"));
    EXPECT_EQ(place.read("s/journal.jsonl"), journal);
}

TEST(StudyCommands, RefuseASecondWriter) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    const auto first = StudyFolder::open(place / "s", StudyAccess::write);
    ASSERT_TRUE(first);
    const auto second = place.run(kBurinStudy + "enrol s p01");
    EXPECT_EQ(second.status, 1);
    EXPECT_TRUE(second.output.contains("in use by another burin")) << second.output;
    EXPECT_EQ(place.run(kBurinStudy + "status s").status, 0);
}

TEST(StudyCommands, EnrolByCodeAndNeverTwice) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "enrol s p01").status, 0);
    for (const char* id : {"p01", "Anna", "anna@example.org", "'a b 1'", "../p2"})
        EXPECT_EQ(place.run(kBurinStudy + "enrol s " + id).status, 1) << id;
    EXPECT_EQ(place.run(kBurinStudy + "enrol s ''").status, 2) << "no participant at all";
    for (const char* id : {"p02", "p03", "p04"}) EXPECT_EQ(place.run(kBurinStudy + "enrol s " + id).status, 0) << id;
    const auto full = place.run(kBurinStudy + "enrol s p05");
    EXPECT_TRUE(full.output.contains("places of stratum all are taken")) << full.output;
}

TEST(StudyCommands, HideTheGroupOfAPlaceUntilSomebodyTakesIt) {
    const Workplace place;
    place.write("p.toml", short_protocol());
    ASSERT_EQ(place.run(kBurinStudy + "init p.toml s --participants 4 --key list.key").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "init p.toml t --participants 4 --key list.key").status, 1);  // it exists
    for (const auto& entry : std::filesystem::directory_iterator(place / "s")) {
        if (!entry.is_regular_file() || entry.path().filename() == "protocol.toml") continue;
        const std::string text = place.read("s/" + entry.path().filename().string());
        EXPECT_FALSE(text.contains("haptic") || text.contains("visual")) << entry.path();
    }
    const auto without = place.run(kBurinStudy + "enrol s p01");
    EXPECT_EQ(without.status, 1);
    EXPECT_TRUE(without.output.contains("--key")) << without.output;
    const auto enrolled = place.run(kBurinStudy + "enrol s p01 --key list.key");
    ASSERT_EQ(enrolled.status, 0) << enrolled.output;
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 0);
    place.write("s/allocation.sealed", place.read("s/allocation.sealed") + "all 5 00 00\n");
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 1);
    EXPECT_EQ(place.run(kBurinStudy + "enrol s p02 --key list.key").status, 1);
}

TEST(StudyCommands, MakeTheStudyOfTheThesisByItsName) {
    const Workplace place;
    const auto made = place.run(kBurinStudy + "init kinesthetic-path out --participants 10 --seed 7");
    EXPECT_TRUE(made.output.contains("blocks are of 2 or 4 places, and a list of 10 may end within one"))
        << made.output;
    ASSERT_EQ(made.status, 0) << made.output;
    EXPECT_TRUE(made.output.contains("protocol kinesthetic-path")) << made.output;
    EXPECT_EQ(place.run(kBurinStudy + "check out").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "init out2").status, 1);
    EXPECT_EQ(place.run(kBurinStudy + "init no-such-protocol out2").status, 1);
    EXPECT_FALSE(std::filesystem::exists(place / "out2"));
}

TEST(StudyCommands, TakeAParticipantThroughByAScriptAndGoOnAfterAnInterruption) {
    const Workplace place;
    ASSERT_EQ(make_study(place, "--participants 2 --seed 3").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "enrol s p01").status, 0);
    const std::string run = kBurinStudy + "run s --participant p01 --input ";
    const std::string head = "burin-study-input 1\n0 hand -0.175 0.165 0.11\n";
    // Two pages, the model, two trainings and a trial; then the second trial is interrupted.
    place.write("one.txt", head + "0.1 start\n1.5 start\n1.6 note sits down\n2 next\n2.5 start\n4 start\n5.5 start\n" +
                               "7 start\n" + through_the_tube(7.0) + "12 start\n12.5 hand 0 0.2 0.1\n");
    const auto first = place.run(run + "one.txt");
    ASSERT_EQ(first.status, 0) << first.output;
    for (const char* part : {"6 stages ended", "end touched: ", "stage ended: valid exit", "trial test: valid exit"})
        EXPECT_TRUE(first.output.contains(part)) << part << first.output;
    EXPECT_TRUE(first.output.contains("ended within a stage")) << first.output;
    EXPECT_TRUE(place.run(kBurinStudy + "status s").output.contains("aborted: test (day 1, stage 7)"));
    EXPECT_TRUE(place.read("s/journal.jsonl").contains("sits down"));
    place.write("two.txt", head + "0.1 start\n" + through_the_tube(0.2));
    const auto second = place.run(run + "two.txt");
    ASSERT_EQ(second.status, 0) << second.output;
    EXPECT_TRUE(second.output.contains("trials.csv: 2 trials")) << second.output;
    const auto replayed = place.run(kBurinStudy + "replay s");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(place.run(kBurinStudy + "status s").output.contains("with a simulated device"));
    // Learners fill the other place, and the analysis counts both alike.
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated --without-motion").status, 0);
    // Each form says that nobody took part, and has the groups in the protocol's order, whoever was first.
    for (const char* choice : {"", " --day 1", " --stage test"}) {
        const std::string out = formatted("out%zu", std::string(choice).size());
        const std::string said = place.run(kBurinStudy + "analyse s --out " + out + choice).output;
        EXPECT_TRUE(said.contains("4 trials, 2 groups")) << said;
        for (const std::string& form : {said, place.read(out + "/report.html"), place.read(out + "/results.json")}) {
            EXPECT_TRUE(
                form.contains("2 of 2 participants of these trials are simulated, no person (learners: 1, by a"))
                << form;
            EXPECT_TRUE(form.contains("Groups in the order of the protocol: haptic, visual")) << form;
        }
    }
    EXPECT_TRUE(place.read("s/trials.csv").contains("\np01,visual,1,"));
    EXPECT_LT(place.read("s/trials.csv").find(",visual,"), place.read("s/trials.csv").find(",haptic,"));
    EXPECT_EQ(place.run(run + "two.txt").status, 1);  // all is done
    EXPECT_EQ(place.run(kBurinStudy + "run s --participant sim002 --input two.txt").status, 1);
    EXPECT_EQ(place.run(kBurinStudy + "run s --participant p09 --input two.txt").status, 1);
    EXPECT_EQ(place.run(kBurinStudy + "run s --participant p01").status, 1);
}

// A second day with the path of the first (retention) and another, shorter one (transfer).
const std::string kSecondDay = R"(
[[world]]
name = "arch"
tube_radius_m = 0.045
cap_half_width_m = 0.068
funnel_half_width_m = 0.045
spine_m = [[-0.12, 0.19, 0.0], [-0.06, 0.21, 0.0], [0.0, 0.22, 0.0], [0.06, 0.21, 0.0], [0.12, 0.19, 0.0]]

[[stage]]
name = "other-path"
kind = "trial"
world = "arch"
ends_at_exit = true
attempts = 5
outcome = true

[[day]]
stages = ["test", "other-path"]
least_delay_h = 20
most_delay_h = 48
)";

TEST(StudyCommands, GoOnTheNextDayInAnotherWorld) {
    const Workplace place;
    place.write("p.toml", short_protocol() + kSecondDay);
    const auto made = place.run(kBurinStudy + "init p.toml s --participants 2 --seed 5");
    ASSERT_EQ(made.status, 0) << made.output;
    const auto ran = place.run(kBurinStudy + "run s --simulated");
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_TRUE(ran.output.contains("9 stages")) << ran.output;
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 0);
    const auto replayed = place.run(kBurinStudy + "replay s");
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("14 recordings")) << replayed.output;
    const std::string trials = place.read("s/trials.csv");
    for (const char* row : {",1,test,all,learner\n", ",2,test,all,learner\n", ",2,other-path,all,learner\n"})
        EXPECT_TRUE(trials.contains(row)) << row;
    const auto reported = place.run(kBurinStudy + "report s");
    EXPECT_EQ(reported.status, 0) << reported.output;
    // Trials of several days are not one sample: each can be analysed alone, and together they are said to be mixed.
    const std::string analyse = kBurinStudy + "analyse s ";
    for (const std::string& said : {place.run(analyse).output, place.read("s/reports/001/report.html")})
        EXPECT_TRUE(said.contains("of 2 days and 2 worlds")) << said;
    const auto transfer = place.run(analyse + "--stage other-path");
    EXPECT_TRUE(transfer.output.contains("2 trials, 2 groups")) << transfer.output;
    EXPECT_FALSE(transfer.output.contains("of 2 days")) << transfer.output;
    EXPECT_TRUE(place.run(analyse + "--day 2").output.contains("4 trials, 2 groups"));
    EXPECT_TRUE(place.run(analyse + "--day 2 --stage test").output.contains("2 trials, 2 groups"));
    for (const char* wrong : {"--day 3", "--day 0", "--stage led", "--stage other-path --day 1"})
        EXPECT_EQ(place.run(analyse + wrong).status, 1) << wrong;
    EXPECT_EQ(place.run(kBurinStudy + "analyse --data s/trials.csv --day 1").status, 1);
}

TEST(StudyBench, GivesProcessorTimeBesideTheClockOnTheWall) {
    const Workplace place;
    place.write("p.toml", short_protocol());
    const auto benched =
        place.run(std::string(kBurinCommand) + " bench study p.toml --participants 1 --threads 1 --folder . --json -");
    ASSERT_EQ(benched.status, 0) << benched.output;
    const Json json = Json::parse(benched.output);
    for (const char* run : {"without_motion", "with_motion"})
        EXPECT_GT(json.at(run).at("processor_s").get<double>(), 0.0) << run;
    for (const Json& stage : json.at("stages")) EXPECT_GT(stage.at("processor_us_a_tick").get<double>(), 0.0) << stage;
    EXPECT_EQ(place.files(), 1u);
}

TEST(StudyCommands, FindAJournalThatHasLostItsBeginning) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "check s").status, 0);
    place.write("s/journal.jsonl", "");
    const auto checked = place.run(kBurinStudy + "check s");
    EXPECT_EQ(checked.status, 1);
    EXPECT_TRUE(checked.output.contains("has lost its beginning")) << checked.output;
}

TEST(StudyCommands, NameDataThatWereChanged) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated").status, 0);
    const std::string trial = "s/data/sim001/day1-06-run1.json", motion = "s/data/sim001/day1-07-run1.session";
    place.write(trial, place.read(trial) + " ");
    const auto outcome = place.run(kBurinStudy + "check s");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(outcome.output.contains("is not what the journal says")) << outcome.output;
    EXPECT_TRUE(place.run(kBurinStudy + "analyse s").output.contains("7 trials"));
    std::string bytes = place.read(motion);
    ASSERT_GT(bytes.size(), 10'000u);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    place.write(motion, bytes);
    EXPECT_TRUE(place.run(kBurinStudy + "check s").output.contains(motion)) << motion;
    const auto replayed = place.run(kBurinStudy + "replay s");
    EXPECT_EQ(replayed.status, 1);
    EXPECT_TRUE(replayed.output.contains(motion)) << replayed.output;
}

}  // namespace
}  // namespace burin::study
