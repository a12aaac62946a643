// SPDX-License-Identifier: MIT
// A simulated participant meets the program that a person meets: what a learner's wand has read, given to the loop of a
// session as a live visit opens it, makes the same ticks, trials and figures to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "activities/train/participant_session.hpp"
#include "activities/train/simulated_stage.hpp"
#include "devices/haptic/recorded_device.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "session/drive/headless_session.hpp"
#include "session/live/session.hpp"
#include "study/felt/stage_session.hpp"
#include "study/folder/stage_recording.hpp"

namespace burin::activities {
namespace {

study::Protocol quick_study() {
    std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    study::Protocol protocol = study::parse_protocol(text).protocol;
    for (study::Stage& stage : protocol.stages)
        if (stage.ends_after_s) stage.ends_after_s = 6.0;
    return protocol;
}

// A stage as it was kept.
struct Kept {
    std::vector<haptics::TickRecord> ticks;
    EndedStage ended;
};

// The samples of the ticks, with the hand at rest for as many ticks as the session had before them.
std::shared_ptr<const devices::RecordedHand> samples_of(const std::vector<haptics::TickRecord>& ticks) {
    devices::RecordedHandPart part;
    const auto add = [&](const haptics::TickRecord& tick) {
        devices::RecordedSample sample{static_cast<Nanoseconds>(part.samples.size()) * 1'000'000, tick.sample};
        sample.sample.time_ns -= tick.time_ns;
        part.samples.push_back(sample);
    };
    for (std::uint64_t before = 1; before < ticks.front().tick; ++before) add(ticks.front());
    for (const haptics::TickRecord& tick : ticks) add(tick);
    return std::make_shared<const devices::RecordedHand>(devices::RecordedHand{"simulated-wand", {part}});
}

// The run of an operator who begins the stage with the frame with which the learner's did.
session::HeadlessRun operators_run() {
    session::HeadlessRun run{.lasts_ns = 200 * kNanosecondsPerSecond, .frames_a_second = kFramesASecond};
    run.make_frame = [frames = 0](const session::HeadlessFrame& frame) mutable {
        std::vector<session::InputEvent> inputs;
        if (frames++ == kFirstFrames) inputs.push_back({frame.time_ns, session::CommandInput{"do", {"start"}}});
        return frame.step(inputs);
    };
    return run;
}

class LearnersAgain : public testing::Test {
protected:
    void SetUp() override {
        auto worlds = felt_worlds(protocol_);
        ASSERT_TRUE(worlds);
        worlds_ = std::move(*worlds);
    }

    Kept learnt(const study::StagePlace& at, const study::Group& group) {
        study::Random random(11);
        const study::Learner learner{std::log(0.035), std::log(0.15), false, 0.0};
        const study::LearnerPopulation population;
        Kept kept;
        auto ended = simulate_stage(
            {protocol_, at, group, worlds_, learner, population}, random,
            [&](const haptics::TickRecord& tick, study::OperatorAct, const auto&) { kept.ticks.push_back(tick); });
        EXPECT_TRUE(ended) << ended.error().line();
        if (ended) kept.ended = std::move(*ended);
        return kept;
    }

    // A participant's session as a live visit opens it, whose device reads these samples.
    Kept live(const study::StagePlace& at, const study::Group& group,
              std::shared_ptr<const devices::RecordedHand> samples) {
        Kept kept;
        StageKeeper keeper;
        keeper.tick = [&](const TrainingRun::Ticked& ticked) { kept.ticks.push_back(*ticked.record); };
        keeper.ended = [&](const EndedStage& ended) {
            kept.ended = ended;
            return Result<void>{};
        };
        const devices::WandDescription wand = study::study_wand(protocol_);
        auto points = devices::points_named(wand, devices::usual_points(wand));
        EXPECT_TRUE(points);
        StudyDevice device{wand, "p01", true};
        device.hand = session::BroughtHand{.handle = wand, .points = *points, .samples = std::move(samples)};
        const auto activity = std::make_shared<StudyActivity>(protocol_, group, worlds_, std::vector{at}, "study",
                                                              std::move(device), std::move(keeper));
        session::SessionSetup setup;
        setup.hands.device = devices::kSimulatedWand;
        setup.work.journal = "none";
        SimulatedClock clock;
        clock.sleep_until(kNanosecondsPerSecond);
        auto session = session::Session::create(participant_session(setup, activity), clock);
        EXPECT_TRUE(session) << session.error().line();
        if (!session) return kept;
        const auto ran = session::run_headless(**session, clock, operators_run());
        EXPECT_TRUE(ran) << ran.error().line();
        return kept;
    }

    study::Protocol protocol_ = quick_study();
    FeltWorlds worlds_;
};

TEST_F(LearnersAgain, AreEqualToTheBitInTheSessionOfALiveVisit) {
    const record::RowShape shape{0, study::kWandPoints};
    for (const char* name : {"interactive", "led", "test"}) {
        for (const std::size_t group : {0u, 1u}) {
            const study::StagePlace at{1, 1, protocol_.stage(name)};
            const Kept first = learnt(at, protocol_.groups[group]);
            ASSERT_GT(first.ticks.size(), 1000u) << name;
            const Kept again = live(at, protocol_.groups[group], samples_of(first.ticks));
            ASSERT_EQ(again.ticks.size(), first.ticks.size()) << name << ", group " << group;
            for (std::size_t i = 0; i < first.ticks.size(); ++i)
                ASSERT_EQ(study::stage_row(again.ticks[i], shape), study::stage_row(first.ticks[i], shape))
                    << name << ", group " << group << ", tick " << i;
            EXPECT_EQ(json_text(again.ended.record), json_text(first.ended.record)) << name;
            EXPECT_EQ(again.ended.duration_s, first.ended.duration_s);
            ASSERT_EQ(again.ended.events.size(), first.ended.events.size()) << name;
            for (std::size_t i = 0; i < first.ended.events.size(); ++i)
                EXPECT_EQ(again.ended.events[i].time_s, first.ended.events[i].time_s) << name << ", event " << i;
        }
    }
}

// The samples count: a wand that reads a hair's breadth beside gives other ticks.
TEST_F(LearnersAgain, DifferWhereTheWandHasReadElse) {
    const study::StagePlace at{1, 1, protocol_.stage("test")};
    const Kept first = learnt(at, protocol_.groups[0]);
    ASSERT_FALSE(first.ended.record.is_null());
    auto beside = *samples_of(first.ticks);
    for (devices::RecordedSample& sample : beside.parts.front().samples) sample.sample.position_device_m.y += 1e-4;
    const Kept again = live(at, protocol_.groups[0], std::make_shared<const devices::RecordedHand>(std::move(beside)));
    EXPECT_NE(json_text(again.ended.record), json_text(first.ended.record));
}

}  // namespace
}  // namespace burin::activities
