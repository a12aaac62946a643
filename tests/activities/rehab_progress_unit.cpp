// SPDX-License-Identifier: MIT
// What is kept of runs of exercises, what is proposed after them, and their page.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "activities/rehab/progress/patient_page.hpp"
#include "tests/activities/kept_runs.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

Proposal after(const std::vector<KeptRun>& runs) {
    std::vector<const KeptRun*> all;
    for (const KeptRun& run : runs) all.push_back(&run);
    return proposed(all, 3);
}

std::string page_of(unsigned participant) { return "p" + std::to_string(participant); }

std::string page_of_all(const KeptRuns& kept) {
    const Result<PageTexts> texts = PageTexts::in("en");
    EXPECT_TRUE(texts);
    return patient_page(all_of(kept), levels_of_ball, *texts, "a test");
}

}  // namespace

TEST(Proposals, AreOfALevelUpOrDownAfterThreeRunsThatAgree) {
    const auto day = [](int n) { return "2026-11-0" + std::to_string(n); };
    const auto three = [&](double a, double b, double c, double level) {
        return after({run_of(1, day(1), a, level), run_of(1, day(2), b, level), run_of(1, day(3), c, level)});
    };
    EXPECT_EQ(three(95, 90, 100, 1).level, 2u);
    EXPECT_EQ(three(95, 90, 100, 1).reason, "Level 2 is proposed: the last three scores were 95, 90, 100.");
    EXPECT_EQ(three(95, 89, 100, 1).level, 0u);
    EXPECT_EQ(three(95, 90, 100, 3).level, 0u) << "there is no higher one";
    EXPECT_EQ(three(40, 10, 0, 2).level, 1u);
    EXPECT_EQ(three(40, 10, 0, 1).level, 0u) << "there is no lower one";
    EXPECT_EQ(three(40, 41, 0, 2).level, 0u);
    EXPECT_EQ(after({run_of(1, day(1), 99), run_of(1, day(2), 99)}).level, 0u);
    const auto mixed = after({run_of(1, day(1), 99), run_of(1, day(2), 99, 2), run_of(1, day(3), 99, 2)});
    EXPECT_TRUE(mixed.reason.contains("different settings")) << mixed.reason;
    const auto broken = after({run_of(1, day(1), 99), run_of(1, day(2), 99, 1, "broken off"), run_of(1, day(3), 99)});
    EXPECT_EQ(broken.reason, "Level 1 stays: a proposal takes 3 runs that were carried to an end, and there are 2.");
    EXPECT_EQ(after({run_of(1, day(1), 99, 1, "broken off")}).reason,
              "Level 1 stays: a proposal takes 3 runs that were carried to an end, and there are 0.");
    const auto among = after(
        {run_of(1, day(1), 99), run_of(1, day(2), 99), run_of(1, day(3), 0, 1, "broken off"), run_of(1, day(4), 99)});
    EXPECT_EQ(among.level, 2u) << among.reason;
}

// Runs that were kept before a setting was there had no other one.
TEST(Proposals, TakeASettingThatARunLacksAsItsDefault) {
    const KeptRun old = run_of(1, "2026-11-01", 95);
    KeptRun now = run_of(1, "2026-11-02", 95);
    for (const auto& [key, value] : {std::pair("open", 0.0), {"closed", 1.0}, {"share", 0.1}, {"most_N", 0.0}})
        now.report["settings"][key] = value;
    now.report["settings"]["start"] = "pressed";
    EXPECT_EQ(after({old, old, now}).level, 2u) << after({old, old, now}).reason;
    EXPECT_EQ(after({now, now, old}).level, 2u);
    KeptRun fitted = now;
    fitted.report["settings"]["closed"] = 0.5;
    EXPECT_TRUE(after({old, old, fitted}).reason.contains("different settings"));
    KeptRun at_once = now;
    at_once.report["settings"]["start"] = "at_once";
    EXPECT_TRUE(after({now, now, at_once}).reason.contains("different settings"));
}

TEST_F(KeptRunsFolder, AreReadAsTheyWereKeptByParticipantAndTime) {
    keep(run_of(2, "2026-11-02", 50));
    keep(run_of(1, "2026-11-03", 70));
    keep(run_of(1, "2026-10-31", 60));
    keep(run_of(1, "2026-11-03", 80));  // of the same second: a file of its own
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept) << kept.error().line();
    EXPECT_TRUE(kept->errors.empty());
    std::vector<double> scores;
    for (const KeptRun& run : kept->runs) scores.push_back(run.report.at("score").get<double>());
    EXPECT_EQ(scores.size(), 4u);
    EXPECT_EQ(scores.front(), 60.0);
    EXPECT_EQ(scores.back(), 50.0);
    EXPECT_EQ(kept->runs.front().report, run_of(1, "2026-10-31", 60).report);
}

// What is proposed depends on which run was the last.
TEST_F(KeptRunsFolder, AreInTheOrderInWhichTheyWereDoneWithinASecond) {
    constexpr int kRuns = 11;
    for (int i = 0; i < kRuns; ++i) keep(run_of(1, "2026-11-03", i));
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept) << kept.error().line();
    ASSERT_EQ(kept->runs.size(), std::size_t{kRuns});
    for (int i = 0; i < kRuns; ++i)
        EXPECT_EQ(kept->runs[static_cast<std::size_t>(i)].report.at("score").get<double>(), i);
}

// A file that is cut, or is anything else, is named and left out; the others are read.
TEST_F(KeptRunsFolder, TellWhatCannotBeRead) {
    keep(run_of(1, "2026-11-03", 70));
    const fs::path own = folder / "participant-001";
    const fs::path whole = *fs::directory_iterator(own);
    std::ifstream in(whole);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    std::size_t wrong = 0;
    for (const std::string& damaged :
         {text.substr(0, text.size() / 2), std::string(), std::string("[1, 2]"), std::string("{\"run\": 7}"),
          std::string("{\"run\": 1, \"participant\": -3}"),
          std::string("{\"run\": 1, \"participant\": 1, \"date\": \"2026-13-45\", \"time\": \"10:00:00\", \"hand\": "
                      "\"x\", \"report\": {}}"),
          std::string("{\"run\": 1, \"participant\": 1, \"date\": \"2026-11-03\", \"time\": \"10:00:00\", \"hand\": "
                      "\"x\", \"report\": {\"exercise\": \"ball\"}}"),
          text})
        std::ofstream(own / ("wrong" + std::to_string(wrong++) + ".json")) << damaged;
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->runs.size(), 1u);
    ASSERT_EQ(kept->errors.size(), wrong);
    EXPECT_TRUE(kept->errors.front().line().contains("wrong0.json: is cut or damaged")) << kept->errors.front().line();
    const std::string page = index_page(*kept, {}, "a test", page_of);
    EXPECT_TRUE(page.contains("Left out: ") && page.contains("wrong3.json"));
    EXPECT_FALSE(read_runs(folder / "nothing"));
}

// A report of what is no exercise, no finger or no level is shown in no plot.
TEST_F(KeptRunsFolder, LeaveOutRunsWhoseExerciseFingersOrLevelAreNone) {
    const auto with = [](const char* place, const Json& value) {
        KeptRun run = run_of(1, "2026-11-03", 70);
        run.report[Json::json_pointer(place)] = value;
        return run;
    };
    keep(run_of(1, "2026-11-03", 70));
    keep(with("/exercise", "juggling"));
    keep(with("/fingers", Json::array()));
    keep(with("/fingers/0/finger", "toe"));
    for (const double level : {0.0, 4.0, 1.5}) keep(with("/settings/level", level));
    keep(with("/settings", Json::object()));
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->runs.size(), 1u);
    EXPECT_EQ(kept->errors.size(), 7u);
    const std::string page = page_of_all(*kept);
    EXPECT_TRUE(page.contains("Runs: 1, on days: 1")) << page;
}

TEST_F(KeptRunsFolder, KeepOlderRunsWhereANewOneCannotBeWritten) {
    keep(run_of(1, "2026-11-03", 70));
    std::ofstream(folder / "participant-002") << "a file, no folder";
    EXPECT_FALSE(prepare_results(folder, 2));
    EXPECT_FALSE(keep_run(folder, run_of(2, "2026-11-04", 10)));
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->runs.size(), 1u);
}

TEST(KeptRuns, HaveDatesOfTheCalendar) {
    EXPECT_TRUE(check_date("2028-02-29"));
    for (const char* wrong : {"2026-02-29", "2026-13-01", "26-11-03", "2026-11-3", "2026/11/03", "today", ""})
        EXPECT_FALSE(check_date(wrong)) << wrong;
    EXPECT_EQ(day_of("1970-01-02"), 1);
    EXPECT_EQ(day_of("2026-11-03") - day_of("2026-10-31"), 3);
}

TEST(ProgressPage, ShowsAParticipantByNumberAndSaysWhatNoPersonDid) {
    KeptRuns kept;
    for (int day = 1; day <= 5; ++day)
        kept.runs.push_back(run_of(7, "2026-11-0" + std::to_string(day), 80.0 + 4.0 * day));
    kept.runs.push_back(run_of(7, "2026-11-06", 20));
    kept.runs.back().hand = "scripted, seed 4";
    kept.runs.back().report["settings"]["note"] = "<script>";
    const std::string page = page_of_all(kept);
    for (const char* text : {"<h1>Progress of participant 7</h1>", "<h2>Squeezing a ball</h2>",
                             "Runs: 6, on days: 6, from 2026-11-01 to 2026-11-06",
                             "Level 1 stays: the last three runs had different settings.",
                             "1 of these runs were done by a simulated hand", "&lt;script&gt;", "</svg>"})
        EXPECT_TRUE(page.contains(text)) << text;
    EXPECT_FALSE(page.contains("<script>"));
    EXPECT_FALSE(page.contains("nan"));
}

TEST(ProgressPage, HasAskedAndGivenForcesSideBySide) {
    KeptRuns kept;
    kept.runs.push_back(run_of(7, "2026-11-01", 80));
    Json fingers = Json::array();
    for (const auto& [asked_N, given_N] : {std::pair(2.5, 2.25), {1.0, 0.0}})
        fingers.push_back({{"finger", "index"}, {"peak_force_N", asked_N}, {"peak_measured_N", given_N}});
    fingers.push_back({{"finger", "ring"}, {"peak_force_N", 0.75}, {"peak_measured_N", nullptr}});
    kept.runs.back().report["fingers"] = fingers;
    const std::string page = page_of_all(kept);
    EXPECT_TRUE(page.contains("<th>asked, N</th><th>given, N</th>"));
    EXPECT_TRUE(page.contains("<td>2.50; 1.00; 0.75</td><td>2.25; 0.00; -</td>"));
}

// One run, and runs of a few days, once had ticks at fractions of a day, and before the first.
TEST(ProgressPage, MarksWholeDaysAlone) {
    for (const int last : {1, 3, 5}) {
        KeptRuns kept;
        for (int day = 1; day <= last; ++day) kept.runs.push_back(run_of(7, "2026-11-0" + std::to_string(day), 80));
        const std::string page = page_of_all(kept);
        const std::string at_axis = "\" text-anchor=\"middle\">";  // neither bold, as titles are, nor upright
        unsigned ticks = 0;
        for (std::size_t at = page.find(at_axis); at != std::string::npos; at = page.find(at_axis, at + 1)) {
            const std::string label = page.substr(at + at_axis.size(), page.find('<', at) - at - at_axis.size());
            if (label == "day") continue;
            ++ticks;
            EXPECT_TRUE(label == "0" || label == "1" || label == "2" || label == "3" || label == "4") << label;
        }
        EXPECT_GE(ticks, static_cast<unsigned>(last));
    }
}

}  // namespace burin::activities
