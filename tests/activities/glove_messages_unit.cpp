// SPDX-License-Identifier: MIT
// What a session says of a glove's fingers that have a fault of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/activities/acted_hand.hpp"

namespace burin::activities {

TEST(GloveMessages, NameTheJointThatReadsWhatNoneCanBeAndItsAngle) {
    Grasp grasp{GraspOptions{}};
    ActedHand hand;
    EXPECT_TRUE(hand.go_on(grasp, 50).messages.empty());
    // The fault comes with a set; the finger comes to what that says on the way.
    hand.have_fault(1, devices::DeviceFault::false_reading);
    EXPECT_TRUE(hand.go_on(grasp, 3).messages.empty());
    hand.bend_joint(1, 2, -1.5707963);
    const auto told = hand.go_on(grasp, 200).messages;
    ASSERT_EQ(told.size(), 1u) << "it is said once";
    EXPECT_TRUE(told[0].contains("the index finger's middle joint reads -90 degrees")) << told[0];
    hand.have_fault(1, devices::DeviceFault::none);
    hand.bend_joint(1, 2, 0.3);
    EXPECT_TRUE(hand.go_on(grasp, 50).messages.empty());
    hand.have_fault(1, devices::DeviceFault::false_reading);
    hand.bend_joint(1, 2, 3.1415926);
    EXPECT_EQ(hand.go_on(grasp, 50).messages.size(), 1u) << "it has become wrong again";
}

TEST(GloveMessages, TellHowManySetsWereLeftOutEverMoreSeldom) {
    Grasp grasp{GraspOptions{}};
    ActedHand hand;
    hand.leave_out_sets(true);
    EXPECT_TRUE(hand.go_on(grasp, 9).messages.empty());
    const auto tenth = hand.go_on(grasp, 1).messages;
    ASSERT_EQ(tenth.size(), 1u);
    EXPECT_TRUE(tenth[0].starts_with("10 of the glove's sets were left out")) << tenth[0];
    EXPECT_TRUE(hand.go_on(grasp, 89).messages.empty());
    EXPECT_EQ(hand.go_on(grasp, 1).messages.size(), 1u);
    hand.leave_out_sets(false);
    EXPECT_TRUE(hand.go_on(grasp, 50).messages.empty());
    EXPECT_EQ(grasp.rejected_sets(), 100u);
}

}  // namespace burin::activities
