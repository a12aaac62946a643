// SPDX-License-Identifier: MIT
// A participant's page: its language, its colours, how much was done, how sure a change is; its table; who has
// withdrawn; and whose files they are.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/measures/hand_measures.hpp"
#include "activities/rehab/progress/line_fit.hpp"
#include "activities/rehab/progress/patient_page.hpp"
#include "base/file_io.hpp"
#include "tests/activities/kept_runs.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

std::string page_in(const std::string& language, const KeptRuns& kept) {
    const Result<PageTexts> texts = PageTexts::in(language);
    EXPECT_TRUE(texts) << texts.error().line();
    return texts ? patient_page(all_of(kept), levels_of_ball, *texts, "a test") : "";
}

fs::perms mode_of(const fs::path& place) { return fs::status(place).permissions(); }

std::string page_place(unsigned participant) { return "p" + std::to_string(participant) + ".html"; }

}  // namespace

TEST(PageTexts, AreWholeInEveryLanguage) {
    const std::vector<std::string> codes = PageTexts::codes();
    EXPECT_GE(codes.size(), 3u);
    for (const std::string& code : codes) {
        const Result<PageTexts> texts = PageTexts::in(code);
        ASSERT_TRUE(texts) << texts.error().line();
        for (const ExerciseKind& kind : exercise_kinds()) EXPECT_TRUE(texts->has(kind.name)) << code << kind.name;
        for (const ExerciseKind& kind : exercise_kinds())
            for (const auto& count : kind.make(SettingValues(kind.settings))->course().counts)
                EXPECT_TRUE(texts->has("count_" + std::string(count.key))) << code << ": count_" << count.key;
        for (const char* finger : kFingerNames) EXPECT_TRUE(texts->has(finger)) << code << finger;
    }
    const auto none = PageTexts::in("xx");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().line(), "--language xx: is none of the languages; there are de, en, fr");
}

TEST(PageTexts, ThatAreMissingUnknownOrOfOtherWordsAreNamed) {
    const Workplace at;
    const Result<PageTexts> english = PageTexts::in("en");
    ASSERT_TRUE(english);
    const std::string german = *read_text_file("assets/languages/de.toml");
    const auto without = [&](const std::string& what, const std::string& with) {
        std::string text = german;
        const std::size_t from = text.find(what), to = text.find('\n', from);
        text.replace(from, to - from, with);
        at.write("de.toml", text);
        const auto read = PageTexts::read(at / "de.toml", &*english);
        return read ? std::string() : read.error().line();
    };
    EXPECT_TRUE(without("thumb = ", "").contains("has no text thumb"));
    EXPECT_TRUE(without("thumb = ", "tumb = \"Daumen\"").contains("tumb is no text of the page"));
    EXPECT_TRUE(without("level = ", "level = \"Stufe {stufe}\"").contains("level has other words in braces"));
    EXPECT_TRUE(without("thumb = ", "thumb = 3").contains("thumb is no text"));
}

TEST(PageTexts, WriteNumbersAndDatesAsTheLanguageDoes) {
    const auto english = PageTexts::in("en"), german = PageTexts::in("de"), french = PageTexts::in("fr");
    ASSERT_TRUE(english && german && french);
    EXPECT_EQ(english->number(2.5, 2), "2.50");
    EXPECT_EQ(german->number(2.5, 2), "2,50");
    EXPECT_EQ(german->number(-0.001, 1), "0,0");
    EXPECT_EQ(german->number(std::nan(""), 1), "-");
    EXPECT_EQ(german->date("2026-11-03"), "03.11.2026");
    EXPECT_EQ(french->date("2026-11-03"), "03/11/2026");
    EXPECT_EQ(english->date("2026-11-03"), "2026-11-03");
}

// By hand: Sxx = 10, Sxy = 8, SSE = 3.6, t(0.975; 3) = 3.182446 of the tables.
TEST(LineFit, HasTheIntervalOfTheTables) {
    const std::vector<std::pair<double, double>> points{{0, 1}, {1, 3}, {2, 2}, {3, 5}, {4, 4}};
    const auto fit = line_through(points);
    ASSERT_TRUE(fit);
    EXPECT_DOUBLE_EQ(fit->slope, 0.8);
    EXPECT_EQ(fit->freedom, 3u);
    EXPECT_NEAR(fit->highest - fit->slope, 3.182446 * std::sqrt(1.2 / 10.0), 1e-5);
    EXPECT_FALSE(fit->is_beyond_scatter());
    EXPECT_FALSE(line_through(std::span(points).first(2)));
    const std::vector<std::pair<double, double>> same_day{{1, 1}, {1, 2}, {1, 3}};
    EXPECT_FALSE(line_through(same_day)) << "no line through one day";
}

TEST(PatientPage, SaysHowMuchHasChangedAndHowSureThatIs) {
    KeptRuns kept;
    const std::vector<double> scores{60, 64, 70, 73, 81};
    for (std::size_t i = 0; i < scores.size(); ++i)
        kept.runs.push_back(run_of(7, "2026-11-0" + std::to_string(i + 1), scores[i]));
    kept.runs.push_back(run_of(7, "2026-11-06", 0, 1, "broken off"));
    const std::string page = page_in("en", kept);
    // A line through days 0 to 4: slope 51 / 10 a day, 35.7 a week; SSE = 262.2... - 260.1; s / sqrt(Sxx) by hand.
    const double slope = 7.0 * 5.1, sse = 265.2 - 260.1, half = 7.0 * 3.182446 * std::sqrt(sse / 3.0 / 10.0);
    char row[200];
    std::snprintf(
        row, sizeof row,
        "<td>Score</td><td class=\"number\">60</td><td class=\"number\">81</td><td class=\"number\">+%.1f</td>"
        "<td class=\"number\">%.1f \xE2\x80\xA6 %.1f</td><td>yes</td>",
        slope, slope - half, slope + half);
    EXPECT_TRUE(page.contains(row)) << row;
    EXPECT_TRUE(page.contains("3 degrees of freedom")) << "five runs were carried to an end";
    EXPECT_TRUE(page.contains("no minimal detectable change"));
    kept.runs.erase(kept.runs.begin() + 2, kept.runs.end());
    EXPECT_TRUE(page_in("en", kept).contains("there are 2."));
}

TEST(PatientPage, IsWhollyInItsLanguage) {
    KeptRuns kept;
    for (int day = 1; day <= 4; ++day) kept.runs.push_back(run_of(7, "2026-11-0" + std::to_string(day), 90 + day));
    kept.runs.back().report["comment"] = "Hand <kalt>";
    const std::string page = page_in("de", kept);
    for (const char* text : {"<html lang=\"de\">", "<h1>Verlauf von Person 7</h1>", "Zeigefinger", "01.11.2026", "2,00",
                             "Vorgeschlagen wird Stufe 2: die letzten drei Punktzahlen waren 92; 93; 94.",
                             "Hand &lt;kalt&gt;", "Ausgangswert"})
        EXPECT_TRUE(page.contains(text)) << text;
    for (const char* text : {"index finger", "degrees", "Level", "2026-11-01", "2.00", "nan"})
        EXPECT_FALSE(page.contains(text)) << text;
    EXPECT_FALSE(page_in("fr", kept).contains("Stufe"));
}

// Where the thumb has no such figure, the index does not take its colour.
TEST(PatientPage, HasOneColourForAFingerInEachPlotAndALegendForEach) {
    KeptRuns kept;
    for (int day = 1; day <= 3; ++day) {
        kept.runs.push_back(run_of(7, "2026-11-0" + std::to_string(day), 80));
        kept.runs.back().report["fingers"][1]["fractionation"] = 0.5;
    }
    const std::string page = page_in("en", kept);
    const std::size_t from = page.find("Moving one finger alone"), to = page.find("</svg>", from);
    ASSERT_NE(to, std::string::npos);
    const std::string plot = page.substr(from, to - from);
    EXPECT_TRUE(plot.contains("#d55e00") && plot.contains("index finger")) << plot;
    EXPECT_FALSE(plot.contains("#0072b2") || plot.contains("thumb"));
    std::size_t legends = 0;
    for (std::size_t at = page.find(">index finger</text>"); at != std::string::npos;
         at = page.find(">index finger</text>", at + 1))
        ++legends;
    EXPECT_EQ(legends, 5u) << "two of forces, bending, speed, fractionation";
}

// 2026-11-01 was a Sunday, 2026-11-02 a Monday.
TEST(PatientPage, CountsWhatWasDoneInEachWeek) {
    KeptRuns kept;
    for (const char* day : {"2026-11-01", "2026-11-02", "2026-11-02", "2026-11-17"}) {
        kept.runs.push_back(run_of(7, day, 80));
        kept.runs.back().report["time_s"] = 90.0;
    }
    const std::string page = page_in("en", kept);
    const auto row = [](const char* monday, int visits, const char* minutes, int repetitions) {
        return "<tr><td>" + std::string(monday) + "</td><td class=\"number\">" + std::to_string(visits) +
               "</td><td class=\"number\">" + minutes + "</td><td class=\"number\">" + std::to_string(repetitions) +
               "</td></tr>";
    };
    for (const std::string& week : {row("2026-10-26", 1, "1.5", 5), row("2026-11-02", 1, "3.0", 10),
                                    row("2026-11-09", 0, "0.0", 0), row("2026-11-16", 1, "1.5", 5)})
        EXPECT_TRUE(page.contains(week)) << week;
}

TEST(PatientTable, IsCsvThatKeepsCommentsWhole) {
    KeptRuns kept;
    kept.runs.push_back(run_of(7, "2026-11-01", 80));
    kept.runs.back().report["comment"] = "said \"cold\", warmer\nlater";
    const std::string csv = patient_table(all_of(kept));
    EXPECT_TRUE(csv.starts_with("date,time,hand,side,exercise,level,ended,score,time_s,repetitions,comment,thumb_"));
    EXPECT_TRUE(
        csv.contains("\r\n2026-11-01,10:15:00,simulated-glove,right,ball,1,done,80,31.5,5,"
                     "\"said \"\"cold\"\", warmer\nlater\",2,,1,"))
        << csv;
}

TEST_F(KeptRunsFolder, AreTheirOwnersAlone) {
    keep(run_of(1, "2026-11-03", 70));
    const auto owner = fs::perms::owner_read | fs::perms::owner_write;
    EXPECT_EQ(mode_of(folder), fs::perms::owner_all) << "it was made for the results";
    EXPECT_EQ(mode_of(folder / "participant-001"), fs::perms::owner_all);
    for (const auto& file : fs::directory_iterator(folder / "participant-001")) EXPECT_EQ(mode_of(file), owner);
    const fs::path page = folder / "page.html";
    std::ofstream(page) << "before";
    fs::permissions(page, fs::perms::all);
    ASSERT_TRUE(write_private(page, "now"));
    EXPECT_EQ(mode_of(page), owner) << "also one that others could read before";
}

TEST_F(KeptRunsFolder, OfSomebodyWhoHasWithdrawnAreOnNoPageAndErasedWhereThatIsAsked) {
    keep(run_of(1, "2026-11-03", 70));
    keep(run_of(2, "2026-11-03", 60));
    EXPECT_FALSE(withdraw(folder, 3, "2026-11-05", true)) << "who never was there";
    ASSERT_TRUE(withdraw(folder, 1, "2026-11-05", false));
    EXPECT_TRUE(fs::exists(folder / "participant-001")) << "the runs stay";
    const auto again = withdraw(folder, 1, "2026-11-05", false);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().line(), "participant 1: has withdrawn already; add --erase to erase the runs");
    const auto index = [&] {
        return index_page(read_runs(folder).value(), read_withdrawals(folder).value(), "a test", page_place);
    };
    EXPECT_FALSE(index().contains("Participant 1<"));
    EXPECT_TRUE(index().contains("Participant 2<"));
    ASSERT_TRUE(withdraw(folder, 1, "2026-11-06", true));
    ASSERT_TRUE(withdraw(folder, 2, "2026-11-06", true));
    EXPECT_FALSE(fs::exists(folder / "participant-001") || fs::exists(folder / "participant-002"));
    EXPECT_TRUE(index().contains("There are no runs.")) << "the last one who was erased is gone as well";
    EXPECT_FALSE(withdraw(folder, 2, "2026-11-06", true)) << "nothing is left to erase";
    EXPECT_TRUE(has_withdrawn(read_withdrawals(folder).value(), 2)) << "the number is given to nobody else";
}

TEST_F(KeptRunsFolder, BehindALinkAreNotTakenForErased) {
    keep(run_of(1, "2026-11-03", 70));
    fs::rename(folder / "participant-001", folder / "elsewhere");
    fs::create_directory_symlink(folder / "elsewhere", folder / "participant-001");
    const auto erased = withdraw(folder, 1, "2026-11-05", true);
    ASSERT_FALSE(erased);
    EXPECT_TRUE(erased.error().line().contains("is a link"));
    EXPECT_FALSE(has_withdrawn(read_withdrawals(folder).value(), 1));
}

}  // namespace burin::activities
