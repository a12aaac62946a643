// SPDX-License-Identifier: MIT
// Sessions with several hands, and hands of several parts, without a picture drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "desk/live/desk.hpp"
#include "desk/panel/panel.hpp"
#include "desk/run/session.hpp"
#include "desk/run/session_frames.hpp"
#include "haptics/channels.hpp"
#include "session/drive/executors.hpp"
#include "session/drive/thread_recorder.hpp"
#include "session/state/session_settings.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::session {
namespace {

// A ball that two hands carve, in simulated time.
class HandsAtABall {
public:
    explicit HandsAtABall(const std::vector<std::string>& devices) {
        SessionSetup options = carving_setup();
        options.carve.workpiece.source = "ball:0.1";
        options.carve.workpiece.resolution = 32;
        options.hands.tool.shape = "ball:0.012";
        if (const auto set = set_devices(options.hands, devices); !set) throw std::runtime_error(set.error().line());
        auto made = Desk::create(options, session_wall(options.desk).value(), clock_);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        executor_.emplace(clock_, desk->session().loop(), desk->session().channels_of_parts(), desk->session().scene(),
                          [this](const auto& ended) { static_cast<void>(desk->session().collect(ended)); });
    }
    // A frame of 10 ms with these inputs.
    void frame(const std::vector<Input>& inputs = {}) {
        const Nanoseconds until_ns = clock_.now_ns() + 10'000'000;
        ASSERT_TRUE(executor_->advance_to(until_ns));
        std::vector<InputEvent> events;
        for (const Input& input : inputs) events.push_back({until_ns, input});
        desk->step({until_ns, until_ns, events}, {.size = {1280, 720}}, executor_->tools(),
                   [&](Executor::Order order) { executor_->order(std::move(order)); });
        const auto taken = executor_->take_updates();
        ASSERT_TRUE(taken);
        desk->take_news(taken->collected);
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    // Leads the hand in use along the screen.
    void drag(const Vec2& by_px, int count = 20) {
        for (int i = 1; i <= count; ++i) {
            mouse_px_ += by_px / static_cast<double>(count);
            frame({MouseMove{mouse_px_}});
        }
        settle();
    }
    // A steered hand follows its mouse with a delay.
    void settle() { frames(80); }
    [[nodiscard]] const haptics::ToolState& tool(std::size_t part) { return desk->session().hands().newest_tool(part); }

    std::unique_ptr<Desk> desk;

private:
    SimulatedClock clock_;
    std::optional<SteppedExecutor> executor_;
    Vec2 mouse_px_{640.0, 360.0};
};

CommandInput lead(const std::string& hand) { return {"hand", {hand}}; }

}  // namespace

TEST(SessionHands, EachHandIsLedByItselfAndTheOthersStayWhereTheyAre) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    ASSERT_EQ(desk.desk->session().hands().parts(), 2u);
    desk.frame({MouseMove{{640.0, 360.0}}});
    desk.settle();
    const Vec3 right_m = desk.tool(0).hip_object_m, left_m = desk.tool(1).hip_object_m;
    EXPECT_GT(right_m.x, left_m.x + 0.02) << "beside each other at the start";
    desk.drag({-80.0, 0.0});
    EXPECT_LT(desk.tool(0).hip_object_m.x, right_m.x - 0.003);
    EXPECT_LT(glm::distance(desk.tool(1).hip_object_m, left_m), 1e-4);

    desk.frame({lead("left")});
    const Vec3 rests_m = desk.tool(0).hip_object_m;
    desk.drag({0.0, -80.0});
    EXPECT_GT(desk.tool(1).hip_object_m.y, left_m.y + 0.003);
    EXPECT_LT(glm::distance(desk.tool(0).hip_object_m, rests_m), 1e-4) << "it rests where it was left";
    desk.frame({CommandInput{"next-hand", {}}});
    EXPECT_EQ(desk.desk->session().state().led().hand_name, "right");
}

TEST(SessionHands, EachHandHasAToolAndForcesOfItsOwn) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    desk.frames(3);
    desk.frame({lead("left"), CommandInput{"tool", {"box:0.01,0.01,0.01"}}, CommandInput{"force", {"off"}}});
    desk.frames(3);
    const auto parameters = [&](std::size_t part) { return desk.desk->session().channels(part).parameters.newest(); };
    EXPECT_TRUE(parameters(0).enabled);
    EXPECT_FALSE(parameters(1).enabled);
    EXPECT_FALSE(parameters(0).shape.touches());
    EXPECT_TRUE(parameters(1).shape.touches());
    desk.frame({lead("right")});
    EXPECT_EQ(desk.desk->session().state().led().tool.shape.kind, toolbox::ToolKind::ball);
    EXPECT_TRUE(desk.desk->session().state().led().force_on);
}

TEST(SessionHands, BothHandsCarveTheSamePiece) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    desk.frame({MouseMove{{640.0, 360.0}}});
    const std::uint64_t before = check_of(desk.desk->session());
    std::uint64_t last = before;
    for (const char* hand : {"right", "left"}) {
        desk.frame({lead(hand)});
        desk.frame({Scroll{{0.0, 10.0}, {}}});
        desk.frames(30);
        desk.frame({MouseClick{MouseButton::left, true, {}}});
        desk.frame({Scroll{{0.0, 10.0}, {}}});
        desk.frames(40);
        desk.frame({MouseClick{MouseButton::left, false, {}}});
        desk.frame({Scroll{{0.0, -20.0}, {}}});
        desk.frames(30);
        EXPECT_NE(check_of(desk.desk->session()), last) << hand;
        last = check_of(desk.desk->session());
    }
}

TEST(SessionHands, AHandThatHoldsTurnsThePieceUnderTheOther) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    desk.frame({MouseMove{{640.0, 360.0}}});
    desk.settle();
    desk.frame({lead("left")});
    const Similarity home = desk.desk->session().state().world_from_object;
    const Vec3 right_m = desk.tool(0).hip_object_m;
    const Vec3 right_world_m = home * right_m;
    desk.frame({MouseClick{MouseButton::right, true, {}}});
    desk.settle();
    const Vec3 held_m = desk.tool(1).hip_object_m;
    const Quat held_turn = desk.tool(1).orientation_object;
    EXPECT_TRUE(desk.desk->session().channels(1).parameters.newest().holds) << "what is held does not push its hand";
    desk.frame({MouseClick{MouseButton::middle, true, {.ctrl = true}}});
    desk.drag({120.0, 0.0});
    desk.frame({MouseClick{MouseButton::middle, false, {}}});
    desk.settle();
    const Similarity turned = desk.desk->session().state().world_from_object;
    EXPECT_GT(2.0 * std::acos(std::min(1.0, std::abs(glm::dot(turned.orientation, home.orientation)))), 0.2);
    EXPECT_EQ(turned.scale, home.scale);
    EXPECT_LT(glm::distance(desk.tool(1).hip_object_m, held_m), 1e-3) << "the piece goes with the hand that holds it";
    EXPECT_GT(std::abs(glm::dot(desk.tool(1).orientation_object, held_turn)), 1.0 - 1e-5);
    desk.drag({0.0, 90.0});  // along, as it lies turned
    EXPECT_LT(glm::distance(desk.tool(1).hip_object_m, held_m), 1e-3);
    EXPECT_GT(std::abs(glm::dot(desk.tool(1).orientation_object, held_turn)), 1.0 - 1e-5);
    const Similarity moved = desk.desk->session().state().world_from_object;
    EXPECT_GT(glm::distance(moved.position_m, turned.position_m), 1e-3);
    EXPECT_LT(glm::distance(moved * desk.tool(0).hip_object_m, right_world_m), 1e-3) << "the other hand rests";
    EXPECT_GT(glm::distance(desk.tool(0).hip_object_m, right_m), 1e-3) << "and so it is elsewhere on the piece";
    desk.frame({MouseClick{MouseButton::right, false, {}}});
    desk.settle();
    const Similarity let_go = desk.desk->session().state().world_from_object;
    EXPECT_TRUE(desk.desk->session().channels(1).parameters.newest().enabled);
    desk.drag({60.0, 0.0});
    EXPECT_EQ(desk.desk->session().state().world_from_object, let_go);
}

TEST(SessionHands, OneAloneHoldsNothing) {
    HandsAtABall desk({});
    desk.frame({MouseMove{{640.0, 360.0}}});
    const Similarity home = desk.desk->session().state().world_from_object;
    desk.frame({MouseClick{MouseButton::right, true, {}}});
    desk.drag({60.0, 20.0});
    EXPECT_EQ(desk.desk->session().state().world_from_object, home)
        << "as in recordings from before there were several";
}

TEST(SessionHands, ADeviceWhoseAmplifiersAreOffLeavesTheOtherItsForce) {
    HandsAtABall desk({"right=simulated", "left=simulated-wand"});
    desk.frame({MouseMove{{640.0, 360.0}}});
    desk.drag({-60.0, 0.0});
    desk.frame({Scroll{{0.0, 24.0}, {}}});
    desk.settle();
    ASSERT_GT(glm::length(desk.tool(0).given.force_device_N), 0.1) << "it presses on the ball";
    desk.frame({lead("left"), CommandInput{"amplifiers", {"off"}}});
    desk.frames(5);
    EXPECT_EQ(desk.tool(1).cause, haptics::GateCause::device_fault);
    EXPECT_EQ(desk.tool(0).cause, haptics::GateCause::none);
    EXPECT_GT(glm::length(desk.tool(0).given.force_device_N), 0.1);
    const std::vector<EventMark> events = desk.desk->session().notices().take_events();
    EXPECT_EQ(std::ranges::count(events, "left is lost", &EventMark::name), 1) << "for the recording";
    EXPECT_EQ(std::ranges::count(events, EventMark{events.front().time_ns, "right touches", "workpiece"}), 1);
}

namespace {

// A turn of the hands' loop in which a part reports that its whole device is lost; -1: none does. Returns the tools.
std::vector<haptics::ToolState> turn_with(SessionHands& hands, SimulatedClock& clock, int lost) {
    const geometry::LocalSurface surface;
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    std::vector<haptics::PartInput> inputs;
    clock.sleep_until(clock.now_ns() + hands.loop().period_ns());
    for (std::size_t part = 0; part < hands.parts(); ++part) {
        devices::DeviceSample sample;
        sample.time_ns = clock.now_ns();
        if (std::cmp_equal(part, lost)) {
            sample.fault = devices::DeviceFault::disconnected;
            sample.fault_is_of_all = true;
        }
        inputs.push_back({sample, &surface, &parameters});
    }
    hands.loop().repeat(inputs, clock.now_ns(), 0);
    std::vector<haptics::ToolState> tools;
    for (std::size_t part = 0; part < hands.parts(); ++part) tools.push_back(hands.newest_tool(part));
    return tools;
}

std::vector<std::string> messages_of(const std::vector<DeviceWatch::News>& news) {
    std::vector<std::string> messages;
    for (const DeviceWatch::News& one : news) messages.push_back(one.message);
    return messages;
}

}  // namespace

TEST(SessionHands, ADeviceLostInMidSessionTakesTheForceOffItsHandAlone) {
    SimulatedClock clock;
    SessionHands hands({4096, 16}, 1.0);
    ASSERT_TRUE(
        hands.open(std::vector<HandToOpen>{{"right", "simulated", {}}, {"left", "simulated-fingers", {}}}, clock));
    const auto causes = [&](int lost) {
        std::vector<bool> has_fault;
        for (const haptics::ToolState& tool : turn_with(hands, clock, lost))
            has_fault.push_back(tool.cause == haptics::GateCause::device_fault);
        return has_fault;
    };
    EXPECT_EQ(causes(-1), (std::vector{false, false, false, false, false}));
    EXPECT_EQ(causes(2), (std::vector{false, true, true, true, true})) << "the left one's cable is out";
    EXPECT_EQ(causes(0), (std::vector{true, false, false, false, false})) << "the right one's";
    EXPECT_EQ(causes(-1), (std::vector{false, false, false, false, false}));
}

TEST(SessionHands, ADeviceThatIsLostIsToldByNameOnceAndAgainWhenItIsWell) {
    SimulatedClock clock;
    SessionHands hands({4096, 16}, 1.0);
    ASSERT_TRUE(
        hands.open(std::vector<HandToOpen>{{"right", "simulated", {}}, {"left", "simulated-fingers", {}}}, clock));
    DeviceWatch watch;
    const auto look = [&](int lost) { return messages_of(watch.look(hands, turn_with(hands, clock, lost))); };
    using Messages = std::vector<std::string>;
    EXPECT_EQ(look(-1), Messages{});
    EXPECT_EQ(look(3), Messages{"left: no force: the device reports a fault; right goes on"});
    EXPECT_EQ(look(3), Messages{}) << "once";
    EXPECT_EQ(look(-1), Messages{}) << "not well for long enough";
    EXPECT_EQ(look(3), Messages{}) << "the same fault";
    for (int i = 0; i < 499; ++i) EXPECT_EQ(look(-1), Messages{});
    EXPECT_EQ(look(-1), Messages{"left: its device is well again"});
    // One finger of it alone, in a tool that somebody has made so, and the other hand with it.
    std::vector<haptics::ToolState> tools = turn_with(hands, clock, 0);
    tools[2].cause = haptics::GateCause::stale_sample;
    const auto news = watch.look(hands, tools);
    EXPECT_EQ(messages_of(news), (Messages{"right: no force: the device reports a fault",
                                           "left index: no force: the device has stopped sending"}));
    ASSERT_EQ(news.size(), 2u);
    EXPECT_EQ(news[1].event,
              (EventMark{tools[2].time_ns, "left index is lost", "no force: the device has stopped sending"}));
    tools[0].cause = tools[2].cause = haptics::GateCause::overspeed;  // the hand's doing, not the device's
    tools[0].time_ns += DeviceWatch::kWell_ns;
    EXPECT_EQ(messages_of(watch.look(hands, tools)), Messages{"right: its device is well again"});
}

TEST(SessionHands, AHandOfFourFingersHasFourToolsThatCloseAndFeelByThemselves) {
    HandsAtABall desk({"simulated-fingers"});
    ASSERT_EQ(desk.desk->session().hands().parts(), 4u);
    EXPECT_EQ(desk.desk->session().hands().name_of(1), "index");
    desk.frame({MouseMove{{640.0, 360.0}}});
    desk.frames(30);
    const double open_m = glm::distance(desk.tool(0).hip_object_m, desk.tool(2).hip_object_m);
    EXPECT_GT(open_m, 0.03);
    desk.frame({CommandInput{"force", {"off"}}});  // in the air: nothing is between them
    desk.frame({MouseClick{MouseButton::left, true, {}}});
    desk.frames(80);
    EXPECT_LT(glm::distance(desk.tool(0).hip_object_m, desk.tool(2).hip_object_m), 0.6 * open_m);
}

TEST(SessionHands, EachHasATouchSectionOfItsOwnOnThePanel) {
    PanelModel model;
    const auto labels_of = [&](ImageSize size = {340, 2400}) {
        Panel panel = Panel::create({.size = size}).value();
        static_cast<void>(panel.show(model, 0));
        return panel.labels();
    };
    const auto has = [](const std::vector<std::string>& labels, const std::string& label) {
        return std::ranges::find(labels, label) != labels.end();
    };
    const std::vector<std::string> of_one = labels_of();
    EXPECT_TRUE(has(of_one, "Touch"));
    model.hands = {{"right", {}, 0.0, 0.0}, {"left", {.force_on = false}, 0.3, 0.0}};
    model.hand = 0;
    const std::vector<std::string> of_two = labels_of();
    for (const char* label : {"Touch, right", "Touch, left", "force", "force left", "velocity-filter left"})
        EXPECT_TRUE(has(of_two, label)) << label;
    EXPECT_FALSE(has(of_two, "force right")) << "the hand in use needs no name";

    // What is said of the other hand leads it for as long as it takes.
    Panel panel = Panel::create({.size = {340, 2400}}).value();
    static_cast<void>(panel.show(model, 0));
    const auto at = panel.place_of("force left");
    ASSERT_TRUE(at);
    const Vec2 middle(at->x + 0.5 * at->width, at->y + 0.5 * at->height);
    panel.feed(std::vector<InputEvent>{{0, MouseMove{middle}},
                                       {0, MouseClick{MouseButton::left, true, {}}},
                                       {0, MouseClick{MouseButton::left, false, {}}}});
    const std::vector<CommandInput> expected{lead("left"), {"force", {"on"}}, lead("right")};
    EXPECT_EQ(panel.show(model, 16'000'000).actions, expected);
}

TEST(SessionHands, TheForceOfTheOtherIsSwitchedWhileTheFirstIsLed) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    desk.frames(3);
    const Vec3 target_m = desk.desk->viewer().desk.target_device_m;
    desk.frame({lead("left"), CommandInput{"force", {"off"}}, lead("right")});
    desk.frames(3);
    EXPECT_TRUE(desk.desk->session().channels(0).parameters.newest().enabled);
    EXPECT_FALSE(desk.desk->session().channels(1).parameters.newest().enabled);
    EXPECT_EQ(desk.desk->session().state().led().hand_name, "right");
    EXPECT_EQ(desk.desk->viewer().desk.target_device_m, target_m) << "and stays where it was led";
}

// What a hand holds and where it is stays its own, however often the others are led meanwhile.
TEST(SessionHands, LeftBehindKeepTheirButtonsAndPlaces) {
    HandsAtABall desk({"right=simulated", "left=simulated"});
    desk.frames(2);
    const std::array<std::string, 2> names{"right", "left"};
    for (const std::size_t first : {0u, 1u})
        for (std::uint32_t buttons = 0; buttons < 4; ++buttons) {
            const std::size_t second = 1 - first;
            SessionState state = desk.desk->session().state();
            Viewer viewer = desk.desk->viewer();
            SessionOrders orders;
            const auto lead_by_name = [&](const std::string& name) {
                return run_command(viewer, state, desk.desk->room(), orders, LeadHand{name});
            };
            const auto be = [&](std::size_t hand, std::uint32_t pressed) {
                viewer.desk.buttons = pressed;
                viewer.desk.target_device_m = uneven_offset(hand);
                viewer.desk.target_turn_device = uneven_turn(hand);
            };
            const auto expect = [&](std::size_t hand, std::uint32_t pressed) {
                EXPECT_EQ(state.hand, hand);
                EXPECT_EQ(viewer.desk.buttons, pressed) << names[hand] << ", first " << first;
                EXPECT_EQ(viewer.desk.target_device_m, uneven_offset(hand)) << names[hand];
                EXPECT_EQ(viewer.desk.target_turn_device, uneven_turn(hand)) << names[hand];
            };
            ASSERT_TRUE(lead_by_name(names[first]));
            be(first, buttons);
            ASSERT_TRUE(lead_by_name(names[second]));
            EXPECT_EQ(viewer.desk.buttons, 0u) << "the other had none";
            EXPECT_EQ(state.hands[first].target.buttons, buttons);
            be(second, 3 - buttons);
            for (int times = 0; times < 3; ++times) {
                ASSERT_TRUE(lead_by_name(names[first]));
                expect(first, buttons);
                EXPECT_EQ(state.hands[second].target.buttons, 3 - buttons);
                ASSERT_TRUE(lead_by_name(names[second]));
                expect(second, 3 - buttons);
                EXPECT_EQ(state.hands[first].target.buttons, buttons);
            }
        }
}

TEST(SessionHands, LeftBehindHoldTheirButtonsDownInEachTick) {
    for (const auto& [button, bit] : {std::pair{MouseButton::left, 1u}, std::pair{MouseButton::right, 2u}})
        for (const std::size_t first : {0u, 1u}) {
            HandsAtABall desk({"right=simulated", "left=simulated"});
            const std::array<std::string, 2> names{"right", "left"};
            desk.frame({lead(names[first])});
            desk.frame({MouseMove{{640.0, 360.0}}});
            desk.frame({MouseClick{button, true, {}}});
            desk.settle();
            ASSERT_EQ(desk.tool(first).buttons, bit);
            for (const std::size_t led : {1 - first, first, 1 - first, first}) {
                desk.frame({lead(names[led])});
                for (int i = 0; i < 20; ++i) {
                    desk.frame();
                    EXPECT_EQ(desk.tool(first).buttons, bit) << names[first] << " while " << names[led] << " is led";
                    EXPECT_EQ(desk.tool(1 - first).buttons, 0u);
                }
            }
            desk.frame({MouseClick{button, false, {}}});
            desk.settle();
            EXPECT_EQ(desk.tool(first).buttons, 0u);
        }
}

TEST(SessionHands, SayWhichHandsThereAreWhereAnotherIsAskedFor) {
    HandsAtABall two({"right=simulated", "left=simulated"});
    SessionState state = two.desk->session().state();
    const auto none = lead_hand(state, "middle");
    ASSERT_FALSE(none);
    EXPECT_TRUE(none.error().line().contains("right or left")) << none.error().line();
    HandsAtABall one({});
    state = one.desk->session().state();
    const auto alone = lead_hand(state, "left");
    ASSERT_FALSE(alone);
    EXPECT_TRUE(alone.error().line().contains("--device right=simulated")) << alone.error().line();
}

TEST(SessionHands, RefuseDevicesThatCannotBeTold) {
    const auto refused = [](const std::vector<std::string>& given) {
        HandsSetup hands;
        const auto set = set_devices(hands, given);
        return set ? "nothing" : set.error().line();
    };
    EXPECT_TRUE(refused({"right=simulated", "simulated"}).contains("does not say whose device it is"));
    EXPECT_TRUE(refused({"right=simulated", "right=simulated-wand"}).contains("a second device of one name"));
    EXPECT_TRUE(refused({"right="}).contains("names no device"));
    EXPECT_TRUE(refused({"my hand=simulated", "b=simulated"}).contains("letters, digits"));
    EXPECT_TRUE(
        refused({"a=simulated", "b=simulated", "c=simulated", "d=simulated", "e=simulated"}).contains("4 hands"));
    EXPECT_EQ(refused({"simulated-wand:left=right.toml"}), "nothing") << "a file's name";
    SessionSetup options = carving_setup();
    ASSERT_TRUE(set_devices(options.hands, {"right=simulated", "left=simulatd"}));
    SimulatedClock clock;
    const auto opened = Desk::create(options, session_wall(options.desk).value(), clock);
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("hand left: haptic device simulatd")) << opened.error().line();
    EXPECT_TRUE(opened.error().line().contains("did you mean simulated?")) << opened.error().line();
}

// Only of a simulated hand does the panel say that the mouse steers it: a glove is on a person's.
TEST(SessionHands, ThePanelSaysWhoHoldsEachDevice) {
    SimulatedClock clock;
    SessionHands hands({4096, 16}, 1.0);
    ASSERT_TRUE(hands.open(
        std::vector<HandToOpen>{
            {"right", "simulated", {}}, {"left", "glove:/dev/none", {}}, {"third", "simulated", {}}},
        clock, true));
    const auto source = [&](std::size_t part, haptics::GateCause cause = haptics::GateCause::none) {
        const PanelSource shown = hand_source(hands, part, cause, 0);
        return shown.name + ": " + shown.detail;
    };
    EXPECT_EQ(source(0), "Hand, right: simulated, steered by the mouse");
    const std::size_t third = hands.first_part(2);
    EXPECT_EQ(source(third), "Hand, third: simulated, rests");
    for (std::size_t part = 1; part < third; ++part)
        EXPECT_EQ(source(part), "Hand, " + hands.name_of(part) + ": " + hands.device(part).name) << "a person's";
    EXPECT_EQ(source(1, haptics::GateCause::device_fault),
              "Hand, " + hands.name_of(1) + ": no force: the device reports a fault");
}

TEST(SessionHands, AThirdThatDoesNotOpenIsNamedWithItsDevice) {
    SessionSetup options = carving_setup();
    options.carve.workpiece.source = "ball:0.1";
    options.carve.workpiece.resolution = 16;
    ASSERT_TRUE(set_devices(options.hands, {"right=simulated", "left=simulated", "third=glove:/dev/none-there"}));
    MonotonicClock clock;
    const auto opened = Desk::create(options, session_wall(options.desk).value(), clock);
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("hand third: ")) << opened.error().line();
    EXPECT_TRUE(opened.error().line().contains("/dev/none-there")) << opened.error().line();
    EXPECT_FALSE(opened.error().remedy.empty());
}

TEST(SessionHands, AreKeptInTheFirstLineOfARecording) {
    SessionSetup options = carving_setup();
    options.record.input = "x";
    ASSERT_TRUE(set_devices(options.hands, {"right=simulated", "left=simulated-wand:my wand.toml"}));
    const auto again = options_as_recorded(settings_line(options), SessionSetup{});
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ(again->options.hands.named, options.hands.named);
    EXPECT_FALSE(options_as_recorded("burin sculpt --hands right", SessionSetup{}));
}

}  // namespace burin::session
