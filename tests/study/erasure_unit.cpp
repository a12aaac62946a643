// SPDX-License-Identifier: MIT
// Who withdraws: what is left out, what is erased, and what stays.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/study/short_study.hpp"

namespace burin::study {
namespace {

TEST(StudyCommands, LeaveOutAndEraseWhoWithdraws) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "withdraw s sim002").status, 0);
    EXPECT_TRUE(place.run(kBurinStudy + "analyse s").output.contains("6 trials"));
    EXPECT_TRUE(std::filesystem::exists(place / "s/data/sim002"));
    ASSERT_EQ(place.run(kBurinStudy + "withdraw s sim002 --erase").status, 0);
    EXPECT_FALSE(std::filesystem::exists(place / "s/data/sim002"));
    EXPECT_TRUE(place.run(kBurinStudy + "status s").output.contains("erased"));
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 0);
    EXPECT_EQ(place.run(kBurinStudy + "withdraw s nobody1").status, 1);
    // Files that an interrupted erasure left are erased when it is asked for again; then nothing is left.
    std::filesystem::create_directory(place / "s/data/sim002");
    EXPECT_EQ(place.run(kBurinStudy + "withdraw s sim002 --erase").status, 0);
    EXPECT_FALSE(std::filesystem::exists(place / "s/data/sim002"));
    EXPECT_EQ(place.run(kBurinStudy + "withdraw s sim002 --erase").status, 1);
}

// The files below a folder, each with what it holds.
std::map<std::string, std::string> all_files(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream in(entry.path(), std::ios::binary);
        files[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return files;
}

TEST(StudyCommands, EraseAllOfAParticipantButCodeGroupAndThatThereWasAWithdrawal) {
    const Workplace place;
    place.write("p.toml", short_protocol() + "\n[[stratum]]\nname = \"hand\"\ncodes = [\"lefty\", \"righty\"]\n");
    ASSERT_EQ(place.run(kBurinStudy + "init p.toml s --participants 4 --seed 3").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "enrol s p01 --codes righty").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "enrol s p02 --codes lefty").status, 0);
    place.write("one.txt", "burin-study-input 1\n0 hand -0.175 0.165 0.11\n0.1 start\n1.5 start\n" +
                               std::string("1.6 note limps a bit\n") +
                               std::string("2 next\n2.5 start\n4 start\n5.5 start\n7 start\n") + through_the_tube(7.0) +
                               "12 start\n12.5 hand 0 0.2 0.1\n");
    for (const char* id : {"p01", "p02"})
        ASSERT_EQ(place.run(kBurinStudy + "run s --input one.txt --participant " + id).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "report s").status, 0);
    std::filesystem::create_directories(place / "s/pictures");
    place.write("s/pictures/haptic-1-6-test.png", "of p01");
    place.write("s/reports/other.txt", "of p010 and xp01");
    const std::string before = place.read("s/journal.jsonl");
    const auto erased = place.run(kBurinStudy + "withdraw s p01 --erase");
    ASSERT_EQ(erased.status, 0) << erased.output;
    EXPECT_TRUE(erased.output.contains("s/reports/001 told of it, and was deleted")) << erased.output;
    std::size_t lines = 0;
    for (const auto& [name, text] : all_files(place / "s")) {
        EXPECT_FALSE(name.contains("p01")) << name;
        if (name == "reports/other.txt") continue;  // of others
        EXPECT_FALSE(name.starts_with("reports/") || name.starts_with("pictures/")) << name;
        if (name != "journal.jsonl") {
            EXPECT_FALSE(text.contains("p01")) << name;
            continue;
        }
        EXPECT_EQ(text.find("limps a bit"), text.rfind("limps a bit")) << "p02's note alone";
        std::istringstream all(text);
        for (std::string line; std::getline(all, line);) {
            if (!line.contains("p01")) continue;
            ++lines;
            const Json left = Json::parse(line.substr(65), nullptr, false);
            ASSERT_TRUE(left.is_object()) << line;
            for (const auto& [key, value] : left.items()) {
                const bool may_stay = key == "participant" || key == "words_sha256" || key == "group" ||
                                      key == "event" || key == "erase" || key == "places_taken";
                EXPECT_TRUE(may_stay) << line;
            }
        }
    }
    // As many as there were about p01, and the withdrawal.
    std::istringstream was(before);
    for (std::string line; std::getline(was, line);)
        if (line.contains("{\"participant\":\"p01\"")) --lines;
    EXPECT_EQ(lines, 1u);
    EXPECT_EQ(place.run(kBurinStudy + "check s").status, 0) << place.run(kBurinStudy + "check s").output;
    EXPECT_TRUE(place.read("s/trials.csv").contains("\np02,"));
    EXPECT_TRUE(place.run(kBurinStudy + "status s").output.contains("0 of 7 stages; erased"));
    EXPECT_TRUE(place.run(kBurinStudy + "withdraw s p01 --erase").output.contains("nothing is left to erase"));
    // The place stays taken, though nobody knows of which list.
    const auto next = place.run(kBurinStudy + "enrol s p03 --codes righty");
    EXPECT_TRUE(next.output.contains("stratum righty, place 2")) << next.output;
    EXPECT_EQ(place.run(kBurinStudy + "enrol s p01 --codes righty").status, 1) << "a code comes once";
    EXPECT_EQ(place.run(kBurinStudy + "run s --participant p01 --input one.txt --resume --any-delay").status, 1);
    EXPECT_EQ(place.run(kBurinStudy + "report s").status, 0);
    EXPECT_FALSE(place.read("s/reports/001/report.html").contains("p01"));
}

TEST(StudyCommands, EraseTheTableOfTheOnlyOneWhoHasTrials) {
    const Workplace place;
    ASSERT_EQ(make_study(place, "--participants 2 --seed 3").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "enrol s p01").status, 0);
    place.write("one.txt", "burin-study-input 1\n0 hand -0.175 0.165 0.11\n0.1 start\n1.5 start\n2 next\n2.5 start\n" +
                               std::string("4 start\n5.5 start\n7 start\n") + through_the_tube(7.0));
    ASSERT_EQ(place.run(kBurinStudy + "run s --input one.txt --participant p01").status, 0);
    ASSERT_TRUE(place.read("s/trials.csv").contains("p01"));
    ASSERT_EQ(place.run(kBurinStudy + "withdraw s p01 --erase").status, 0);
    EXPECT_FALSE(place.read("s/trials.csv").contains("p01"));
}

TEST(StudyCommands, EraseWhatAnInterruptedErasureLeft) {
    const Workplace place;
    ASSERT_EQ(make_study(place, "--participants 2 --seed 3").status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "enrol s p01").status, 0);
    // The power fails behind the line that tells of it.
    const std::string journal = place.read("s/journal.jsonl");
    place.write("s/journal.jsonl", journal + erasure_of("p01", journal));
    EXPECT_TRUE(place.read("s/journal.jsonl").contains("\"stratum\""));
    ASSERT_EQ(place.run(kBurinStudy + "withdraw s p01 --erase").status, 0);
    EXPECT_FALSE(place.read("s/journal.jsonl").contains("\"stratum\""));
    EXPECT_EQ(place.run(kBurinStudy + "withdraw s p01 --erase").status, 1);
}

TEST(StudyCommands, EraseWhatAFigureTellsAndNothingBehindALink) {
    const Workplace place;
    ASSERT_EQ(make_study(place).status, 0);
    ASSERT_EQ(place.run(kBurinStudy + "run s --simulated").status, 0);
    ASSERT_TRUE(place.read("s/trials.csv").contains("sim002"));
    ASSERT_EQ(place.run(kBurinStudy + "withdraw s sim002 --erase").status, 0);
    EXPECT_FALSE(place.read("s/trials.csv").contains("sim002"));
    std::filesystem::rename(place / "s/data/sim001", place / "elsewhere");
    std::filesystem::create_symlink(place / "elsewhere", place / "s/data/sim001");
    const auto refused = place.run(kBurinStudy + "withdraw s sim001 --erase");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("is a link")) << refused.output;
    EXPECT_FALSE(place.run(kBurinStudy + "status s").output.contains("sim001 withdrew")) << "nothing was done";
}

}  // namespace
}  // namespace burin::study
