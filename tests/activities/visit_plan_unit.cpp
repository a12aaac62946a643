// SPDX-License-Identifier: MIT
// Who may go on in a study, with which stages and when: journals whose times are written by hand.
#include <gtest/gtest.h>

#include <deque>
#include <filesystem>
#include <string>

#include "activities/train/scripted_visit.hpp"
#include "activities/train/simulated_study.hpp"
#include "activities/train/stage_on_disk.hpp"
#include "base/text.hpp"
#include "study/felt/repeated_stage.hpp"
#include "study/folder/interruption.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMinute_ns = 60 * kNanosecondsPerSecond, kHour_ns = 60 * kMinute_ns;

constexpr const char* kTwoDays = R"(format = 1
name = "two-days"
consent = "2026-11"
[limits]
resume_within_min = 10
[[stratum]]
name = "hand"
codes = ["l", "r"]
[[group]]
code = "touch"
feels_tube = true
[[group]]
code = "sight"
sees_tube = true
[[world]]
name = "tube"
tube_radius_m = 0.045
cap_half_width_m = 0.068
spine_m = [[-0.12, 0.19, 0.0], [-0.06, 0.21, 0.0], [0.0, 0.22, 0.0], [0.06, 0.21, 0.0], [0.12, 0.19, 0.0]]
[[stage]]
name = "hello"
kind = "page"
ends_after_s = 1
[[stage]]
name = "test"
kind = "trial"
world = "tube"
ends_at_exit = true
outcome = true
[[day]]
stages = ["hello", "test"]
[[day]]
least_delay_h = 20
most_delay_h = 48
stages = ["hello", "test", "hello"]
)";

class VisitPlans : public testing::Test {
protected:
    void SetUp() override {
        const study::StudyMaking making{.seed = 3, .participants = 8, .key = {}};
        ASSERT_TRUE(study::create_study(place_ / "s", kTwoDays, making));
        begin_ns_ = study::now_utc_ns() + kHour_ns;
    }

    // Appends what happened so long after the first hour.
    void write(double after_h, Json value) {
        const fs::path file = place_ / "s/journal.jsonl";
        const study::Journal journal = study::parse_journal(place_.read("s/journal.jsonl"));
        value["time"] = study::utc_text(at(after_h));
        place_.write("s/journal.jsonl",
                     place_.read("s/journal.jsonl") + study::journal_line(journal.last_digest, value));
    }
    [[nodiscard]] std::int64_t at(double after_h) const {
        return begin_ns_ + static_cast<std::int64_t>(after_h * static_cast<double>(kHour_ns));
    }
    void enrol(const std::string& id, bool simulated = false) {
        auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::write);
        ASSERT_TRUE(study && study->enrol(id, {"l"}, simulated));
    }
    void stage(const std::string& event, double after_h, const std::string& id, std::size_t day, std::size_t place) {
        write(after_h, Json{{"event", "stage " + event},
                            {"participant", id},
                            {"day", day},
                            {"place", place},
                            {"stage", place == 2 ? "test" : "hello"},
                            {"result", "time over"}});
    }
    void go_through(double after_h, const std::string& id, std::size_t day, std::size_t place) {
        stage("begun", after_h, id, day, place);
        stage("ended", after_h, id, day, place);
    }
    [[nodiscard]] Result<VisitPlan> plan(const std::string& id, double now_h, const VisitLeave& leave = {}) {
        auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::read);
        if (!study) return std::unexpected(study.error());
        read_.push_back(std::move(*study));
        return plan_visit(read_.back(), id, leave, at(now_h));
    }

    Workplace place_;
    std::deque<study::StudyFolder> read_;  // whose stages the plans name
    std::int64_t begin_ns_ = 0;
};

std::string places_text(const Result<VisitPlan>& plan) {
    if (!plan) return plan.error().line();
    std::string text;
    for (const study::StagePlace& p : plan->places)
        text += formatted("%zu.%zu %s ", p.day, p.place, p.stage->name.c_str());
    return text;
}

TEST_F(VisitPlans, OfferTheStagesThatAreLeftOfOneDayAndNotTheNextDays) {
    enrol("p01");
    EXPECT_EQ(places_text(plan("p01", 0.0)), "1.1 hello 1.2 test ");
    go_through(0.0, "p01", 1, 1);
    EXPECT_EQ(places_text(plan("p01", 0.1)), "1.2 test ");
    go_through(0.1, "p01", 1, 2);
    EXPECT_EQ(places_text(plan("p01", 24.0)), "2.1 hello 2.2 test 2.3 hello ");
    go_through(24.0, "p01", 2, 1);
    EXPECT_EQ(places_text(plan("p01", 24.1)), "2.2 test 2.3 hello ");
    go_through(24.1, "p01", 2, 2);
    go_through(24.1, "p01", 2, 3);
    EXPECT_TRUE(places_text(plan("p01", 24.2)).contains("has gone through all stages"));
}

TEST_F(VisitPlans, GiveNobodyAVisitWhoHasWithdrawnOrIsSimulatedOrUnknown) {
    enrol("p01");
    enrol("sim02", true);
    write(0.0, Json{{"event", "withdrawn"}, {"participant", "p01"}, {"erase", false}});
    const VisitLeave all{true, true};
    EXPECT_TRUE(places_text(plan("p01", 0.1, all)).contains("p01: has withdrawn"));
    EXPECT_TRUE(places_text(plan("sim02", 0.1, all)).contains("is a simulated learner"));
    EXPECT_TRUE(places_text(plan("p09", 0.1, all)).contains("is not in this study"));
}

TEST_F(VisitPlans, LetADayBeginWithinItsBoundsAndAtThem) {
    const study::Protocol protocol = study::parse_protocol(kTwoDays).protocol;
    using study::DayVerdict, study::day_verdict;
    for (const double hours : {-1e9, 0.0, 1e9}) EXPECT_EQ(day_verdict(protocol, 1, hours), DayVerdict::in_time);
    EXPECT_EQ(day_verdict(protocol, 2, 19.99), DayVerdict::too_early);
    for (const double hours : {20.0, 30.0, 48.0}) EXPECT_EQ(day_verdict(protocol, 2, hours), DayVerdict::in_time);
    EXPECT_EQ(day_verdict(protocol, 2, 48.01), DayVerdict::too_late);
    EXPECT_EQ(day_verdict(protocol, 2, -1.0), DayVerdict::too_early) << "the clock went back";
}

TEST_F(VisitPlans, CountADaysDelayFromTheLastStageOfTheDayBefore) {
    enrol("p01");
    go_through(0.0, "p01", 1, 1);
    go_through(5.0, "p01", 1, 2);
    EXPECT_TRUE(places_text(plan("p01", 24.9)).contains("19.9 h after the day before, too early by the protocol"));
    EXPECT_EQ(places_text(plan("p01", 25.1)), "2.1 hello 2.2 test 2.3 hello ");
    EXPECT_EQ(places_text(plan("p01", 52.9)), "2.1 hello 2.2 test 2.3 hello ");
    const std::string late = places_text(plan("p01", 53.2));
    EXPECT_TRUE(late.contains("48.2 h after the day before, too late by the protocol (20 to 48 h)")) << late;
    EXPECT_TRUE(late.contains("--any-delay")) << late;
    // A day that has begun in time may end later, and an interruption within it has a time of its own.
    stage("begun", 52.9, "p01", 2, 1);
    EXPECT_EQ(places_text(plan("p01", 53.04)), "2.1 hello 2.2 test 2.3 hello ");
}

TEST_F(VisitPlans, NameADayThatIsBegunOutOfTimeAsADeviation) {
    enrol("p01");
    go_through(0.0, "p01", 1, 1);
    go_through(0.0, "p01", 1, 2);
    const VisitLeave of_interruption{.resumes_late = true, .any_delay = false};
    EXPECT_FALSE(plan("p01", 50.0, of_interruption)) << "leave for one is none for the other";
    const VisitLeave of_delay{.resumes_late = false, .any_delay = true};
    const auto in_time = plan("p01", 24.0, of_delay);
    ASSERT_TRUE(in_time);
    EXPECT_TRUE(in_time->deviations.empty());
    const auto late = plan("p01", 50.0, of_delay);
    ASSERT_TRUE(late);
    ASSERT_EQ(late->deviations.size(), 1u);
    EXPECT_EQ(late->deviations[0],
              "day 2 was begun 50.0 h after the day before, too late by the protocol (20 to 48 h)");
}

TEST_F(VisitPlans, KeepTheTimeWithinWhichAnInterruptedStageIsTakenUp) {
    enrol("p01");
    go_through(0.0, "p01", 1, 1);
    stage("begun", 1.0, "p01", 1, 2);
    const double in_time = 1.0 + 9.9 / 60.0, late = 1.0 + 20.0 / 60.0;
    EXPECT_EQ(places_text(plan("p01", in_time)), "1.2 test ");
    const std::string refused = places_text(plan("p01", late));
    EXPECT_TRUE(refused.contains("p01, test: was interrupted 20 min ago")) << refused;
    EXPECT_TRUE(refused.contains("--resume")) << refused;
    EXPECT_FALSE(plan("p01", late, {.resumes_late = false, .any_delay = true}));
    const VisitLeave leave{.resumes_late = true, .any_delay = false};
    const auto in_time_with_leave = plan("p01", in_time, leave);
    ASSERT_TRUE(in_time_with_leave);
    EXPECT_TRUE(in_time_with_leave->deviations.empty());
    const auto resumed = plan("p01", late, leave);
    ASSERT_TRUE(resumed);
    ASSERT_EQ(resumed->deviations.size(), 1u);
    EXPECT_EQ(resumed->deviations[0],
              "test (day 1, stage 2) was begun anew 20 min after its interruption, and the "
              "protocol allows 10 min");
    // Begun anew and interrupted again: the last one counts.
    stage("begun", late, "p01", 1, 2);
    EXPECT_EQ(places_text(plan("p01", late + 0.1)), "1.2 test ");
    EXPECT_FALSE(plan("p01", late + 0.2));
}

TEST_F(VisitPlans, ForgetAnInterruptionThatWasMadeGood) {
    enrol("p01");
    stage("begun", 0.0, "p01", 1, 1);
    go_through(0.1, "p01", 1, 1);
    EXPECT_EQ(places_text(plan("p01", 9.0)), "1.2 test ");
}

TEST_F(VisitPlans, KnowAStageForAsLongAsItsRecordingWentOn) {
    enrol("p01");
    go_through(-2.0, "p01", 1, 1);
    const study::Protocol protocol = study::parse_protocol(kTwoDays).protocol;
    const auto world = study::FeltWorld::create(protocol.worlds[0]);
    ASSERT_TRUE(world);
    study::RepeatedStage stage(protocol, *protocol.stage("test"), protocol.groups[0], **world);
    const study::StageSession& session = stage.session();
    fs::create_directories(place_ / "s/data/p01");
    auto recording =
        study::StageRecording::create(place_ / "s/data/p01/r.session", session.touch(), {}, kNanosecondsPerSecond);
    ASSERT_TRUE(recording);
    for (Nanoseconds t = 1; t < 100; ++t)
        (*recording)->take(stage.take({}, t * 1'000'000), study::OperatorAct::none, session);
    ASSERT_TRUE((*recording)->close());
    // The first hour is an hour from now, so that the recording ends an hour before it.
    write(-1.5, Json{{"event", "stage begun"},
                     {"participant", "p01"},
                     {"day", 1},
                     {"place", 2},
                     {"stage", "test"},
                     {"recording", "data/p01/r.session"}});
    EXPECT_EQ(places_text(plan("p01", -1.0 + 5.0 / 60.0)), "1.2 test ");
    EXPECT_FALSE(plan("p01", -1.0 + 12.0 / 60.0));
}

TEST_F(VisitPlans, AskAboutNobodyButWhoIsRun) {
    enrol("p01");
    enrol("p02");
    enrol("sim03", true);
    stage("begun", -5.0, "p01", 1, 1);
    EXPECT_FALSE(plan("p01", 0.0));
    EXPECT_EQ(places_text(plan("p02", 0.0)), "1.1 hello 1.2 test ");
    auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::write);
    ASSERT_TRUE(study);
    EXPECT_TRUE(run_simulated(*study, {.threads = 1, .records = false, .tell = {}}));
}

TEST_F(VisitPlans, AskAboutEachLearnerAndNameWhatIsResumedLate) {
    enrol("sim01", true);
    stage("begun", -5.0, "sim01", 1, 1);
    auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::write);
    ASSERT_TRUE(study);
    const auto refused = run_simulated(*study, {.threads = 1, .records = false, .tell = {}});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("sim01, hello: was interrupted")) << refused.error().line();
    ASSERT_TRUE(run_simulated(*study, {.threads = 1, .records = false, .resumes_late = true, .tell = {}}));
    const auto people = study->participants();
    ASSERT_EQ(people.at(0).deviations.size(), 1u);
    EXPECT_TRUE(people[0].deviations[0].text.contains("begun anew 240 min")) << people[0].deviations[0].text;
    EXPECT_TRUE(people.at(1).deviations.empty());
}

TEST_F(VisitPlans, WriteWhatIsNotKeptToTheJournalWhenTheVisitBegins) {
    enrol("p01");
    stage("begun", -5.0, "p01", 1, 1);
    const auto script = parse_visit_script("burin-study-input 1\n0 hand 0 0.2 0.1\n0.1 start\n1.5 note here\n", "v");
    ASSERT_TRUE(script);
    auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::write);
    ASSERT_TRUE(study);
    EXPECT_FALSE(run_scripted_visit(*study, "p01", *script, {.leave = {false, true}, .on_frame = {}, .tell = {}}));
    EXPECT_FALSE(study->participants()[0].held) << "a visit that is refused has not begun";
    ASSERT_TRUE(run_scripted_visit(*study, "p01", *script, {.leave = {true, false}, .on_frame = {}, .tell = {}}));
    const study::Participant person = study->participants()[0];
    ASSERT_EQ(person.deviations.size(), 1u);
    EXPECT_TRUE(person.deviations[0].text.starts_with("hello (day 1, stage 1) was begun anew"));
    EXPECT_FALSE(person.deviations[0].utc.empty());
}

TEST_F(VisitPlans, TakeTheNextPlaceOfEachStratumsOwnList) {
    auto study = study::StudyFolder::open(place_ / "s", study::StudyAccess::write);
    ASSERT_TRUE(study);
    std::size_t left = 0, right = 0;
    const std::string turns = "lrrlrlllrr";
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const std::string code(1, turns[i]);
        const auto enrolled = study->enrol(formatted("p%02zu", i), {code}, false);
        ASSERT_TRUE(enrolled);
        EXPECT_EQ(enrolled->stratum, code);
        EXPECT_EQ(enrolled->position, code == "l" ? ++left : ++right) << i;
    }
    EXPECT_TRUE(study->check_allocation());
    EXPECT_EQ(study->participants().back().position, 5u);
}

}  // namespace
}  // namespace burin::activities
