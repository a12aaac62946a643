// SPDX-License-Identifier: MIT
#include "activities/grasp/grasp.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "haptics/tick_parameters.hpp"
#include "tests/activities/acted_hand.hpp"

namespace burin::activities {

TEST(HandReading, KnowsWhereTheHandIsByItsThumb) {
    ActedHand acted;
    acted.bend(devices::GripShape::pinch, 0.4);
    const Pose palm{{-0.1, 0.05, 0.2}, glm::normalize(Quat(0.1, 0.6, -0.2, 0.7))};
    acted.move_to(palm);
    std::array<haptics::TickRecord, kFelt> ticks;
    for (std::size_t i = 0; i < kFelt; ++i) ticks[i] = acted.tick(i);
    const HandReading hand = reading_of({&ticks[0], &ticks[1], &ticks[2], &ticks[3]});
    EXPECT_LT(glm::length(hand.scene_from_hand.position_m - palm.position_m), 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(hand.scene_from_hand.orientation, palm.orientation)), 1.0, 1e-12);
    EXPECT_EQ(hand.bend[4], hand.bend[3]) << "the little finger follows the ring";
}

TEST(HandReading, DrawsAFingertipWhereItRestsOnTheSurface) {
    ActedHand acted;
    acted.bend(devices::GripShape::whole, 0.7);
    std::array<haptics::TickRecord, kFelt> ticks;
    for (std::size_t i = 0; i < kFelt; ++i) ticks[i] = acted.tick(i);
    HandReading hand = reading_of({&ticks[0], &ticks[1], &ticks[2], &ticks[3]});
    const devices::FingertipPlace place = devices::place_of(devices::usual_hand()[1], hand.bend[1]);
    // The index is 6 mm inside, and the surface faces the way by which it came.
    hand.fingers[1].object = kBall;
    hand.fingers[1].out_scene_m = hand.scene_from_hand.orientation * (-0.006 * place.flexes_hand);
    const geometry::HandBend drawn = drawn_bend(hand);
    const Vec3 moved =
        devices::place_of(devices::usual_hand()[1], drawn[1]).hand_from_tip.position_m - place.hand_from_tip.position_m;
    EXPECT_NEAR(glm::dot(moved, -place.flexes_hand), 0.006, 1e-4);
    EXPECT_LT(drawn[1][1], hand.bend[1][1]) << "it is opened";
    EXPECT_EQ(drawn[2], hand.bend[2]) << "a finger that touches nothing is drawn as it is read";
}

TEST(HandReading, FingersOnOneSideOfAThingHoldNothing) {
    ActedHand acted;
    hold_ball(acted);
    acted.touch(0, kBall, {0.0, 0.1, 1.0});  // the thumb beside the others, as on a table
    std::array<haptics::TickRecord, kFelt> ticks;
    for (std::size_t i = 0; i < kFelt; ++i) ticks[i] = acted.tick(i);
    const std::array<std::uint64_t, geometry::kHandFingers> none{};
    EXPECT_EQ(opposed_contacts(reading_of({&ticks[0], &ticks[1], &ticks[2], &ticks[3]})), none);
}

TEST(Grasp, G10TakesHoldWithTheFingersThatTouchAndLetsGoWhenTheyOpen) {
    Grasp activity({});
    ActedHand hand;
    hand.bend(devices::GripShape::whole, 0.7);
    EXPECT_TRUE(hand.go_on(activity, 50).holds.empty()) << "a closed hand without contact is no grasp";
    hold_ball(hand);
    const auto begun = hand.go_on(activity, 50);
    ASSERT_EQ(begun.holds.size(), 1u);
    EXPECT_EQ(begun.holds[0], (session::HoldObject{"ball", {{0, 0}, {0, 1}, {0, 2}}, true}));
    hand.move_to({{0.2, 0.2, 0.3}, glm::normalize(Quat(0.7, -0.6, 0.2, 0.1))});
    EXPECT_TRUE(hand.go_on(activity, 50).holds.empty());
    hand.touch_nothing();
    hand.bend(devices::GripShape::whole, 0.2);
    const auto ended = hand.go_on(activity, 200);
    ASSERT_EQ(ended.holds.size(), 1u);
    EXPECT_EQ(ended.holds[0], (session::HoldObject{"ball", {}, false}));
    ASSERT_EQ(activity.grasps().size(), 1u);
    EXPECT_EQ(activity.grasps()[0].gesture, geometry::Gesture::whole);
    EXPECT_GT(activity.grasps()[0].ended_ns, activity.grasps()[0].begun_ns);
}

TEST(Grasp, G10SaysThatTheGloveIsLostAndLetsGoOfWhatItHoldsAfterTheGap) {
    Grasp activity({});
    ActedHand hand;
    hold_ball(hand);
    ASSERT_EQ(hand.go_on(activity, 50).holds.size(), 1u);
    hand.be_lost(true);
    const auto lost = hand.go_on(activity, 90);
    EXPECT_TRUE(lost.messages.empty());
    EXPECT_TRUE(lost.holds.empty()) << "a gap of up to 100 ms keeps a grasp";
    const auto let_go = hand.go_on(activity, 30);
    ASSERT_FALSE(let_go.messages.empty());
    EXPECT_TRUE(let_go.messages[0].contains("the glove is lost")) << let_go.messages[0];
    ASSERT_EQ(let_go.holds.size(), 1u);
    EXPECT_EQ(let_go.holds[0], (session::HoldObject{"ball", {}, false}));
    EXPECT_TRUE(hand.go_on(activity, 500).holds.empty()) << "once";
    hand.be_lost(false);
    const auto back = hand.go_on(activity, 50);
    EXPECT_TRUE(back.messages.front().contains("the glove is back")) << back.messages.front();
    EXPECT_EQ(back.holds.size(), 1u) << "fingers that still hold take hold anew";
}

TEST(Grasp, G10AGapOfTheGloveThatIsShortKeepsWhatIsHeld) {
    Grasp activity({});
    ActedHand hand;
    hold_ball(hand);
    ASSERT_EQ(hand.go_on(activity, 50).holds.size(), 1u);
    hand.be_lost(true);
    EXPECT_TRUE(hand.go_on(activity, 70).holds.empty());
    hand.be_lost(false);
    EXPECT_TRUE(hand.go_on(activity, 200).holds.empty());
}

TEST(Grasp, SetsAFingertipThatStaysBehindAThingToTheHand) {
    Grasp activity({});
    ActedHand hand;
    hand.bend(devices::GripShape::pinch, 0.2);
    hand.touch(1, kBall, {0.0, 0.0, 1.0});
    hand.press(0.005);
    EXPECT_FALSE(hand.go_on(activity, 1000).parameters) << "a press, however long";
    hand.press(0.08);
    EXPECT_FALSE(hand.go_on(activity, 100).parameters);
    EXPECT_TRUE(hand.go_on(activity, 100).parameters);
    haptics::TickParameters index, thumb;
    activity.adjust({0, 1}, index);
    activity.adjust({0, 0}, thumb);
    EXPECT_EQ(index.placement.number, 1u);
    EXPECT_LT(glm::distance(index.placement.position_object_m, hand.tick(1).sample.position_device_m), 1e-12);
    EXPECT_EQ(thumb.placement.number, 0u);
}

// Time behind a thing is that of one stay: what it was behind before counts no more.
TEST(Grasp, SetsNoFingertipToTheHandForSeveralShortStaysBehindAThing) {
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        Grasp activity({});
        ActedHand hand;
        hand.bend(devices::GripShape::pinch, 0.2);
        hand.touch(finger, kBall, {0.0, 0.0, 1.0});
        for (int stay = 0; stay < 5; ++stay) {
            hand.press(0.08);
            EXPECT_FALSE(hand.go_on(activity, 100).parameters) << finger << ", stay " << stay;
            hand.press(0.005);
            EXPECT_FALSE(hand.go_on(activity, 100).parameters) << finger << ", after stay " << stay;
        }
        hand.press(0.08);
        EXPECT_TRUE(hand.go_on(activity, 200).parameters) << finger;
    }
}

// A finger's own fault is no loss of the glove, whichever finger it is.
TEST(Grasp, SaysThatTheGloveIsLostWhereAllFingersAreAndOfNoneAlone) {
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        Grasp activity({});
        ActedHand hand;
        hold_ball(hand);
        ASSERT_EQ(hand.go_on(activity, 50).holds.size(), 1u);
        hand.have_fault(finger, devices::DeviceFault::overspeed);
        const auto faulty = hand.go_on(activity, 500);
        EXPECT_TRUE(faulty.messages.empty()) << finger << ": " << faulty.messages.front();
        EXPECT_TRUE(faulty.holds.empty()) << finger << " holds on";
        hand.be_lost(true);
        hand.have_fault(finger, devices::DeviceFault::none);
        EXPECT_TRUE(hand.go_on(activity, 500).holds.empty()) << finger << " alone is well";
        hand.be_lost(true);
        EXPECT_EQ(hand.go_on(activity, 500).holds.size(), 1u) << "lets go";
    }
}

TEST(Grasp, SaysOfEachGraspHowFarItHasCarriedTheThing) {
    Grasp activity({});
    ActedHand hand;
    Vec3 at_m(0.1, 0.2, 0.3);
    const Quat turn = glm::normalize(Quat(0.7, -0.6, 0.2, 0.1));
    for (const double way_m : {0.25, 0.04, 0.131}) {
        hold_ball(hand);
        hand.move_to({at_m, turn});
        ASSERT_EQ(hand.go_on(activity, 50).holds.size(), 1u);
        const Vec3 way = way_m * glm::normalize(Vec3(0.3, -0.7, 0.5));
        hand.move_to({at_m += way, turn});
        hand.go_on(activity, 50);
        EXPECT_LT(glm::distance(activity.grasps().back().carried_m, way), 1e-12) << way_m;
        hand.touch_nothing();
        hand.bend(devices::GripShape::whole, 0.1);
        const auto ended = hand.go_on(activity, 200);
        ASSERT_FALSE(ended.messages.empty());
        // Fingers that open take the grip along a little.
        const long told_mm = std::lround(1e3 * glm::length(activity.grasps().back().carried_m));
        EXPECT_NEAR(static_cast<double>(told_mm), 1e3 * way_m, 50.0);
        const std::string told = "carried " + std::to_string(told_mm) + " mm";
        EXPECT_TRUE(ended.messages.back().contains(told)) << ended.messages.back();
        hand.move_to({at_m += Vec3(0.05, 0.4, -0.2), turn});  // empty
        hand.go_on(activity, 50);
    }
}

TEST(Grasp, TakesNoTable) {
    Grasp activity({});
    ActedHand hand;
    hold_ball(hand);
    for (std::size_t i = 0; i < 3; ++i) hand.touch(i, kTable, i == 0 ? Vec3(0.0, 0.0, -1.0) : Vec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(hand.go_on(activity, 50).holds.empty());
}

TEST(Grasp, G3GivesEachFingertipAPatchWhosePointsShareTheStiffnessByTheirAreas) {
    for (const unsigned points : {1u, 2u, 5u})
        for (const PatchStiffness stiffness : {PatchStiffness::shared, PatchStiffness::literal}) {
            const Grasp activity({.points = points, .stiffness = stiffness});
            for (std::size_t part = 0; part < kFelt; ++part) {
                haptics::TickParameters parameters;
                activity.adjust({0, part}, parameters);
                ASSERT_EQ(parameters.probe.count, points);
                EXPECT_EQ(parameters.probe.points[0].offset_device_m, Vec3(0.0));
                const auto patch = geometry::fingertip_patch(geometry::known_hand_model(false),
                                                             static_cast<geometry::Finger>(part), {points, 0.006});
                ASSERT_TRUE(patch);
                double flat_m = 0.0;  // pressed in by 2 mm along the middle's palmar axis, of one with the same k
                for (std::uint32_t i = 0; i < points; ++i) {
                    const haptics::ProbePoint& point = parameters.probe.points[i];
                    const double ratio = (*patch)[i].area_m2 / (*patch)[0].area_m2;
                    EXPECT_NEAR(point.share / parameters.probe.points[0].share,
                                stiffness == PatchStiffness::shared ? ratio : 1.0, 1e-12);
                    flat_m +=
                        point.share * std::max(0.0, 0.002 + (*patch)[0].place_tip_m.z - (*patch)[i].place_tip_m.z);
                    if (i == 0) continue;
                    EXPECT_GT(glm::length(point.offset_device_m), 0.0015);
                    EXPECT_LT(glm::length(point.offset_device_m), 0.009);
                }
                if (stiffness == PatchStiffness::shared) {
                    EXPECT_NEAR(flat_m, 0.002, 1e-12) << points << " points";
                }
            }
        }
}

TEST(Grasp, IsMadeAnewOfItsSettings) {
    for (const GraspOptions& options :
         {GraspOptions{}, GraspOptions{3, 4.5, PatchStiffness::literal, GloveRendering::local}}) {
        const std::string settings = Grasp(options).settings();
        const auto again = grasp_options_of(settings);
        ASSERT_TRUE(again) << settings;
        EXPECT_EQ(Grasp(*again).settings(), settings);
    }
    for (const char* wrong : {"hand", "hand --points 0 --extent 6 --mesh shared --rendering local",
                              "hand --points 5 --extent 6 --mesh soft --rendering local",
                              "hand --points 5 --extent 60 --mesh shared --rendering local",
                              "hand --points 5 --extent 6 --mesh shared --rendering both",
                              "hand --points 5 --mesh shared", "seek --points 5"})
        EXPECT_FALSE(grasp_options_of(wrong)) << wrong;
}

// The fingers that the device knows are those of the hand that is drawn, to its figures' last digit.
TEST(GloveHands, AreTheHandThatIsDrawn) {
    const geometry::HandModel& drawn = geometry::known_hand_model(false);
    for (std::size_t i = 0; i < kFelt; ++i) {
        const auto finger = static_cast<geometry::Finger>(i);
        const auto patch = geometry::fingertip_patch(drawn, finger, {.points = 1, .extent_m = 0.004});
        ASSERT_TRUE(patch);
        const Vec3 pad = patch->front().place_tip_m - 0.001 * patch->front().normal_tip;
        for (const double closed : {0.0, 0.5, 1.0}) {
            const devices::FingerAngles bent = devices::bent_in(devices::GripShape::whole, i, closed);
            const Pose tip = devices::place_of(devices::usual_hand()[i], bent).hand_from_tip;
            const Pose own = geometry::hand_from_tip(drawn, finger, bent);
            EXPECT_LT(glm::length(tip.position_m - own * pad), 1e-5) << i << " closed by " << closed;
            EXPECT_NEAR(std::abs(glm::dot(tip.orientation, own.orientation)), 1.0, 1e-6);
        }
    }
}

// The glove knows nothing of the drawn hand, whose figures its own repeat.
TEST(GloveHands, BendAsFarAsTheOneThatIsDrawn) {
    for (std::size_t i = 0; i < devices::kGloveFingers; ++i) {
        const geometry::BendLimits& drawn = geometry::limits_of(geometry::kAllFingers[i]);
        for (std::size_t joint = 0; joint < geometry::kBends; ++joint) {
            EXPECT_DOUBLE_EQ(devices::angle_limits(i).lowest[joint], drawn.lowest[joint]) << i << ' ' << joint;
            EXPECT_DOUBLE_EQ(devices::angle_limits(i).highest[joint], drawn.highest[joint]) << i << ' ' << joint;
        }
    }
}

}  // namespace burin::activities
