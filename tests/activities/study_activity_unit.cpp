// SPDX-License-Identifier: MIT
// A study's stages as the activity of a live session, fed with ticks by hand.
#include "activities/train/study_activity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/text.hpp"
#include "picture/picture.hpp"
#include "record/record_reader.hpp"
#include "study/folder/stage_recording.hpp"
#include "study/replay/stage_replay.hpp"
#include "tests/activities/one_hand.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;

class StudyActivities : public testing::Test {
protected:
    void SetUp() override {
        std::ifstream in("assets/studies/kinesthetic-path/protocol.toml");
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        protocol_ = study::parse_protocol(text).protocol;
        auto worlds = felt_worlds(protocol_);
        ASSERT_TRUE(worlds);
        worlds_ = std::move(*worlds);
    }
    // The stages of that name, for a group.
    void begin(const char* stage, std::size_t group) {
        std::vector<study::StagePlace> places;
        for (const study::StagePlace& at : study::places_of(protocol_))
            if (at.stage->name == stage) places.push_back(at);
        begin(std::move(places), group);
    }
    void begin(std::vector<study::StagePlace> places, std::size_t group) {
        const auto ok = [] { return Result<void>{}; };
        StageKeeper keeper{[&, ok](const TrainingRun&) { return ++begun_, ok(); },
                           [&](const TrainingRun::Ticked& ticked) { kept_.push_back(*ticked.record); },
                           [&, ok](const std::vector<RunEvent>& events) {
                               events_.insert(events_.end(), events.begin(), events.end());
                               return ok();
                           },
                           [&](const EndedStage& ended) {
                               ended_.push_back(ended);
                               return Result<void>(fail("disk", "is full"));
                           },
                           {}};
        activity_.emplace(protocol_, protocol_.groups[group], worlds_, std::move(places), "study",
                          StudyDevice{study::study_wand(protocol_), "p07"}, std::move(keeper));
    }
    Result<void> act(std::vector<std::string> words) {
        orders_ = {};
        return activity_->act(words, orders_);
    }
    // A frame with ticks in which the wand's middle is at these places.
    void frame(const std::vector<Vec3>& middles_m) {
        std::vector<haptics::TickRecord> ticks;
        for (const Vec3& middle : middles_m) ticks.push_back(tick_at(middle));
        frame_of(ticks);
    }
    // A session's tick: its device is mapped in another way than the study's own.
    haptics::TickRecord tick_at(const Vec3& middle_m) {
        haptics::TickRecord tick = tick_;
        tick.tick = ++number_;
        tick.time_ns = static_cast<Nanoseconds>(1000 + number_) * 1'000'000;
        tick.sample.time_ns = tick.time_ns - 200'000;
        tick.contact.point_count = 2;
        const study::StudyWorld& world = worlds_.at("tube")->world();
        for (std::size_t i = 0; i < 2; ++i) {
            haptics::PointRecord& point = tick.contact.points[i];
            point.hip_object_m = middle_m + Vec3(0.0, i == 0 ? 0.03 : -0.03, 0.0);
            if (study::nearest_on(world.spine_m, point.hip_object_m).distance_m < world.tube_radius_m) continue;
            point.object = study::kTubeObject;
            point.active_triangle = 7;
        }
        return tick;
    }
    void frame_of(const std::vector<haptics::TickRecord>& ticks) {
        orders_ = {};
        hand_.step(*activity_, ticks, orders_, nullptr, tool_);
    }
    [[nodiscard]] const session::EditObject* edit(const char* object, ObjectProperty property) const {
        const auto found = std::ranges::find_if(orders_.edits, [&](const session::EditObject& one) {
            return one.object == object && one.property == property;
        });
        return found != orders_.edits.end() ? &*found : nullptr;
    }

    study::Protocol protocol_;
    FeltWorlds worlds_;
    std::optional<StudyActivity> activity_;
    session::ActivityOrders orders_;
    haptics::ToolState tool_;
    OneHand hand_;
    std::vector<EndedStage> ended_;
    std::vector<RunEvent> events_;
    std::size_t begun_ = 0;
    std::vector<haptics::TickRecord> kept_;
    haptics::TickRecord tick_;  // what is the same in each tick
    std::uint64_t number_ = 0;
};

TEST_F(StudyActivities, TakeATrialThroughAndSayWhereItWasNotKept) {
    begin("test", 1);
    const auto& spine = worlds_.at("tube")->world().spine_m;
    EXPECT_FALSE(act({"next"}));
    frame({spine.front()});
    for (const char* object : {"seen tube", "start funnel", "end cap"}) {
        ASSERT_NE(edit(object, ObjectProperty::seen), nullptr) << object;
        EXPECT_EQ(edit(object, ObjectProperty::seen)->value[0], 0.0) << object;
    }
    ASSERT_NE(edit("tube", ObjectProperty::stiffness), nullptr) << "nobody feels it between stages";
    EXPECT_LT(edit("tube", ObjectProperty::stiffness)->value[0], 1e-3);
    ASSERT_TRUE(act({"start"}));
    EXPECT_FALSE(act({"start"}));
    EXPECT_EQ(begun_, 1u);
    frame(std::vector<Vec3>(50, spine.front() + 1.5 * (spine.front() - spine[1])));
    ASSERT_NE(edit("start cap", ObjectProperty::colour), nullptr);
    EXPECT_GT(edit("start cap", ObjectProperty::colour)->value[1], 0.6);  // green
    EXPECT_EQ(edit("seen tube", ObjectProperty::seen), nullptr);          // it stays hidden
    EXPECT_EQ(edit("start cap", ObjectProperty::seen)->value[0], 1.0);
    EXPECT_EQ(edit("tube", ObjectProperty::stiffness), nullptr) << "nor in a trial";
    ASSERT_TRUE(act({"note", "holds", "her", "breath"}));
    for (std::size_t i = 0; i + 1 < spine.size(); ++i) {
        std::vector<Vec3> places;
        for (int k = 0; k < 40; ++k) places.push_back(spine[i] + (k / 40.0) * (spine[i + 1] - spine[i]));
        frame(places);
    }
    EXPECT_TRUE(orders_.edits.empty());  // nothing looks other than in the frame before
    frame(std::vector<Vec3>(20, spine.back() + 1.5 * (spine.back() - spine[spine.size() - 2])));
    ASSERT_EQ(ended_.size(), 1u);
    EXPECT_EQ(ended_[0].end.result, study::StageResult::valid_exit);
    EXPECT_NEAR(ended_[0].record.at("time_s").get<double>(), 1.92, 0.1);
    ASSERT_FALSE(orders_.messages.empty());
    EXPECT_TRUE(orders_.messages[0].contains("NOT KEPT")) << orders_.messages[0];
    EXPECT_FALSE(orders_.quit);  // the second trial is still to come
    EXPECT_TRUE(std::ranges::any_of(events_, [](const RunEvent& e) { return e.value == "holds her breath"; }));
    ASSERT_TRUE(act({"start"}));
    ASSERT_TRUE(act({"stop"}));
    frame(std::vector<Vec3>(2, spine.front()));
    EXPECT_TRUE(orders_.quit);
}

TEST_F(StudyActivities, EndTheVisitWithStopThoughStagesAreLeft) {
    const auto& spine = worlds_.at("tube")->world().spine_m;
    for (const std::size_t stopped : {0u, 3u}) {  // a page; training
        const auto all = study::places_of(protocol_);
        begin({all.begin() + static_cast<std::ptrdiff_t>(stopped), all.end()}, 0);
        ended_.clear();
        frame({spine.front()});
        ASSERT_TRUE(act({"start"}));
        frame({spine.front(), spine.front()});
        EXPECT_FALSE(orders_.quit);
        ASSERT_TRUE(act({"stop"}));
        frame({spine.front(), spine.front()});
        EXPECT_TRUE(orders_.quit) << all[stopped].stage->name;
        ASSERT_EQ(ended_.size(), 1u);
        EXPECT_EQ(ended_[0].end.result, study::StageResult::stopped);
        EXPECT_EQ(activity_->run().phase(), TrainingRun::Phase::between) << "the others are not begun";
    }
}

TEST_F(StudyActivities, TellOfTrainingWithoutForceThatItWasNotAsTheProtocolHasIt) {
    const auto& spine = worlds_.at("tube")->world().spine_m;
    for (const char* name : {"interactive", "led", "test"}) {
        const study::Stage* stage = protocol_.stage(name);
        const study::StagePlace at{1, 4, stage};
        for (const bool without : {false, true}) {
            begin({at}, 0);
            ended_.clear();
            frame({spine.front()});
            ASSERT_TRUE(act({"start"}));
            frame(std::vector<Vec3>(20, spine.front()));
            tick_.gate.cause = without ? haptics::GateCause::device_fault : haptics::GateCause::none;
            frame(std::vector<Vec3>(30, spine.front()));
            tick_.gate.cause = haptics::GateCause::none;
            // Its time is over, or it is no training.
            if (stage->ends_after_s) number_ += static_cast<std::uint64_t>(*stage->ends_after_s * 1000.0);
            if (!stage->ends_after_s) {
                ASSERT_TRUE(act({"stop"}));
            }
            frame({spine.front(), spine.front()});
            ASSERT_EQ(ended_.size(), 1u) << name;
            const auto told = deviation_of(at, ended_[0]);
            const bool training = stage->kind != study::StageKind::trial;
            ASSERT_EQ(told.has_value(), without || !training) << name;
            if (training && told) {
                EXPECT_EQ(*told, std::string(name) +
                                     " (day 1, stage 4) had 30 of its 51 ticks without force (the "
                                     "last: no force: the device reports a fault)");
            }
            if (!training) {
                EXPECT_TRUE(told->contains("was ended by stop after")) << *told;
            }
        }
    }
}

TEST_F(StudyActivities, GiveTheOperatorCodeTimeLeftANoteAndAStopThatAsks) {
    const auto& spine = worlds_.at("tube")->world().spine_m;
    begin("interactive", 0);
    frame({spine.front()});
    ASSERT_TRUE(act({"start"}));
    frame(std::vector<Vec3>(2001, spine.front()));
    const session::ActivityPanel panel = activity_->panel();
    EXPECT_EQ(panel.aside, "p07, haptic");
    const auto fields = panel.all<session::ActivityPanel::Field>();
    ASSERT_EQ(fields.size(), 1u);
    EXPECT_EQ(fields[0].act, std::vector<std::string>{"note"});
    EXPECT_TRUE(panel.governs);
    const double whole_s = *protocol_.stage("interactive")->ends_after_s;
    const auto rows = panel.rows();
    const auto left = std::ranges::find(rows, "left", &session::ActivityPanel::Row::name);
    ASSERT_NE(left, rows.end());
    EXPECT_EQ(left->value, formatted("%.0f s of %.0f", whole_s - 2.0, whole_s));
    for (const session::ActivityPanel::Button& button : panel.buttons())
        EXPECT_EQ(button.asks.empty(), button.title != "Stop") << button.title;
    ASSERT_TRUE(act({"pause"}));
    frame(std::vector<Vec3>(3001, spine.front()));
    const auto paused = activity_->panel().rows();
    EXPECT_EQ(std::ranges::find(paused, "left", &session::ActivityPanel::Row::name)->value, left->value)
        << "a pause takes nothing of it";
    ASSERT_TRUE(act({"note", "holds her breath"}));
}

TEST_F(StudyActivities, KeepATickAsItWasAndCountWhatItSays) {
    const auto& spine = worlds_.at("tube")->world().spine_m;
    begin("interactive", 0);
    frame({spine.front()});
    ASSERT_TRUE(act({"start"}));
    std::vector<haptics::TickRecord> ticks;
    for (int i = 0; i < 50; ++i) {
        tick_.gate.given = {Vec3(0.1 * i, 0.2, -0.3), Vec3(0.01 * i, 0.0, 0.002)};
        tick_.wanted = {Vec3(0.5 * i, 0.2, -0.3), Vec3(0.0)};
        tick_.gate.cause = i == 7 ? haptics::GateCause::stale_surface : haptics::GateCause::none;
        tick_.gate.saturated = i > 40;
        tick_.flags = (i > 20 ? haptics::kTickInContact : 0u) | (i == 3 ? haptics::kTickLate : 0u);
        tick_.sample.fault = i == 9 ? devices::DeviceFault::other : devices::DeviceFault::none;
        tick_.sample.buttons = static_cast<std::uint32_t>(i % 3);
        tick_.lateness_ns = 100 * i;
        tick_.surface_sequence = 5;
        ticks.push_back(tick_at(spine.front() + Vec3(0.001 * i, 0.02, 0.0)));
    }
    frame_of(ticks);
    ASSERT_EQ(kept_.size(), ticks.size());
    const record::RowShape shape{0, 2};
    for (std::size_t i = 0; i < ticks.size(); ++i)
        ASSERT_EQ(study::stage_row(kept_[i], shape), study::stage_row(ticks[i], shape)) << i;
    const study::FeltForces& forces = activity_->run().session()->forces();
    EXPECT_EQ(forces.ticks, 50u);
    EXPECT_NEAR(forces.contact_s, 0.0285, 1e-12) << "28 intervals, and half of the one before";
    EXPECT_EQ(forces.contacts, 1u);
    EXPECT_EQ(forces.limited_ticks, 9u);
    EXPECT_EQ(forces.late_ticks, 1u);
    EXPECT_EQ(forces.faults, 1u);
    EXPECT_EQ(forces.cause, haptics::GateCause::stale_surface);
    EXPECT_EQ(forces.largest_torque_Nm, glm::length(Vec3(0.49, 0.0, 0.002)));
}

// What a live stage measured follows from its own file, whatever mapping and surfaces its session had.
TEST_F(StudyActivities, GiveTheSameStageAndFiguresAgainFromTheTicksAsStored) {
    const Workplace place;
    const study::FeltWorld& world = *worlds_.at("tube");
    const auto& spine = world.world().spine_m;
    for (const char* name : {"interactive", "test"}) {
        const study::Stage& stage = *protocol_.stage(name);
        const study::Group& group = protocol_.groups[0];
        study::StageSession session(protocol_, stage, group, world);
        auto facts = study::facts_of_stage("digest", group, stage, world, session.touch());
        facts.emplace_back(study::kTicksFact, study::kTicksOfSession);
        const std::filesystem::path file = place / (std::string(name) + ".session");
        auto recording = study::StageRecording::create(file, session.touch(), std::move(facts), kNanosecondsPerSecond);
        ASSERT_TRUE(recording);
        tick_.motion.object_from_device = {Vec3(0.3, -0.2, 0.1), glm::angleAxis(0.3, Vec3(0.0, 1.0, 0.0)), 1.5};
        for (std::size_t i = 0; !session.done() && i < 12'000; ++i) {
            const double at =
                std::clamp(static_cast<double>(i) / 60.0 - 3.0, -1.5, static_cast<double>(spine.size()) + 0.5);
            const auto k = std::min(static_cast<std::size_t>(std::max(at, 0.0)), spine.size() - 2);
            tick_.gate.given = {Vec3(0.1, std::sin(0.01 * static_cast<double>(i)), 0.0), Vec3(0.0, 0.0, 0.02)};
            tick_.gate.cause = i % 700 == 5 ? haptics::GateCause::stale_surface : haptics::GateCause::none;
            tick_.flags = i % 90 > 60 ? haptics::kTickInContact : 0u;
            const haptics::TickRecord tick =
                tick_at(spine[k] + (at - static_cast<double>(k)) * (spine[k + 1] - spine[k]));
            const study::OperatorAct act = i == 9'000 ? study::OperatorAct::stop : study::OperatorAct::none;
            session.follow(tick, act);
            (*recording)->take(tick, act, session);
        }
        ASSERT_TRUE(session.done());
        ASSERT_TRUE((*recording)->close());
        const auto replay = study::replay_stage(file, protocol_, "digest", world);
        ASSERT_TRUE(replay) << replay.error().line();
        EXPECT_TRUE(replay->of_session);
        EXPECT_EQ(replay->end.result, session.state().result);
        EXPECT_EQ(replay->end.clock_stopped_s, session.state().clock_stopped_s);
        const Json measured = ended_stage(protocol_, stage, world, session).record;
        EXPECT_FALSE(measured.is_null());
        EXPECT_EQ(json_text(replay->record), json_text(measured)) << name;
        auto reader = record::RecordReader::open(file.string());
        ASSERT_TRUE(reader);
        const auto trials = reader->trials();
        ASSERT_TRUE(trials);
        ASSERT_EQ(trials->size(), stage.kind == study::StageKind::trial ? 1u : 0u);
        if (trials->empty()) continue;
        EXPECT_EQ(trials->front().name, "test");
        EXPECT_EQ(trials->front().state, "done");
        EXPECT_EQ(trials->front().begun_ns, session.begun_ns() + nanoseconds(session.state().clock_started_s));
    }
}

TEST_F(StudyActivities, GoThroughTheWorldsOfADayOneAfterTheOther) {
    study::StudyWorld second = protocol_.worlds.front();
    second.name = "curve";
    second.wall_N_per_m = 350.0;
    for (Vec3& p : second.spine_m) p.y += 0.02;
    protocol_.worlds.push_back(second);
    study::Stage in_second = *protocol_.stage("interactive");
    in_second.name = "transfer";
    in_second.world = "curve";
    protocol_.stages.push_back(in_second);
    worlds_ = felt_worlds(protocol_).value();
    begin({{1, 1, protocol_.stage("interactive")}, {1, 2, protocol_.stage("transfer")}}, 0);
    const scene::World& scene = *activity_->scene();
    ASSERT_EQ(scene.objects.size(), 2 * worlds_.at("tube")->objects().size());
    const auto object = [&](const std::string& name) {
        return *std::ranges::find(scene.objects, name, &scene::SceneObject::name);
    };
    EXPECT_TRUE(object("tube").felt);
    EXPECT_FALSE(object("curve: tube").felt) << "it would press on the hand in the other's stage";
    EXPECT_FALSE(object("curve: end cap").seen);
    EXPECT_EQ(object("curve: tube").material.stiffness_N_per_m, 350.0);

    frame({second.spine_m.front()});
    ASSERT_TRUE(act({"start"}));
    EXPECT_TRUE(orders_.edits.empty()) << "its world is there already";
    frame(std::vector<Vec3>(20, second.spine_m.front()));
    number_ += static_cast<std::uint64_t>(*in_second.ends_after_s * 1000.0);
    frame({second.spine_m.front(), second.spine_m.front()});
    ASSERT_EQ(ended_.size(), 1u);

    ASSERT_TRUE(act({"start"}));
    ASSERT_NE(edit("curve: tube", ObjectProperty::felt), nullptr);
    EXPECT_EQ(edit("curve: tube", ObjectProperty::felt)->value[0], 1.0);
    EXPECT_EQ(edit("tube", ObjectProperty::felt)->value[0], 0.0);
    EXPECT_EQ(edit("start funnel", ObjectProperty::felt)->value[0], 0.0);
    for (const char* name : {"tube", "start funnel", "start cap", "seen tube"}) {
        ASSERT_NE(edit(name, ObjectProperty::seen), nullptr) << name;
        EXPECT_EQ(edit(name, ObjectProperty::seen)->value[0], 0.0) << name;
    }
    haptics::TickRecord tick = tick_at(second.spine_m.front());
    tick.contact.points[0].object = static_cast<std::uint32_t>(object("curve: end funnel").id);
    tick.contact.points[1].object = static_cast<std::uint32_t>(object("tube").id);
    frame_of({tick});
    ASSERT_NE(edit("curve: tube", ObjectProperty::stiffness), nullptr);
    EXPECT_EQ(edit("curve: tube", ObjectProperty::stiffness)->value[0], 350.0);
    EXPECT_EQ(kept_.back().contact.points[0].object, study::kEndFunnelObject) << "as a recording of that world has it";
    EXPECT_EQ(kept_.back().contact.points[1].object, 0u) << "an object of another world";
}

// On a busy machine frames, and the words of a script, come before the first tick.
TEST_F(StudyActivities, BeginAStageThatIsStartedBeforeTheFirstTickWithThat) {
    begin("test", 1);
    const auto& spine = worlds_.at("tube")->world().spine_m;
    ASSERT_TRUE(act({"start"}));
    ASSERT_TRUE(act({"start"})) << "said again, since nothing seems to happen";
    EXPECT_EQ(begun_, 0u);
    frame({spine.front() + Vec3(-0.1, 0.0, 0.0)});
    EXPECT_EQ(begun_, 1u);
    EXPECT_TRUE(activity_->is_running());
    EXPECT_EQ(kept_.size(), 1u) << "the tick belongs to the stage";
    EXPECT_FALSE(act({"start"})) << "it runs";
}

TEST_F(StudyActivities, SetTheProxiesOnTheAxisAtEachTouchOfTheStartCap) {
    begin("test", 0);
    const auto& spine = worlds_.at("tube")->world().spine_m;
    const Vec3 in_start_cap = spine.front() + 1.5 * (spine.front() - spine[1]);
    const auto placement = [&] {
        haptics::TickParameters parameters;
        activity_->adjust({}, parameters);
        return parameters.placement;
    };
    frame({in_start_cap});
    ASSERT_TRUE(act({"start"}));
    frame({in_start_cap + Vec3(-0.1, 0.0, 0.0)});
    EXPECT_EQ(placement().number, 0u);
    frame({in_start_cap, in_start_cap});
    EXPECT_TRUE(orders_.parameters);
    EXPECT_EQ(placement().number, 1u);
    EXPECT_EQ(placement().position_object_m, spine.front());
    frame({in_start_cap, spine[1]});
    EXPECT_FALSE(orders_.parameters);
    EXPECT_EQ(placement().number, 1u) << "a placement acts once";
    ASSERT_TRUE(act({"repeat"}));
    frame({spine[1]});
    frame({in_start_cap});
    EXPECT_EQ(placement().number, 2u);
}

TEST_F(StudyActivities, HoldTheStageWhereTheWandReadsFartherOffInItsJigThanTheProtocolAllows) {
    const devices::WandDescription wand = study::study_wand(protocol_);
    const Vec3 in_the_jig = devices::jig_pose_device(wand).position_m;
    const auto& spine = worlds_.at("tube")->world().spine_m;
    begin("test", 0);
    tool_.position_device_m = in_the_jig + Vec3(0.0015, 0.0, 0.0);
    frame({spine.front()});
    ASSERT_TRUE(act({"jig"})) << "2 mm are allowed";
    EXPECT_TRUE(orders_.messages.at(0).contains("1.5 mm")) << orders_.messages.at(0);
    ASSERT_TRUE(act({"start"}));
    tool_.position_device_m.x += 0.001;
    frame({spine.front()});
    const auto off = act({"jig"});
    ASSERT_FALSE(off);
    for (const char* part : {"STAGE STOPPED", "2.5 mm", "2.0 mm", "0, 0, 0.123", "do jig again"})
        EXPECT_TRUE(off.error().line().contains(part)) << off.error().line();
    frame({spine.front()});
    ASSERT_NE(activity_->run().session(), nullptr);
    EXPECT_EQ(activity_->run().session()->state().phase, study::StagePhase::paused);
    EXPECT_FALSE(act({"go-on"}));
    EXPECT_EQ(activity_->panel().rows().at(0).name, "in the jig");
    EXPECT_EQ(activity_->panel().rows().at(0).value, "2.5 mm off, 2.0 allowed") << "longer, it would cover its name";
    for (const session::ActivityPanel::Button& button : activity_->panel().buttons())
        EXPECT_EQ(button.enabled, button.title == "Stop" || button.title == "In the jig") << button.title;
    EXPECT_TRUE(std::ranges::any_of(events_, [](const RunEvent& e) { return e.value.contains("2.5 mm"); }));
    tool_.position_device_m = in_the_jig;
    frame({spine.front()});
    ASSERT_TRUE(act({"jig"}));
    const auto enabled = [&](const char* title) {
        const auto buttons = activity_->panel().buttons();
        return std::ranges::find(buttons, title, &session::ActivityPanel::Button::title)->enabled;
    };
    EXPECT_TRUE(enabled("Go on"));
    EXPECT_FALSE(enabled("Pause"));
    EXPECT_TRUE(act({"go-on"}));
    EXPECT_FALSE(act({"go-on"})) << "it goes on already";
    frame({spine.front(), spine.front()});
    EXPECT_NE(activity_->run().session()->state().phase, study::StagePhase::paused);
    EXPECT_FALSE(enabled("Go on"));
    EXPECT_TRUE(enabled("Pause"));
}

TEST_F(StudyActivities, ShowTheTubeToWhoSeesItAndItsTouchInRed) {
    const auto& spine = worlds_.at("tube")->world().spine_m;
    begin("interactive", 1);
    frame({spine[10]});
    ASSERT_TRUE(act({"start"}));
    frame({spine[10]});
    ASSERT_NE(edit("seen tube", ObjectProperty::seen), nullptr);
    EXPECT_EQ(edit("seen tube", ObjectProperty::seen)->value[0], 1.0);
    EXPECT_LT(edit("seen tube", ObjectProperty::opacity)->value[0], 1.0);
    frame({spine[10] + Vec3(0.0, 0.02, 0.0)});
    ASSERT_NE(edit("seen tube", ObjectProperty::colour), nullptr);
    EXPECT_GT(edit("seen tube", ObjectProperty::colour)->value[0], 0.7);
    picture::Picture scene;
    scene.pedestal.visible = scene.box.visible = true;
    scene.workpiece_object = {Vec3(0.0), Vec3(1.0)};
    activity_->stage(scene, 0);
    EXPECT_EQ(scene.objects.size(), 2u);
    EXPECT_FALSE(scene.pedestal.visible || scene.box.visible);
    EXPECT_TRUE(scene.workpiece_object.empty()) << "its shadow would tell where the tube is";
}

TEST_F(StudyActivities, LimitTheForceAndLeadWhoIsLed) {
    begin("led", 0);
    haptics::TickParameters parameters;
    parameters.limits.max_force_N = 3.0;
    activity_->adjust({}, parameters);
    EXPECT_EQ(parameters.limits.max_force_N, protocol_.force_limit_N);
    EXPECT_EQ(parameters.curve.count, 0u);
    const auto& spine = worlds_.at("tube")->world().spine_m;
    frame({spine.front()});
    ASSERT_TRUE(act({"start"}));
    frame(std::vector<Vec3>(20, spine.front()));
    EXPECT_TRUE(orders_.parameters);
    activity_->adjust({}, parameters);
    EXPECT_GT(parameters.curve.count, 10u);
    EXPECT_GT(parameters.guidance.stiffness_N_per_m, 0.0);
    EXPECT_GT(parameters.guidance.lead_speed_m_per_s, 0.0);
    frame(std::vector<Vec3>(200, spine.back()));  // and back again
    activity_->adjust({}, parameters);
    EXPECT_LT(parameters.guidance.lead_speed_m_per_s, 0.0);
    const session::ActivityPanel panel = activity_->panel();
    EXPECT_EQ(panel.aside, "p07, haptic");
    EXPECT_TRUE(std::ranges::any_of(panel.rows(), [](const auto& row) { return row.name == "force"; }));
}

}  // namespace
}  // namespace burin::activities
