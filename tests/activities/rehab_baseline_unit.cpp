// SPDX-License-Identifier: MIT
// A person's baseline: which assessment it is, what it fits of an exercise's settings, and its place on the page.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/game/game.hpp"
#include "activities/rehab/progress/baseline.hpp"
#include "activities/rehab/progress/page_texts.hpp"
#include "activities/rehab/progress/patient_page.hpp"
#include "tests/activities/kept_runs.hpp"

namespace burin::activities {
namespace {

KeptRun assessment(unsigned participant, const std::string& date, double closed, double most_N,
                   const std::string& ended = "done") {
    const Json finger{{"finger", "index"},
                      {"range_of_motion_rad", Json::array({0.1, closed, closed, closed})},
                      {"strength_N", most_N / 4.0},
                      {"peak_speed_rad_per_s", 2.0},
                      {"fractionation", Json()}};
    return {participant,
            date,
            "10:15:00",
            "glove:4",
            {{"exercise", "assess"},
             {"settings", {{"bound_N", 8.0}}},
             {"ended", ended},
             {"score", 100.0},
             {"time_s", 94.0},
             {"counts", {{"parts", 9}}},
             {"person_range", {{"most_N", most_N}, {"open", 0.05}, {"closed", closed}}},
             {"assess", {{"fingers", Json::array({finger})}, {"strength_together_N", most_N}}},
             {"fingers", Json::array({{{"finger", "index"}}})}}};
}

SettingValues usual_ball() { return SettingValues(Ball::setting_kinds()); }

}  // namespace

TEST(Baselines, AreThePersonsNewestAssessmentThatWasCarriedToItsEnd) {
    std::vector<KeptRun> runs{assessment(7, "2026-11-01", 0.4, 3.0), assessment(7, "2026-11-02", 0.5, 4.0),
                              assessment(7, "2026-11-03", 0.9, 9.0, "broken off"),
                              assessment(8, "2026-11-04", 0.8, 8.0)};
    runs.push_back(assessment(7, "2026-11-05", 0.7, 7.0));
    runs.back().report["side"] = "left";
    const auto right = baseline_of(runs, 7);
    ASSERT_TRUE(right);
    EXPECT_EQ(right->date, "2026-11-02");
    EXPECT_EQ(right->closed, 0.5);
    EXPECT_EQ(right->most_N, 4.0);
    EXPECT_EQ(baseline_of(runs, 7, "left")->most_N, 7.0);
    EXPECT_FALSE(baseline_of(runs, 9));
    EXPECT_FALSE(baseline_of(runs, 8, "left"));
}

TEST(Baselines, GiveTheSettingsOfThePersonThatNobodyHasSet) {
    const Baseline baseline{"2026-11-02", "10:15:00", 0.05, 0.5, 4.0};
    const FittedValues fitted = fitted_by(usual_ball(), baseline);
    EXPECT_EQ(fitted.taken, (std::vector<std::string>{"open", "closed", "most_N"}));
    EXPECT_EQ(ball_settings(fitted.values).target_N(), 1.0) << "a quarter of the person's most";
    EXPECT_EQ(text_of(baseline, fitted), "the assessment of 2026-11-02 10:15:00: open 0.05, closed 0.5, most_N 4");
    SettingValues by_hand = usual_ball();
    by_hand.set("most_N", 0.0);  // what is usual, and yet somebody's word
    by_hand.set("closed", 0.8);
    const FittedValues kept = fitted_by(by_hand, baseline);
    EXPECT_TRUE(kept.taken.empty());
    EXPECT_EQ(kept.values, by_hand);
    const FittedValues game = fitted_by(SettingValues(Game::setting_kinds()), baseline);
    EXPECT_EQ(game.taken, (std::vector<std::string>{"open", "closed"})) << "it asks for no force";
}

TEST(Baselines, LeaveOutWhatIsTooSmallToBeASetting) {
    const FittedValues short_way = fitted_by(usual_ball(), {"2026-11-02", "10:15:00", 0.05, 0.15, 4.0});
    EXPECT_EQ(short_way.taken, std::vector<std::string>{"most_N"});
    EXPECT_EQ(short_way.values.number("closed"), 1.0);
    EXPECT_TRUE(short_way.left_out.contains("0.15 - 0.05 = 0.1")) << short_way.left_out;
    const FittedValues weak = fitted_by(usual_ball(), {"2026-11-02", "10:15:00", 0.05, 0.5, 0.3});
    EXPECT_EQ(weak.values.number("most_N"), 0.0);
    EXPECT_TRUE(weak.left_out.contains("0.30 N, is too little")) << weak.left_out;
    const FittedValues no_way = fitted_by(usual_ball(), {"2026-11-02", "10:15:00", {}, {}, 4.0});
    EXPECT_EQ(no_way.taken, std::vector<std::string>{"most_N"});
}

// 3 * 0.4 rad are 69 degrees, 3 * 0.5 rad are 86.
TEST(Baselines, StandOnThePageBesideTheFirst) {
    KeptRuns kept;
    kept.runs = {assessment(7, "2026-11-01", 0.4, 3.0)};
    const auto page_in = [&](const char* language) {
        const auto no_levels = [](std::string_view) { return 0u; };
        return patient_page(all_of(kept), no_levels, PageTexts::in(language).value(), "Burin");
    };
    EXPECT_TRUE(page_in("en").contains("<td class=\"number\">69</td>"));
    kept.runs.push_back(assessment(7, "2026-11-02", 0.5, 4.0));
    const std::string page = page_in("en");
    EXPECT_TRUE(
        page.contains("the assessment of 2026-11-02 10:15:00. All fingers together pressed with 4.00, at first "
                      "3.00 newtons"));
    EXPECT_TRUE(page.contains("<td class=\"number\">86, at first 69</td><td class=\"number\">1.00, at first 0.75</td>"))
        << page;
    EXPECT_TRUE(page.contains("<td class=\"number\">-, at first -</td>")) << "no fractionation was measured";
    EXPECT_TRUE(
        page_in("de").contains("Messung vom 02.11.2026 10:15:00. Alle Finger zusammen drückten mit 4,00, "
                               "zuerst 3,00 Newton"));
    const KeptRun broken = assessment(7, "2026-11-01", 0.4, 3.0, "broken off");
    const std::vector<const KeptRun*> none{&broken};
    EXPECT_TRUE(baseline_table(none, PageTexts::in("en").value()).contains("there is no baseline"));
}

// An assessment has no level, and is a run as the others are.
TEST(Baselines, AreKeptAndReadAgain) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "burin-baselines";
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(prepare_results(folder, 7));
    ASSERT_TRUE(keep_run(folder, assessment(7, "2026-11-02", 0.5, 4.0)));
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept);
    EXPECT_TRUE(kept->errors.empty()) << kept->errors.front().line();
    ASSERT_TRUE(baseline_of(kept->runs, 7));
    EXPECT_EQ(baseline_of(kept->runs, 7)->open, 0.05);
    std::filesystem::remove_all(folder);
}

}  // namespace burin::activities
