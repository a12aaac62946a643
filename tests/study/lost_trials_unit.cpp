// SPDX-License-Identifier: MIT
// What is told of trials that were lost, and of attempts that nobody lost: rows, numbers, boxes and curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "study/people/trial_rows.hpp"
#include "study/report/study_figures.hpp"
#include "study/table/trial_table.hpp"
#include "tests/study/lost_study.hpp"

namespace burin::study {
namespace {

const std::string kTestAndTransfer = "\"test\", \"transfer\"";

LostVisit loses_the_first() {
    LostVisit visit;
    return visit.say("start").come("arc").goes_back(3).say("start").come("wave").through();
}

LostVisit does_both() {
    LostVisit visit;
    return visit.say("start").come("arc").through().say("start").come("wave").through();
}

}  // namespace

// The second trial of who lost the first was "trial 1, 0 failed attempts".
TEST(LostTrials, AreRowsAndTheNextTrialKeepsItsNumber) {
    const Workplace place;
    make_lost_study(place, {kTestAndTransfer});
    const auto went = visit_by(place, "p01", loses_the_first());
    ASSERT_EQ(went.status, 0) << went.output;
    EXPECT_TRUE(went.output.contains("trials.csv: 1 trials, and 1 rows without measures")) << went.output;
    const auto rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), 2u) << place.read("s/trials.csv");
    EXPECT_EQ(rows[0].at("trial"), "1");
    EXPECT_EQ(rows[0].at("stage"), "test");
    EXPECT_EQ(rows[0].at("world"), "arc");
    EXPECT_EQ(rows[0].at("place"), "1");
    EXPECT_EQ(rows[0].at("run"), "1");
    EXPECT_EQ(rows[0].at("reason"), "no attempt left: went back 3");
    EXPECT_EQ(rows[0].at("failed_attempts"), "3");
    EXPECT_EQ(rows[0].at("interrupted_attempts"), "0");
    for (const char* measure : {"deviation_mm", "time_s", "path_m", "force_mean_N"}) EXPECT_EQ(rows[0].at(measure), "");
    EXPECT_EQ(rows[1].at("trial"), "2");
    EXPECT_EQ(rows[1].at("stage"), "transfer");
    EXPECT_EQ(rows[1].at("reason"), "");
    EXPECT_EQ(rows[1].at("failed_attempts"), "0");
    EXPECT_NE(rows[1].at("time_s"), "");
    // The table is read again as it is, and the lost trial is told.
    const auto analysed = place.run(kLostStudy + "analyse --data s/trials.csv");
    EXPECT_EQ(analysed.status, 0) << analysed.output;
    EXPECT_TRUE(analysed.output.contains("1 trials, 1 groups")) << analysed.output;
    EXPECT_TRUE(analysed.output.contains("1 rows have no measures and are not analysed: 1 no attempt left"))
        << analysed.output;
}

TEST(LostTrials, OfAStudyWithoutAnyValidOneAreToldAllTheSame) {
    const Workplace place;
    make_lost_study(place, {"\"test\""});
    LostVisit visit;
    ASSERT_EQ(visit_by(place, "p01", visit.say("start").come("arc").goes_back(3)).status, 0);
    EXPECT_EQ(rows_of_csv(place.read("s/trials.csv")).size(), 1u);
    const auto reported = place.run(kLostStudy + "report s");
    EXPECT_EQ(reported.status, 0) << reported.output;
    EXPECT_TRUE(reported.output.contains("holds no valid trial, so that nothing is analysed")) << reported.output;
    EXPECT_TRUE(place.read("s/reports/001/report.html").contains("Group sight: 3 failed attempts in 1 trials"));
}

// Three pauses and repeats stood as three failed attempts of who failed nothing.
TEST(LostTrials, CountTheOperatorsPausesAndRepeatsApart) {
    const Workplace place;
    make_lost_study(place, {kTestAndTransfer});
    LostVisit visit;
    visit.say("start").come("arc").taken_back("pause").taken_back("pause").taken_back("repeat").goes_back(1).through();
    const auto went = visit_by(place, "p02", visit);
    ASSERT_EQ(went.status, 0) << went.output;
    const auto rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), 1u) << went.output;
    EXPECT_EQ(rows[0].at("reason"), "") << went.output;
    EXPECT_EQ(rows[0].at("failed_attempts"), "1");
    EXPECT_EQ(rows[0].at("interrupted_attempts"), "3");
    ASSERT_EQ(place.run(kLostStudy + "report s").status, 0);
    const std::string html = place.read("s/reports/001/report.html");
    EXPECT_TRUE(
        html.contains("Group touch: 1 failed attempts in 1 trials (went back 1); 3 more attempts were "
                      "interrupted by the operator or the device (paused 2, repeated 1)."))
        << html.substr(html.find("Failed attempts"), 400);
    EXPECT_EQ(place.run(kLostStudy + "replay s").status, 0);
}

TEST(LostTrials, StandBesideBaselinesWhichHaveRowsWithoutMeasures) {
    const Workplace place;
    make_lost_study(place, {"\"before\", \"test\""});
    LostVisit visit;
    visit.say("start").come("arc").through().say("start").come("arc").through();
    ASSERT_EQ(visit_by(place, "p01", visit).status, 0);
    const auto rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].at("reason"), "baseline");
    EXPECT_EQ(rows[0].at("trial"), "1");
    EXPECT_EQ(rows[0].at("time_s"), "");
    EXPECT_EQ(rows[1].at("trial"), "2");
    EXPECT_NE(rows[1].at("time_s"), "");
}

// An interrupted stage that is done again keeps its place, and its row says that it was the second run.
TEST(LostTrials, TellTheRunThatCounts) {
    const Workplace place;
    make_lost_study(place, {kTestAndTransfer});
    LostVisit broken;
    ASSERT_EQ(visit_by(place, "p01", broken.say("start").come("arc")).status, 0);
    auto rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("reason"), "interrupted");
    EXPECT_EQ(rows[0].at("failed_attempts"), "") << "nobody knows how it would have gone on";
    ASSERT_EQ(visit_by(place, "p01", does_both()).status, 0);
    rows = rows_of_csv(place.read("s/trials.csv"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].at("run"), "2");
    EXPECT_EQ(rows[0].at("reason"), "");
    EXPECT_EQ(rows[1].at("run"), "1");
}

// Of two participants "1 unfinished" and "2 analysed".
TEST(StudyFlow, PutsEachParticipantIntoOneBox) {
    const Workplace place;
    make_lost_study(place, {kTestAndTransfer});
    ASSERT_EQ(visit_by(place, "p01", loses_the_first()).status, 0);  // some of the outcome trials
    ASSERT_EQ(visit_by(place, "p02", does_both()).status, 0);        // all
    LostVisit half;
    ASSERT_EQ(visit_by(place, "p03", half.say("start").come("arc").goes_back(3)).status, 0);  // none, unfinished
    ASSERT_EQ(place.run(kLostStudy + "withdraw s p04").status, 0);
    const auto study = StudyFolder::open(place / "s", StudyAccess::read);
    ASSERT_TRUE(study);
    for (const FlowOfGroup& g : flow_of_groups(*study, trial_rows(*study))) {
        EXPECT_EQ(g.allocated, 2u);
        EXPECT_EQ(g.allocated, g.not_analysed() + g.analysed()) << g.group;
        EXPECT_EQ(g.withdrew, g.group == "touch" ? 1u : 0u);
        EXPECT_EQ(g.unfinished, g.group == "touch" ? 0u : 1u);
        EXPECT_EQ(g.with_all, g.group == "touch" ? 1u : 0u);
        EXPECT_EQ(g.with_some, g.group == "touch" ? 0u : 1u);
    }
    const auto reported = place.run(kLostStudy + "report s");
    ASSERT_EQ(reported.status, 0) << reported.output;
    EXPECT_TRUE(reported.output.contains("Participants do not have valid trials of the same places of the protocol"))
        << reported.output;
    EXPECT_TRUE(
        reported.output.contains("trial 1 (test), trial 2 (transfer): 1 of touch; trial 2 (transfer): 1 of "
                                 "sight"))
        << reported.output;
    const std::string html = place.read("s/reports/001/report.html");
    EXPECT_TRUE(html.contains("1 not analysed</text>")) << "the figure has the same boxes";
    EXPECT_TRUE(html.contains("0 withdrew, 1 not finished, 0 no valid trial"));
    EXPECT_TRUE(html.contains("0 with all outcome trials, 1 with some"));
}

namespace {

const std::string kTwoDays =
    "participant,group,trial,deviation_mm,time_s,day,stage,world,reason\n"
    "p1,touch,1,1,10,1,test,arc,\np1,touch,2,1,9,1,test,arc,\np1,touch,3,1,12,1,transfer,wave,\n"
    "p1,touch,4,1,8,2,test,arc,\np1,touch,5,,,2,test,arc,no attempt left\np1,touch,6,1,7,2,test,arc,\n"
    "p2,sight,1,1,20,1,test,arc,\np2,sight,2,1,19,1,test,arc,\n";

std::size_t paths_of(const std::string& svg, const std::string& width) {
    std::size_t count = 0;
    const std::string part = "stroke-width=\"" + width + "\"/>";
    for (std::size_t at = svg.find("<path d=\"M"); at != std::string::npos; at = svg.find("<path d=\"M", at + 1))
        count += svg.substr(at, svg.find('\n', at) - at).contains(part) ? 1 : 0;
    return count;
}

}  // namespace

// One line ran through test, transfer and the next day.
TEST(LearningCurves, HaveAPlotForEachStageAndWorldAndALineForEachDay) {
    const ParsedTable table = parse_trials(kTwoDays);
    ASSERT_TRUE(table.faults.empty()) << line_of(table.faults.front(), "t");
    ASSERT_EQ(table.table.lost.size(), 1u);
    const std::string svg = learning_figure(table.table, "time", "s", &Trial::time);
    EXPECT_TRUE(svg.contains(">test, world arc</text>"));
    EXPECT_TRUE(svg.contains(">transfer, world wave</text>"));
    // p1: day 1 (trials 1, 2), transfer, day 2 before the lost trial and after it; p2: one line.
    EXPECT_EQ(paths_of(svg, "0.7"), 5u);
    // Medians: touch on both days and in the transfer, sight on one.
    EXPECT_EQ(paths_of(svg, "3"), 4u);
}

TEST(LearningCurves, GiveAGroupsMedianTheGroupsColour) {
    const std::string svg = learning_figure(parse_trials(kTwoDays).table, "time", "s", &Trial::time);
    std::map<std::string, std::string> colour_of_width;
    for (const char* group : {"touch", "sight"}) {
        std::vector<std::string> colours;
        for (const std::string& name : {std::string(group), std::string(group) + ", median"}) {
            // The legend's sign stands before its name.
            const std::size_t text = svg.find(">" + name + "</text>");
            ASSERT_NE(text, std::string::npos) << name;
            const std::size_t line = svg.rfind("<line ", text), at = svg.find("stroke=\"", line) + 8;
            colours.push_back(svg.substr(at, svg.find('"', at) - at));
        }
        EXPECT_EQ(colours[0], colours[1]) << group;
        EXPECT_TRUE(colour_of_width.emplace(colours[0], group).second) << "two groups of one colour";
    }
}

TEST(LostTrials, WithoutAReasonAreAFaultOfATable) {
    const ParsedTable parsed =
        parse_trials("participant,group,trial,deviation_mm,time_s,reason\np1,a,1,,,\np1,a,2,,,lost\np1,a,2,1,2,\n");
    ASSERT_EQ(parsed.faults.size(), 3u);
    EXPECT_EQ(parsed.faults[0].line, 2u);
    EXPECT_TRUE(parsed.faults[0].remedy.contains("say why in a column reason")) << parsed.faults[0].remedy;
    EXPECT_EQ(parsed.faults[2].line, 4u) << "a lost trial has its number";
    const ParsedTable both = parse_trials("participant,group,trial,deviation_mm,time_s,reason\np1,a,1,1,2,lost\n");
    ASSERT_EQ(both.faults.size(), 1u);
    EXPECT_EQ(both.faults[0].line, 2u) << "measured, and lost";
}

// Journals and figures of a Burin that counted all attempts together, numbered no runs and called any wand simulated.
TEST(EarlierStudies, AreReadAsFarAsTheyTell) {
    std::string text;
    const auto add = [&](const Json& value) { text += journal_line(parse_journal(text).last_digest, value); };
    const auto at = [](Json value) {
        value["time"] = "2026-11-01T10:00:00Z";
        value["participant"] = "p01";
        return value;
    };
    add(Json{{"event", "study made"}, {"time", "2026-11-01T09:00:00Z"}});
    add(at({{"event", "enrolled"}, {"stratum", "all"}, {"position", 1u}, {"group", "touch"}, {"simulated", false}}));
    add(at({{"event", "visit"}, {"device", "simulated wand"}}));
    const Json stage{{"day", 1u}, {"place", 3u}, {"stage", "test"}};
    Json begun = stage, ended = stage;
    begun.update({{"event", "stage begun"}, {"recording", "data/p01/day1-03-run2.session"}});
    ended.update({{"event", "stage ended"}, {"result", "valid exit"}, {"failures", {{"paused", 2u}, {"strayed", 1u}}}});
    add(at(begun));
    add(at(ended));
    const Journal journal = parse_journal(text);
    ASSERT_TRUE(journal.faults.empty()) << journal.faults.front().what;
    const std::vector<Participant> people = participants_of(journal);
    ASSERT_EQ(people.size(), 1u);
    ASSERT_EQ(people[0].visits.size(), 1u);
    const StageVisit& visit = people[0].visits[0];
    EXPECT_EQ(visit.run, 2u) << "its file says so";
    EXPECT_EQ(visit.held.hand, Hand::untold);
    EXPECT_EQ(failure_counts(visit).of_person, 1u);
    EXPECT_EQ(failure_counts(visit).of_operator_or_device, 2u);
    const Json figures{{"time_s", 2.0}, {kTorqueFigure, 0.1}, {kFailedFigure, 1u}, {kInterruptedFigure, 2u}};
    const Json before{{"time_s", 2.0}, {kFailedFigure, 3u}};
    EXPECT_EQ(json_text(as_kept_before(figures, before)), json_text(before));
    EXPECT_EQ(json_text(as_kept_before(figures, figures)), json_text(figures));
}

}  // namespace burin::study
