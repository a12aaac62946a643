// SPDX-License-Identifier: MIT
// burin study as its user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/json.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin {
namespace {

const std::string kStudy = std::string(kBurinCommand) + " study ";
const std::string kTable4 = std::filesystem::absolute("assets/studies/kinesthetic-path/thesis-table4.csv").string();
const std::string kOwn =
    "participant,group,trial,deviation_mm,time_s\n"
    "p1,touch,1,0.5,30\np2,touch,1,0.7,41\np3,sight,1,1.5,22\np4,sight,1,1.2,29\n";

TEST(StudyAnalyse, PrintsBothUnitsOfAnalysisWithTheParticipantsFirst) {
    const Workplace place;
    const auto outcome = place.run(kStudy + "analyse --data '" + kTable4 + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const std::size_t participants = outcome.output.find("Unit of analysis: participant");
    const std::size_t trials = outcome.output.find("Unit of analysis: trial");
    ASSERT_NE(participants, std::string::npos);
    ASSERT_NE(trials, std::string::npos);
    EXPECT_LT(participants, trials);
    for (const char* part : {"not independent", "Spearman", "Mann-Whitney", "Hodges-Lehmann", "rank-biserial", "exact",
                             "published study", "1.784", "2.784"})
        EXPECT_TRUE(outcome.output.contains(part)) << part;
}

TEST(StudyAnalyse, SaysNothingOfPublishedFiguresWithAUsersOwnData) {
    const Workplace place;
    place.write("own.csv", kOwn);
    const auto outcome = place.run(kStudy + "analyse --data own.csv --out out --json results.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const std::string all = outcome.output + place.read("results.json") + place.read("out/report.html");
    for (const char* word : {"published", "Published", "hesis", "Clemson"}) EXPECT_FALSE(all.contains(word)) << word;
    EXPECT_TRUE(outcome.output.contains("hardly any p can be small"));
}

TEST(StudyAnalyse, WritesTheSameFiguresAsJsonTablesAndReport) {
    const Workplace place;
    const auto outcome = place.run(kStudy + "analyse --data '" + kTable4 + "' --json - --out out");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const Json json = Json::parse(outcome.output);
    EXPECT_EQ(json.at("unit_to_report"), "participant");
    const Json& participants = json.at("analyses").at(0);
    ASSERT_EQ(participants.at("comparisons").size(), 2u);
    // Of C(10, 5) = 252 deals 8 are as far from the middle as U = 23 of 25: 0, 1, 2 pairs and their opposites.
    const Json& deviation = participants.at("comparisons").at(1).at("mann_whitney");
    EXPECT_EQ(deviation.at("statistic"), 23.0);
    EXPECT_NEAR(deviation.at("p").get<double>(), 8.0 / 252.0, 1e-15);
    EXPECT_EQ(deviation.at("exact"), true);
    EXPECT_EQ(Json::parse(place.read("out/results.json")), json);
    for (const char* file : {"trials.csv", "ranks-in-groups.csv", "ranks-of-time.csv", "ranks-of-deviation.csv"}) {
        const std::string text = place.read(std::string("out/") + file);
        EXPECT_GE(std::ranges::count(text, '\n'), 21) << file;
    }
    EXPECT_TRUE(place.read("out/tests.csv").contains("exact permutation p with midranks"));
}

TEST(StudyAnalyse, WritesAReportThatNeedsNothingElse) {
    const Workplace place;
    ASSERT_EQ(place.run(kStudy + "analyse --data '" + kTable4 + "' --out out").status, 0);
    const std::string html = place.read("out/report.html");
    for (const char* part : {"<!DOCTYPE html>", "viewport", "<svg ", "Unit of analysis: participant", "Warning: "})
        EXPECT_TRUE(html.contains(part)) << part;
    // The only address is the name of SVG's namespace, which nothing is loaded from.
    for (const char* loaded : {"<script", "<link", "src=", "href=", "@import", "url("})
        EXPECT_FALSE(html.contains(loaded)) << loaded;
    std::size_t addresses = 0, namespaces = 0;
    for (std::size_t at = html.find("://"); at != std::string::npos; at = html.find("://", at + 1)) ++addresses;
    for (std::size_t at = html.find("http://www.w3.org/2000/svg"); at != std::string::npos;
         at = html.find("http://www.w3.org/2000/svg", at + 1))
        ++namespaces;
    EXPECT_EQ(addresses, namespaces);
}

TEST(StudyAnalyse, EscapesWhatATableHolds) {
    const Workplace place;
    place.write("own.csv", "participant,group,trial,deviation,time_s\n<b>,\"a,<i>\",1,1,2\nq,z,1,2,3\n");
    ASSERT_EQ(place.run(kStudy + "analyse --data own.csv --out out").status, 0);
    EXPECT_FALSE(place.read("out/report.html").contains("<i>"));
    EXPECT_FALSE(place.read("out/report.html").contains("<b>"));
    EXPECT_TRUE(place.read("out/trials.csv").contains("<b>,\"a,<i>\",1,1,2\n"));
}

TEST(StudyAnalyse, ListsEveryFaultAndWritesNothing) {
    const Workplace place;
    place.write("bad.csv", "participant,group,trial,deviation,time_s\n1,a,1,x,0\n1,b,1,0.1,2\n");
    const auto outcome = place.run(kStudy + "analyse --data bad.csv --out out --json r.json");
    EXPECT_EQ(outcome.status, 1);
    for (const char* part : {"bad.csv:2:7: ", "bad.csv:2:9: ", "bad.csv:3:3: ", "bad.csv:3:5: ", "4 faults"})
        EXPECT_TRUE(outcome.output.contains(part)) << part << "\n" << outcome.output;
    EXPECT_EQ(place.files(), 1u);
}

TEST(StudyAnalyse, RefusesPlacesThatHoldSomethingAlready) {
    const Workplace place;
    place.write("own.csv", kOwn);
    std::filesystem::create_directory(place / "out");
    for (const char* arguments : {"--out out", "--out out/", "--out own.csv", "--out gone/out", "--json gone/r.json"}) {
        const auto outcome = place.run(kStudy + "analyse --data own.csv " + arguments);
        EXPECT_EQ(outcome.status, 1) << arguments << outcome.output;
        EXPECT_EQ(place.files(), 2u) << arguments;
    }
    EXPECT_EQ(place.read("own.csv"), kOwn);
    EXPECT_EQ(place.run(kStudy + "analyse --data missing.csv").status, 1);
    const auto neither = place.run(kStudy + "analyse");
    EXPECT_EQ(neither.status, 1);
    EXPECT_TRUE(neither.output.contains("needs a study's folder or --data")) << neither.output;
}

TEST(StudyAnalyse, TakesTablesWithHardlyAnything) {
    const Workplace place;
    place.write("one.csv", "participant,group,trial,deviation,time_s\n1,a,1,0,2\n");
    place.write("equal.csv", "participant,group,trial,deviation,time_s\n1,a,1,1,2\n2,a,1,1,2\n3,b,1,1,2\n");
    const auto one = place.run(kStudy + "analyse --data one.csv --out o1");
    EXPECT_EQ(one.status, 0) << one.output;
    EXPECT_TRUE(one.output.contains("There is one group"));
    const auto equal = place.run(kStudy + "analyse --data equal.csv --out o2");
    EXPECT_EQ(equal.status, 0) << equal.output;
    EXPECT_TRUE(equal.output.contains("undefined: all values of one variable are equal")) << equal.output;
    EXPECT_FALSE((one.output + equal.output).contains("nan"));
}

TEST(StudyAnalyse, ChecksTheFiguresThatTheUserNames) {
    const Workplace place;
    place.write("own.csv", kOwn);
    place.write("printed.csv",
                "# study: Ours\ntable,quantity,group,participant,trial,printed\n"
                "1,time,touch,p1,1,30\n1,time,touch,p2,1,14\n2,U of time,touch,,,0\n2,U of deviation,touch,,,0\n");
    const auto outcome = place.run(kStudy + "analyse --data own.csv --published printed.csv");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("Of 4 figures that it prints, 2 do not follow")) << outcome.output;
    EXPECT_TRUE(outcome.output.contains("prints 14, the data give 41")) << outcome.output;
}

TEST(StudyPower, PrintsPowerOrParticipantsAndTheSameWithAnyThreads) {
    const Workplace place;
    const auto one = place.run(kStudy + "power --effect 0.8 --studies 1000 --seed 1 --threads 1 --json -");
    const auto two = place.run(kStudy + "power --effect 0.8 --studies 1000 --seed 1 --threads 2 --json -");
    ASSERT_EQ(one.status, 0) << one.output;
    EXPECT_EQ(one.output, two.output);
    EXPECT_GE(Json::parse(one.output).at("power").get<double>(), 0.8);
    const auto null = place.run(kStudy + "power --effect 0");
    EXPECT_EQ(null.status, 0);
    EXPECT_TRUE(null.output.contains("of 1000 simulated studies")) << null.output;
    EXPECT_TRUE(null.output.contains("kept")) << null.output;
    EXPECT_EQ(place.run(kStudy + "power --effect 0.8 --participants 10 --target 0.9").status, 1);
    EXPECT_EQ(place.run(kStudy + "power --effect 0.8 --participants 1").status, 2);
    EXPECT_EQ(place.run(kStudy + "power").status, 2);
}

}  // namespace
}  // namespace burin
