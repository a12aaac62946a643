// SPDX-License-Identifier: MIT
// A participant with an operator: what each says and does takes the stages on, and what is shown follows.
#include "activities/train/training_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "activities/train/scripted_visit.hpp"
#include "study/felt/repeated_stage.hpp"

namespace burin::activities {
namespace {

constexpr Nanoseconds kMs_ns = 1'000'000;

std::string brief_protocol() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const char* seconds : {"ends_after_s = 60", "ends_after_s = 300", "ends_after_s = 120"}) {
        for (std::size_t at = text.find(seconds); at != std::string::npos; at = text.find(seconds, at + 1))
            text.replace(at, std::string(seconds).size(), "ends_after_s = 1");
    }
    return text;
}

class TrainingRuns : public testing::Test {
protected:
    void SetUp() override {
        auto worlds = felt_worlds(protocol_);
        ASSERT_TRUE(worlds);
        worlds_ = std::move(*worlds);
        run_.emplace(protocol_, protocol_.groups[0], worlds_, study::places_of(protocol_));
    }
    void say(const char* text) { run_->command(*operator_command(text), now_ns_); }
    TrainingShown frame() { return run_->frame(now_ns_); }
    // So many ticks with the wand's middle at a place of the world.
    void hold(const Vec3& middle_m, std::size_t ticks) {
        for (std::size_t i = 0; i < ticks && run_->phase() == TrainingRun::Phase::in_stage; ++i) {
            now_ns_ += kMs_ns;
            devices::DeviceSample sample;
            sample.time_ns = now_ns_;
            if (run_->session() == nullptr) continue;
            sample.position_device_m = run_->session()->touch().place_at_device(middle_m);
            run_->follow(ticked(sample));
        }
    }
    // The tick of a sample in the stage under way, with that stage's settings.
    const haptics::TickRecord& ticked(const devices::DeviceSample& sample) {
        const study::StagePlace* at = run_->place();
        if (touched_in_ != at->stage || run_->session()->ticks() == 0)
            touch_.emplace(protocol_, *at->stage, protocol_.groups[0], *run_->world());
        touched_in_ = at->stage;
        return touch_->tick(sample, now_ns_);
    }
    // A line of the panel, as of now.
    std::string row(const char* name) {
        static_cast<void>(frame());
        const std::vector<PanelRow> rows = run_->rows();
        const auto found = std::ranges::find(rows, name, &PanelRow::name);
        return found != rows.end() ? found->value : std::string();
    }
    void go_through(std::size_t ticks) {
        const auto& spine = worlds_.at("tube")->world().spine_m;
        const Vec3 before = spine.front() + 1.5 * (spine.front() - spine[1]);
        const Vec3 behind = spine.back() + 1.5 * (spine.back() - spine[spine.size() - 2]);
        hold(before, 50);
        for (std::size_t i = 0; i < ticks; ++i) {
            const double at =
                static_cast<double>(i) / static_cast<double>(ticks) * static_cast<double>(spine.size() - 1);
            const auto k = static_cast<std::size_t>(at);
            hold(spine[k] + (at - static_cast<double>(k)) * (spine[std::min(k + 1, spine.size() - 1)] - spine[k]), 1);
        }
        hold(behind, 50);
    }
    // Goes on to a stage of the list, by the operator.
    void skip_to(const char* stage) {
        while (run_->place()->stage->name != stage) {
            say("start");
            say("stop");
            hold(Vec3(0.0), 3);
            now_ns_ += kMs_ns;
            static_cast<void>(frame());
            ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended);
            static_cast<void>(run_->take_end());
        }
    }

    study::Protocol protocol_ = study::parse_protocol(brief_protocol()).protocol;
    FeltWorlds worlds_;
    std::optional<TrainingRun> run_;
    std::optional<study::RepeatedTouch> touch_;
    const study::Stage* touched_in_ = nullptr;
    Nanoseconds now_ns_ = kNanosecondsPerSecond;
};

TEST_F(TrainingRuns, WaitForTheOperatorAndShowPagesForTheirTime) {
    EXPECT_EQ(run_->phase(), TrainingRun::Phase::between);
    EXPECT_TRUE(frame().page.empty());
    say("next");  // nothing is under way
    EXPECT_EQ(run_->phase(), TrainingRun::Phase::between);
    say("start");
    EXPECT_TRUE(frame().page.contains("You may stop at any time"));
    now_ns_ += 900 * kMs_ns;
    EXPECT_EQ(row("time"), "0.9 s");
    now_ns_ += 200 * kMs_ns;
    static_cast<void>(frame());
    ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended);
    EXPECT_EQ(run_->take_end().end.result, study::StageResult::time_over);
    // A page that the operator ends.
    say("start");
    now_ns_ += 5000 * kMs_ns;
    static_cast<void>(frame());
    EXPECT_EQ(run_->phase(), TrainingRun::Phase::in_stage);
    say("note looks away");
    say("next");
    const TrainingShown shown = frame();
    EXPECT_TRUE(std::ranges::any_of(shown.events, [](const RunEvent& e) { return e.value == "looks away"; }));
    ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended);
    EXPECT_EQ(run_->take_end().end.result, study::StageResult::by_operator);
    EXPECT_STREQ(run_->place()->stage->name.c_str(), "model");
}

// A stage begins without the events of the stage before, and without what was said too often there.
TEST_F(TrainingRuns, SayOfEachStageItsOwnEventsAndLeaveNothingSaidForTheNext) {
    std::size_t pages = 0, worlds = 0;
    while (run_->place() != nullptr && (pages < 2 || worlds < 3)) {
        const std::string name = run_->place()->stage->name;
        say("start");
        static_cast<void>(run_->session() != nullptr ? ++worlds : ++pages);
        hold(Vec3(0.0), 5);
        now_ns_ += kMs_ns;
        std::vector<RunEvent> said = frame().events;
        ASSERT_EQ(run_->phase(), TrainingRun::Phase::in_stage) << name << " has just begun";
        for (int time = 0; time < 3; ++time) say("stop");  // an impatient operator
        hold(Vec3(0.0), 3);
        now_ns_ += kMs_ns;
        std::ranges::copy(frame().events, std::back_inserter(said));
        ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended) << name;
        ASSERT_EQ(said.size(), 2u) << name;
        EXPECT_EQ(said[0].name, "stage begun");
        EXPECT_EQ(said[0].value, name);
        EXPECT_EQ(said[1].name, "stage ended");
        EXPECT_EQ(said[1].value, study::name_of(study::StageResult::stopped));
        const EndedStage ended = run_->take_end();
        EXPECT_EQ(ended.end.result, study::StageResult::stopped);
        EXPECT_EQ(ended.events.size(), 1u) << name;
    }
    EXPECT_GE(pages, 2u);
    EXPECT_GE(worlds, 3u);
}

TEST_F(TrainingRuns, TakeATrialFromTheStartCapToTheEndCap) {
    skip_to("test");
    say("start");
    const auto& spine = worlds_.at("tube")->world().spine_m;
    hold(spine.front() + 1.5 * (spine.front() - spine[1]), 50);
    const TrainingShown armed = frame();
    EXPECT_EQ(row("now"), "in the start cap");
    EXPECT_EQ(row("caps"), "in the start cap");
    ASSERT_TRUE(armed.moment);
    EXPECT_TRUE(armed.moment->start_touched);
    const auto tube = std::ranges::find(armed.objects, study::kSeenTubeObject, &ShownObject::id);
    ASSERT_NE(tube, armed.objects.end());
    EXPECT_FALSE(tube->seen);
    go_through(2000);
    ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended);
    const EndedStage ended = run_->take_end();
    EXPECT_EQ(ended.end.result, study::StageResult::valid_exit);
    EXPECT_NEAR(ended.record.at("time_s").get<double>(), 2.0, 0.1);
}

// A cap counts as touched when both points of the wand are in it. One alone, whichever it is, does not count.
TEST_F(TrainingRuns, ShowACapAsTouchedWhereBothPointsAreInIt) {
    skip_to("test");
    say("start");
    const study::StudyWorld& tube = worlds_.at("tube")->world();
    hold(Vec3(0.0, 0.0, 0.3), 1);
    const std::array<Vec3, 2> first_m = frame().moment->points_m;
    const Vec3 half_m = 0.5 * (first_m[1] - first_m[0]);
    ASSERT_GT(glm::length(half_m), 0.01);
    for (const bool at_end : {false, true}) {
        const study::CapBox cap = at_end ? study::end_cap(tube) : study::start_cap(tube);
        const Vec3 middle_m = cap.centre_m + 0.5 * cap.depth_m * cap.z;
        std::set<std::pair<bool, bool>> seen;
        for (int step = -100; step <= 100; ++step) {
            hold(middle_m + 0.1 * step * half_m, 1);
            const TrainingShown shown = frame();
            ASSERT_TRUE(shown.moment);
            const auto is_in = [&](const Vec3& point_m) { return study::inside(cap, point_m, point_m).has_value(); };
            const bool one = is_in(shown.moment->points_m[0]), other = is_in(shown.moment->points_m[1]);
            seen.insert({one, other});
            EXPECT_EQ(at_end ? shown.moment->end_touched : shown.moment->start_touched, one && other) << step;
        }
        EXPECT_EQ(seen.size(), 4u) << "none, either and both, " << at_end;
    }
}

TEST_F(TrainingRuns, SayThatAStoppedTrialCountsAsEnded) {
    skip_to("test");
    say("start");
    say("stop");
    EXPECT_FALSE(run_->paused());
    hold(Vec3(0.0), 2);
    ASSERT_EQ(run_->phase(), TrainingRun::Phase::ended);
    const study::Stage& stage = *run_->place()->stage;
    EXPECT_EQ(outcome_text(stage, run_->take_end().end),
              "trial test ended by stop: counts as ended without a valid exit");
}

TEST_F(TrainingRuns, LoseAnAttemptWhenTheOperatorPausesAndUseUpNone) {
    skip_to("test");
    say("start");
    const auto& spine = worlds_.at("tube")->world().spine_m;
    hold(spine.front() + 1.5 * (spine.front() - spine[1]), 50);
    hold(spine[3], 50);
    EXPECT_EQ(row("now"), "clock runs");
    say("pause");
    hold(spine[3], 2);
    EXPECT_EQ(row("now"), "paused");
    say("go on");
    hold(spine[3], 2);
    EXPECT_EQ(row("attempt"), "1 of 5");
    go_through(2000);
    EXPECT_EQ(run_->take_end().end.result, study::StageResult::valid_exit);
}

TEST(OperatorCommands, AreKnownByTheirWords) {
    EXPECT_EQ(operator_command("go on")->says, OperatorSays::go_on);
    EXPECT_EQ(operator_command("note a pause for water")->text, "a pause for water");
    EXPECT_FALSE(operator_command("note"));
    EXPECT_FALSE(operator_command("begin"));
}

TEST(VisitScripts, NameTheLineThatIsNone) {
    const auto fails = [](const std::string& text, const char* what) {
        const auto parsed = parse_visit_script(text, "s.txt");
        ASSERT_FALSE(parsed) << text;
        EXPECT_TRUE(parsed.error().line().contains(what)) << parsed.error().line();
    };
    const std::string head = "burin-study-input 1\n";
    fails("0 start\n", "s.txt:1");
    fails(head + "0 hand 0 0 0\n1 dance\n", "s.txt:3");
    fails(head + "2 start\n1 next\n", "s.txt:3");
    fails(head + "0 hand 0 0\n", "s.txt:2");
    fails(head + "0 hand 0 0 nan\n", "s.txt:2");
    fails(head + "0 start\n", "no hand");
    const auto good =
        parse_visit_script(head + "# a remark\n0 hand 0 0.2 0\n0.5 start # now\n\n2 hand 0 0.2 0.1\n", "s");
    ASSERT_TRUE(good);
    EXPECT_EQ(good->said.size(), 1u);
    EXPECT_EQ(good->hand.size(), 2u);
    EXPECT_EQ(good->end_s, 2.0);
}

}  // namespace
}  // namespace burin::activities
