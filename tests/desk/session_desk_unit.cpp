// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "desk/input/desk_input.hpp"
#include "desk/input/input_wand.hpp"
#include "session/input/input_keys.hpp"
#include "tests/desk/used_desk.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {
namespace {

KeyInput press(Key key, Modifiers modifiers = {}) { return {key, KeyMotion::press, modifiers}; }
KeyInput release(Key key) { return {key, KeyMotion::release, {}}; }

Vec3 random_point(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> u(-size, size);
    const double x = u(random), y = u(random);
    return {x, y, u(random)};
}
Quat random_turn(std::mt19937& random) {
    std::normal_distribution<double> n;
    const double w = n(random), x = n(random), y = n(random);
    return glm::normalize(Quat(w, x, y, n(random)));
}
Similarity random_scene(std::mt19937& random) {
    const Vec3 p = random_point(random, 2.0);
    const Quat q = random_turn(random);
    return {p, q, std::exp(std::uniform_real_distribution<double>(-2.0, 2.0)(random))};
}
bool identical(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}
}  // namespace

TEST(DeskInput, TheMouseMovesTheStylusAlongTheScreenAndTheWheelInDepth) {
    UsedDesk desk;
    desk.view.device_m_per_px = 0.0005;
    EXPECT_EQ(desk.step({MouseMove{{300.0, 200.0}}}).target.position_device_m, Vec3(0.0));  // only where it is
    const DeskStep moved = desk.step({MouseMove{{310.0, 180.0}}, MouseMove{{320.0, 190.0}}});
    EXPECT_LT(apart(moved.target.position_device_m, {0.01, 0.005, 0.0}), 1e-15);  // right and up
    const DeskStep deeper = desk.step({Scroll{{0.0, 3.0}, {}}});
    EXPECT_LT(apart(deeper.target.position_device_m, {0.01, 0.005, -0.006}), 1e-15);  // away from the user
    const DeskStep closer = desk.step({press(Key::shift), MouseMove{{320.0, 200.0}}, release(Key::shift)});
    EXPECT_LT(apart(closer.target.position_device_m, {0.01, 0.005, -0.001}), 1e-15);  // pulled towards oneself
    EXPECT_TRUE(identical(closer.scene_change, {}));
}

TEST(DeskInput, TheStylusStaysInItsWorkspaceAndTheWayBackHasNoDeadTravel) {
    UsedDesk desk;
    desk.step({MouseMove{{0.0, 0.0}}});
    EXPECT_EQ(desk.step({MouseMove{{3e4, 0.0}}}).target.position_device_m, Vec3(0.0813, 0.0, 0.0));
    const double back = desk.step({MouseMove{{3e4 - 4.0, 0.0}}}).target.position_device_m.x;
    EXPECT_NEAR(back, 0.0813 - 0.001, 1e-12);
}

TEST(DeskInput, ASqueezedPictureIsFollowedAndChangingWindowsIsNoMotion) {
    UsedDesk desk;
    desk.view.device_m_per_px = 0.001;
    desk.view.picture_px_per_px = {2.0, 1.0};
    desk.step({MouseMove{{100.0, 100.0}}});
    EXPECT_LT(apart(desk.step({MouseMove{{105.0, 90.0}}}).target.position_device_m, {0.01, 0.01, 0.0}), 1e-12);
    const DeskStep right = desk.step({MouseMove{{wall::kRightWindow_px + 300.0, 50.0}}});
    EXPECT_LT(apart(right.target.position_device_m, {0.01, 0.01, 0.0}), 1e-12);
    const DeskStep on = desk.step({MouseMove{{wall::kRightWindow_px + 305.0, 50.0}}});
    EXPECT_LT(apart(on.target.position_device_m, {0.02, 0.01, 0.0}), 1e-12);
}

TEST(DeskInput, ATurnedWorkspaceIsSteeredAsItIsSeen) {
    UsedDesk desk;
    desk.view.device_from_screen =
        glm::angleAxis(std::acos(-1.0) / 2, Vec3(0.0, 1.0, 0.0));  // right is -z of the device
    desk.view.device_m_per_px = 0.001;
    desk.step({MouseMove{{0.0, 0.0}}});
    EXPECT_LT(apart(desk.step({MouseMove{{10.0, 0.0}}}).target.position_device_m, {0.0, 0.0, -0.01}), 1e-12);
}

TEST(DeskInput, ThePictureOfTheToolMovesAsFarAsTheMouse) {
    // By similar triangles, checked against a projection by hand: the eye at 2 m, the tool 0.5 m before the screen,
    // device motions doubled in the world.
    const double pitch = 0.0016;
    const double gain = device_m_per_px(pitch, 2.0, 1.5, 2.0);
    const double tool_x = 2.0 * 100.0 * gain;               // of a hundred pixels, in the world
    EXPECT_NEAR(tool_x * 2.0 / 1.5, 100.0 * pitch, 1e-12);  // where the line from the eye through it meets the screen
}

TEST(DeskInput, ButtonsAreTheStylussAndAQuickClickIsNotLost) {
    UsedDesk desk;
    EXPECT_EQ(desk.step({MouseClick{MouseButton::left, true, {}}}).target.buttons, 1u);
    EXPECT_EQ(desk.step().target.buttons, 1u);
    EXPECT_EQ(desk.step({MouseClick{MouseButton::right, true, {}}}).target.buttons, 3u);
    EXPECT_EQ(desk.step({MouseClick{MouseButton::left, false, {}}}).target.buttons, 2u);
    EXPECT_EQ(desk.step({MouseClick{MouseButton::right, false, {}}}).target.buttons, 0u);
    const DeskStep click =
        desk.step({MouseClick{MouseButton::left, true, {}}, MouseClick{MouseButton::left, false, {}}});
    EXPECT_EQ(click.target.buttons, 1u);
    EXPECT_EQ(desk.step().target.buttons, 0u);
}

TEST(DeskInput, TellsTheHandOfEachEventAtItsOwnTime) {
    UsedDesk desk;
    const std::vector<InputEvent> events{{1, MouseMove{{0.0, 0.0}}},
                                         {2, MouseMove{{8.0, 0.0}}},
                                         {3, press(Key::w)},  // nothing to the hand
                                         {4, MouseClick{MouseButton::left, true, {}}},
                                         {5, MouseMove{{8.0, 0.0}}},  // still there
                                         {6, MouseClick{MouseButton::left, false, {}}},
                                         {7, MouseMove{{8.0, -8.0}}}};
    const DeskStep step = step_desk(desk.state, events, kFrame_s, desk.view, desk.settings);
    ASSERT_EQ(step.way.size(), 6u);
    const std::vector<Nanoseconds> times{1, 2, 4, 5, 6, 7};
    const double d = 8.0 * desk.view.device_m_per_px;
    const std::vector<Vec3> places{Vec3(0.0), {d, 0, 0}, {d, 0, 0}, {d, 0, 0}, {d, 0, 0}, {d, d, 0}};
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(step.way[i].time_ns, times[i]);
        EXPECT_LT(apart(step.way[i].position_device_m, places[i]), 1e-15) << i;
        EXPECT_EQ(step.way[i].buttons, i < 2 ? 0u : 1u) << i;  // a click within a frame lasts until its end
    }
    EXPECT_EQ(step.target.position_device_m, step.way.back().position_device_m);
}

TEST(DeskInput, LosingTheFocusReleasesEverything) {
    UsedDesk desk;
    desk.step({MouseMove{{0.0, 0.0}}, MouseClick{MouseButton::left, true, {}}, press(Key::w), press(Key::shift)});
    const DeskStep lost = desk.step({WindowFocus{false}});
    EXPECT_EQ(lost.target.buttons, 0u);
    EXPECT_TRUE(lost.state.keys.none());
    EXPECT_EQ(lost.state.modifiers, Modifiers{});
    EXPECT_EQ(desk.step({MouseMove{{500.0, 500.0}}}).target.position_device_m, Vec3(0.0));  // no leap on return
}

TEST(DeskInput, WhatThePanelCapturedPressesNothingButReleases) {
    UsedDesk desk;
    desk.step({MouseMove{{0.0, 0.0}}, MouseClick{MouseButton::left, true, {}}, press(Key::w)});
    desk.view.mouse_captured = desk.view.keyboard_captured = true;
    EXPECT_EQ(desk.step({MouseClick{MouseButton::right, true, {}}, Scroll{{0.0, 1.0}, {}}}).target.buttons, 1u);
    EXPECT_TRUE(desk.step({press(Key::z, {.ctrl = true}), press(Key::digit_1)}).actions.empty());
    const DeskStep up = desk.step({MouseClick{MouseButton::left, false, {}}, release(Key::w)});
    EXPECT_EQ(up.target.buttons, 0u);
    EXPECT_TRUE(up.state.keys.none());
    EXPECT_EQ(desk.step({MouseMove{{100.0, 0.0}}}).target.position_device_m, Vec3(0.0));
}

TEST(DeskInput, EveryShortCutOfTheTableDoesWhatItSaysAndNothingElse) {
    std::set<std::tuple<Key, std::string, std::optional<MouseMode>>> taken;
    for (const ShortCut& s : short_cuts()) {
        EXPECT_TRUE(taken.insert({s.key, name_of(s.modifiers), s.only}).second) << label_of(s) << " twice";
        UsedDesk desk;
        if (s.only) {
            UsedDesk other;
            (s.only == MouseMode::surface ? desk : other).follow_surface();
            const auto actions = other.step({press(s.key, s.modifiers)}).actions;
            EXPECT_TRUE(std::ranges::find(actions, s.action) == actions.end()) << label_of(s);
        }
        EXPECT_EQ(desk.step({press(s.key, s.modifiers)}).actions, std::vector{s.action}) << label_of(s);
        const DeskStep again = desk.step({KeyInput{s.key, KeyMotion::repeat, s.modifiers}});
        EXPECT_EQ(again.actions.size(), s.repeats ? 1u : 0u) << label_of(s);
        EXPECT_TRUE(desk.step({release(s.key)}).actions.empty());
        Modifiers more = s.modifiers;
        more.alt = true;
        EXPECT_TRUE(desk.step({press(s.key, more)}).actions.empty()) << label_of(s);
        EXPECT_FALSE(help_of(s.action).empty());
        for (const FlightKey& f : flight_keys())  // a key that flies is no short cut then unless with Ctrl
            EXPECT_TRUE(f.key != s.key || s.modifiers.ctrl || s.only == MouseMode::surface) << label_of(s);
    }
    std::set<std::string_view> names(action_names().begin(), action_names().end());
    EXPECT_EQ(names.size(), action_names().size());
    EXPECT_EQ(action_names().size(), static_cast<std::size_t>(Action::quit) + 1);
}

TEST(DeskInput, LabelsAreWhatPeopleReadOnKeys) {
    std::set<std::string> labels;
    for (const ShortCut& s : short_cuts()) labels.insert(label_of(s));
    for (const char* label :
         {"Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y", "1", "5", "[", "]", "M", "Tab", "F1", "Home", "Ctrl+E", "Ctrl+Q"})
        EXPECT_TRUE(labels.contains(label)) << label;
    EXPECT_EQ(label_of(FlightKey{Key::page_up, Flight::forwards, ""}), "Page Up");
    EXPECT_EQ(label_of(MouseGesture{MouseUse::wheel, {.ctrl = true}, Gesture::scale_scene, ""}), "Ctrl+Wheel");
}

TEST(DeskInput, ActionsComeInTheirOrder) {
    UsedDesk desk;
    const DeskStep step = desk.step({press(Key::digit_2), press(Key::z, {.ctrl = true}), press(Key::right_bracket)});
    EXPECT_EQ(step.actions, (std::vector{Action::tool_2, Action::undo, Action::larger_radius}));
}

TEST(DeskInput, HeadsFlyWhereTheirKeysSayAndGlideToRest) {
    for (const FlightKey& key : flight_keys()) {
        UsedDesk desk;
        const Vec3 home = desk.state.head_world.position_m;
        desk.step({press(key.key)});
        for (int i = 0; i < 120; ++i) desk.step();
        EXPECT_NEAR(glm::length(desk.state.flight_m_per_s), desk.settings.flight_speed_m_per_s, 1e-6);
        const Vec3 way = glm::normalize(desk.state.head_world.position_m - home);
        const Vec3 wanted = key.flight == Flight::forwards    ? Vec3(0, 0, -1)
                            : key.flight == Flight::backwards ? Vec3(0, 0, 1)
                            : key.flight == Flight::left      ? Vec3(-1, 0, 0)
                            : key.flight == Flight::right     ? Vec3(1, 0, 0)
                            : key.flight == Flight::up        ? Vec3(0, 1, 0)
                                                              : Vec3(0, -1, 0);
        EXPECT_LT(apart(way, wanted), 1e-9) << label_of(key);
        desk.step({release(key.key)});
        for (int i = 0; i < 120; ++i) desk.step();
        EXPECT_EQ(desk.state.flight_m_per_s, Vec3(0.0));  // truly at rest: nothing to draw
    }
}

TEST(DeskInput, TwoKeysFlyNoFasterThanOneAndOpposedKeysNotAtAll) {
    UsedDesk desk;
    desk.step({press(Key::w), press(Key::a), press(Key::left)});
    for (int i = 0; i < 120; ++i) desk.step();
    EXPECT_NEAR(glm::length(desk.state.flight_m_per_s), desk.settings.flight_speed_m_per_s, 1e-6);
    EXPECT_NEAR(desk.state.flight_m_per_s.x, desk.state.flight_m_per_s.z, 1e-9);
    desk.step({press(Key::s), press(Key::d)});
    for (int i = 0; i < 120; ++i) desk.step();
    EXPECT_EQ(desk.state.flight_m_per_s, Vec3(0.0));
}

TEST(DeskInput, SavingDoesNotFlyAndTheHeadStaysInItsBox) {
    UsedDesk desk;
    desk.step({press(Key::s, {.ctrl = true})});
    for (int i = 0; i < 60; ++i) desk.step();
    EXPECT_EQ(desk.state.head_world.position_m, desk.settings.home_head_world.position_m);
    desk.settings.head_world = {{-1.0, 0.3, 0.3}, {1.0, 2.5, 4.0}};
    desk.step({press(Key::w)});
    for (int i = 0; i < 1000; ++i) desk.step();
    EXPECT_EQ(desk.state.head_world.position_m.z, 0.3);
    const DeskStep home = desk.step({release(Key::w), press(Key::home)});
    EXPECT_EQ(home.head_world.position_m, desk.settings.home_head_world.position_m);
    EXPECT_EQ(home.actions, std::vector{Action::reset_view});
}

TEST(DeskInput, CtrlAndTheWheelScaleAboutThePivotWithinLimits) {
    UsedDesk desk;
    desk.view.pivot_world = {0.2, 1.0, -0.5};
    desk.step({Scroll{{0.0, 2.0}, {.ctrl = true}}});
    EXPECT_NEAR(desk.world_from_scene.scale, 1.21, 1e-12);
    EXPECT_LT(apart(desk.world_from_scene * desk.view.pivot_world, desk.view.pivot_world), 1e-12);
    for (int i = 0; i < 100; ++i) desk.step({Scroll{{0.0, 40.0}, {.ctrl = true}}});
    EXPECT_NEAR(desk.world_from_scene.scale, desk.settings.most_scale, 1e-6);
    for (int i = 0; i < 100; ++i) desk.step({Scroll{{0.0, -1e9}, {.ctrl = true}}});
    EXPECT_NEAR(desk.world_from_scene.scale, desk.settings.least_scale, 1e-9);
}

TEST(DeskInput, AStepIsAFunctionOfItsArgumentsAlone) {
    const auto used = [] {
        UsedDesk desk;
        for (int i = 0; i < 50; ++i)
            desk.step({MouseMove{{3.0 * i, 2.0 * i}}, press(i % 2 == 0 ? Key::w : Key::d), Scroll{{0.0, 0.1}, {}}});
        return desk.state;
    };
    const DeskState a = used(), b = used();
    EXPECT_EQ(a.target_device_m, b.target_device_m);
    EXPECT_EQ(a.head_world.position_m, b.head_world.position_m);
}

TEST(SceneByHand, AGrabbedPointStaysUnderTheWandExactly) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Similarity scene = random_scene(random);
        const Pose then{random_point(random, 2.0), random_turn(random)},
            now{random_point(random, 2.0), random_turn(random)};
        const Similarity held = carried(WandGrab{then, scene}, now);
        const Vec3 in_wand = random_point(random, 0.3);  // any point of the scene keeps its place as the wand sees it
        const Vec3 in_scene = inverse(scene) * (then * in_wand);
        ASSERT_LT(apart(held * in_scene, now * in_wand), 1e-12);
        ASSERT_EQ(held.scale, scene.scale);
        ASSERT_NEAR(glm::length(held.orientation), 1.0, 1e-14);
        ASSERT_TRUE(identical(carried(WandGrab{then, scene}, then), scene));  // no motion: to the last bit
    }
}

TEST(SceneByHand, ScalingAndTurningKeepTheirPoint) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Similarity scene = random_scene(random);
        const Vec3 point = random_point(random, 2.0), in_scene = inverse(scene) * point,
                   other = random_point(random, 1.0);
        const double factor = std::exp(std::uniform_real_distribution<double>(-1.0, 1.0)(random));
        const Similarity scaled = scaled_about(scene, point, factor),
                         turned = turned_about(scene, point, random_turn(random));
        ASSERT_LT(apart(scaled * in_scene, point), 1e-11);
        ASSERT_LT(apart(turned * in_scene, point), 1e-11);
        ASSERT_NEAR(apart(scaled * other, point), factor * apart(scene * other, point), 1e-10);
        ASSERT_NEAR(apart(turned * other, point), apart(scene * other, point), 1e-10);
    }
}

TEST(SceneByHand, TwoHandsKeepBothPlacesTheyHold) {
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Similarity scene = random_scene(random);
        const std::array<Vec3, 2> then{random_point(random, 1.0), random_point(random, 1.0)};
        const std::array<Vec3, 2> now{random_point(random, 1.0), random_point(random, 1.0)};
        if (apart(then[0], then[1]) < 0.1 || apart(now[0], now[1]) < 0.1) continue;
        const Similarity held = carried(TwoWandGrab{then, scene}, now, 1e-6, 1e6);
        for (std::size_t hand = 0; hand < 2; ++hand)
            ASSERT_LT(apart(held * (inverse(scene) * then[hand]), now[hand]), 1e-11);
        ASSERT_TRUE(identical(carried(TwoWandGrab{then, scene}, then, 1e-6, 1e6), scene));
        // Crossed hands: half a turn, about whatever axis.
        const Similarity crossed = carried(TwoWandGrab{then, scene}, {then[1], then[0]}, 1e-6, 1e6);
        ASSERT_LT(apart(crossed * (inverse(scene) * then[0]), then[1]), 1e-7);
    }
}

TEST(SceneByHand, TwoHandsRespectTheLimitsOfScaleAndOfNearness) {
    const Similarity scene{{0.0, 1.0, 0.0}, {1, 0, 0, 0}, 1.0};
    const std::array<Vec3, 2> then{Vec3(-0.1, 1.0, 0.0), Vec3(0.1, 1.0, 0.0)};
    const Similarity held = carried(TwoWandGrab{then, scene}, {Vec3(-1.0, 1.5, 0.0), Vec3(1.0, 1.5, 0.0)}, 0.5, 2.0);
    EXPECT_DOUBLE_EQ(held.scale, 2.0);
    EXPECT_LT(apart(held * Vec3(0.0), {0.0, 1.5, 0.0}), 1e-12);  // the middle is still held
    const Similarity near =
        carried(TwoWandGrab{{Vec3(0.0), Vec3(0.001, 0.0, 0.0)}, scene}, {Vec3(0.0), Vec3(1.0, 0.0, 0.0)}, 1e-6, 1e6);
    EXPECT_EQ(near.scale, 1.0);
}

namespace {

class Wands {
public:
    WandSettings settings;
    WandState state;
    Similarity scene{{0.3, 1.2, -0.4}, glm::normalize(Quat(0.9, 0.1, 0.3, 0.2)), 1.5};
    Pose head{{0.0, 1.6, 2.0}, {1, 0, 0, 0}};

    void step(const std::vector<Input>& inputs, double dt_s = kFrame_s) {
        std::vector<InputEvent> events;
        for (const Input& input : inputs) events.push_back({0, input});
        WandStep done = step_wands(state, events, dt_s, scene, head, settings);
        state = done.state;
        scene = done.world_from_scene;
    }
};

WandInput at(std::uint32_t wand, const Vec3& p, const Quat& q = {1, 0, 0, 0}, bool tracked = true) {
    return {wand, {p, q}, tracked};
}

}  // namespace

TEST(Wands, GrabbingAndLettingGoWithoutMotionIsTheIdentity) {
    Wands w;
    const Similarity before = w.scene;
    w.step({at(0, {0.1, 1.0, 0.5})});
    w.step({WandClick{0, 0, true}});
    for (int i = 0; i < 10; ++i) w.step({at(0, {0.1, 1.0, 0.5})});
    w.step({WandClick{0, 0, false}});
    EXPECT_TRUE(identical(w.scene, before));
}

TEST(Wands, CarryTheSceneThroughOneHandTwoHandsAndBackWithoutALeap) {
    Wands w;
    w.step({at(0, {0.1, 1.0, 0.5}), at(1, {-0.3, 1.1, 0.4}), WandClick{0, 0, true}});
    const Vec3 held = inverse(w.scene) * Vec3(0.1, 1.0, 0.5);
    const Quat turn = glm::angleAxis(0.5, glm::normalize(Vec3(1.0, 2.0, 0.5)));
    w.step({at(0, {0.2, 1.3, 0.1}, turn)});
    EXPECT_LT(apart(w.scene * held, {0.2, 1.3, 0.1}), 1e-12);
    const Similarity one = w.scene;
    w.step({WandClick{1, 0, true}});
    EXPECT_TRUE(identical(w.scene, one));  // the second hand comes in
    const Vec3 second = inverse(w.scene) * Vec3(-0.3, 1.1, 0.4);
    w.step({at(0, {0.5, 1.3, 0.1}, turn), at(1, {-0.6, 1.2, 0.3})});
    EXPECT_LT(apart(w.scene * held, {0.5, 1.3, 0.1}), 1e-11);
    EXPECT_LT(apart(w.scene * second, {-0.6, 1.2, 0.3}), 1e-11);
    EXPECT_GT(w.scene.scale, one.scale);
    const Similarity two = w.scene;
    w.step({WandClick{0, 0, false}});
    EXPECT_TRUE(identical(w.scene, two));  // the first lets go
    w.step({at(1, {-0.6, 1.4, 0.3})});
    EXPECT_LT(apart(w.scene * second, {-0.6, 1.4, 0.3}), 1e-11);
}

TEST(Wands, ALostTrackerLetsGoAndTakesUpAgainWithoutALeap) {
    Wands w;
    w.step({at(0, {0.1, 1.0, 0.5}), WandClick{0, 0, true}});
    w.step({at(0, {0.2, 1.0, 0.5})});
    const Similarity before = w.scene;
    w.step({at(0, {9.0, 9.0, 9.0}, {1, 0, 0, 0}, false)});
    w.step({});
    w.step({at(0, {0.7, 1.5, 0.0})});  // seen again, elsewhere
    EXPECT_TRUE(identical(w.scene, before));
    const Vec3 held = inverse(w.scene) * Vec3(0.7, 1.5, 0.0);
    w.step({at(0, {0.8, 1.5, 0.0})});
    EXPECT_LT(apart(w.scene * held, {0.8, 1.5, 0.0}), 1e-12);
}

TEST(Wands, TheStickFliesTurnsAndScales) {
    Wands w;
    const Quat aside = glm::angleAxis(-std::acos(-1.0) / 2, Vec3(0.0, 1.0, 0.0));  // points along +x
    w.step({at(0, {0.1, 1.0, 0.5}, aside)});
    const Similarity start = w.scene;
    for (int i = 0; i < 60; ++i) w.step({WandStick{0, {0.0, 1.0}}});
    EXPECT_LT(apart(w.scene.position_m, start.position_m - Vec3(1.0, 0.0, 0.0)), 1e-9);  // a metre in a second
    w.step({WandStick{0, {0.0, 0.14}}});
    const Similarity rest = w.scene;
    w.step({});
    EXPECT_TRUE(identical(w.scene, rest));  // within the dead zone: nothing at all

    const Vec3 viewer = inverse(w.scene) * w.head.position_m;
    for (int i = 0; i < 60; ++i) w.step({WandStick{0, {1.0, 0.0}}});
    EXPECT_LT(apart(w.scene * viewer, w.head.position_m), 1e-11);
    // What was straight ahead is to the left now.
    const Vec3 ahead = inverse(rest) * (w.head.position_m + Vec3(0.0, 0.0, -1.0));
    EXPECT_NEAR((w.scene * ahead).x, w.head.position_m.x - std::sin(w.settings.turn_speed_rad_per_s), 1e-9);

    w.step({WandStick{0, {0.0, 0.0}}, WandClick{0, 0, true}});
    const Vec3 held = inverse(w.scene) * Vec3(0.1, 1.0, 0.5);
    const double scale = w.scene.scale;
    for (int i = 0; i < 60; ++i) w.step({WandStick{0, {0.0, 1.0}}});
    EXPECT_NEAR(w.scene.scale / scale, std::exp(w.settings.scale_rate_per_s), 1e-9);
    EXPECT_LT(apart(w.scene * held, {0.1, 1.0, 0.5}), 1e-11);
    for (int i = 0; i < 3000; ++i) w.step({WandStick{0, {0.0, 1.0}}});
    EXPECT_NEAR(w.scene.scale, w.settings.most_scale, 1e-9);
}

TEST(Wands, ResetBringsTheSceneHomeEvenWhileHeld) {
    Wands w;
    w.settings.home_world_from_scene = {{0.0, 1.0, 0.0}, {1, 0, 0, 0}, 1.0};
    w.step({at(0, {0.1, 1.0, 0.5}), WandClick{0, 0, true}});
    w.step({at(0, {0.4, 1.0, 0.5})});
    w.step({WandClick{0, 3, true}, at(0, {0.5, 1.0, 0.5})});
    EXPECT_TRUE(identical(w.scene, w.settings.home_world_from_scene));
    w.step({at(0, {0.6, 1.0, 0.5})});
    EXPECT_NEAR(w.scene.position_m.x, 0.1, 1e-12);
}

TEST(Wands, OthersThanTheFirstTwoMoveNothing) {
    Wands w;
    const Similarity before = w.scene;
    w.step({at(5, {0.1, 1.0, 0.5}), WandClick{5, 0, true}, WandStick{5, {1.0, 1.0}}});
    w.step({at(5, {0.4, 1.0, 0.5})});
    EXPECT_TRUE(identical(w.scene, before));
}

}  // namespace burin::session
