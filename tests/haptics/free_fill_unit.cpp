// SPDX-License-Identifier: MIT
// Material that a tool adds in free flight: the tool goes where the hand goes, is not held up by what it has just
// added, and touches again when it has come out of that.
#include <gtest/gtest.h>

#include "tests/haptics/ticked_hand.hpp"

namespace burin::haptics {
namespace {

constexpr double kToolRadius_m = 0.004;

struct Filling : test::TickedHand {
    bool pressed = false;

    explicit Filling(const geometry::LocalSurface& around, FillPlace fills) : TickedHand{around, {}} {
        parameters.probe.points[0].radius_m = kToolRadius_m;
        parameters.limit_stiffness = false;
        parameters.max_surface_age_s = 0.0;
        parameters.action = ToolAction::fill;
        parameters.fills = fills;
    }
    const TickRecord& at(const Vec3& hand_m) {
        now_ns += 1'000'000;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = hand_m;
        sample.buttons = pressed ? 1u : 0u;
        const FullTick full = full_tick(state, sample, surface, parameters, test::kStrongDevice, now_ns, 1e-3);
        state = full.next;
        return record = full.record;
    }
    void show(const geometry::LocalSurface& next) {
        const std::uint64_t sequence = surface.sequence + 1;
        surface = next;
        surface.sequence = sequence;
    }
    [[nodiscard]] bool is_with_hand() const {
        return record.contact.points[0].proxy_object_m == record.contact.points[0].hip_object_m &&
               record.gate.given.force_device_N == Vec3(0.0) && !record.in_contact();
    }
};

// What a stroke through the origin along +X has left behind: a bar as thick as the tool.
test::Surface bead() {
    return test::box({-0.03, -kToolRadius_m, -kToolRadius_m}, {0.03, kToolRadius_m, kToolRadius_m}, 8);
}

}  // namespace

TEST(FreeFill, GoesWithTheHandThroughWhatItHasJustAdded) {
    const test::Surface floor = test::plane(), added = bead();
    for (const FillPlace fills : {FillPlace::begun, FillPlace::hand}) {
        Filling hand(*floor, fills);
        for (int i = 0; i < 20; ++i) hand.at({-0.02, 0.05, 0.0});
        hand.pressed = true;
        hand.at({-0.02, 0.05, 0.0});
        hand.show(*added);
        for (int i = 0; i <= 400; ++i) {
            const double t = i / 400.0;
            hand.at({-0.02 + 0.04 * t, 0.05 * (1.0 - t) * (1.0 - t), 0.0});
            ASSERT_TRUE(hand.is_with_hand()) << i;
        }
    }
}

TEST(FreeFill, TouchesAgainWhereItHasComeOutOfTheMaterial) {
    const test::Surface floor = test::plane(), added = bead();
    Filling hand(*floor, FillPlace::begun);
    hand.at({0.0, 0.05, 0.0});
    hand.pressed = true;
    hand.at({0.0, 0.05, 0.0});
    for (int i = 50; i >= 0; --i) hand.at({0.0, 0.001 * i, 0.0});
    hand.show(*added);
    hand.pressed = false;
    for (int i = 0; i < 200; ++i) {
        if (i % 20 == 10) hand.show(*added);
        hand.at(Vec3(0.0));
        ASSERT_TRUE(hand.is_with_hand()) << "the tool lies in its bead, tick " << i;
    }
    for (int i = 0; i <= 1000; ++i) {  // upwards, out of it
        hand.at({0.0, 2e-5 * i, 0.0});
        ASSERT_LT(glm::length(hand.record.gate.given.force_device_N), 1e-9) << i;
    }
    for (int i = 1000; i >= 0; --i) hand.at({0.0, 2e-5 * i, 0.0});  // and down onto it
    EXPECT_TRUE(hand.record.in_contact());
    EXPECT_GT(hand.record.gate.given.force_device_N.y, 0.5);
}

// The update that was on its way when the button came up lacks the end of the stroke: the tool would be caught in it.
TEST(FreeFill, WaitsForTheSurfaceThatHoldsAllOfTheStroke) {
    const test::Surface floor = test::plane(), added = bead();
    Filling hand(*floor, FillPlace::begun);
    hand.at({0.0, 0.02, 0.0});
    hand.pressed = true;
    for (int i = 0; i < 50; ++i) hand.at({0.0, 0.02, 0.0});
    hand.pressed = false;
    hand.at({0.0, 0.02, 0.0});
    hand.show(*floor);
    for (int i = 0; i < 20; ++i) hand.at(Vec3(0.0, 0.02 - 0.001 * i, 0.0));
    hand.show(*added);
    for (int i = 0; i < 50; ++i) {
        hand.at(Vec3(0.0));
        ASSERT_TRUE(hand.is_with_hand()) << i;
    }
}

TEST(FreeFill, IsOnlyWhereTheStrokeBeganInTheAir) {
    const test::Surface floor = test::plane();
    const auto pressed = [&](FillPlace fills) {
        Filling hand(*floor, fills);
        for (int i = 0; i < 200; ++i) hand.at({0.0, 0.005 - 1e-5 * i, 0.0});
        hand.pressed = true;
        std::vector<Vec3> given;
        for (int i = 0; i < 200; ++i) given.push_back(hand.at({1e-5 * i, 0.003, 0.0}).gate.given.force_device_N);
        return given;
    };
    const std::vector<Vec3> on_surface = pressed(FillPlace::surface), begun = pressed(FillPlace::begun);
    EXPECT_EQ(begun, on_surface);
    EXPECT_GT(on_surface.back().y, 0.3);
    EXPECT_EQ(pressed(FillPlace::hand).back(), Vec3(0.0));
}

// A hand that feels nothing and takes up a knife within its bead cuts at once.
TEST(FreeFill, EndsForAHandWithoutForceWhenAnotherToolWorks) {
    const test::Surface floor = test::plane(), added = bead();
    Filling hand(*floor, FillPlace::hand);
    hand.pressed = true;
    for (int i = 0; i < 20; ++i) hand.at(Vec3(0.0, 0.01, 0.0));
    hand.show(*added);
    hand.at(Vec3(0.0));
    hand.pressed = false;
    hand.at(Vec3(0.0));
    EXPECT_TRUE(hand.is_with_hand());
    hand.parameters.action = ToolAction::touch;
    hand.pressed = true;
    hand.at(Vec3(0.0));
    EXPECT_FALSE(hand.state.tick.free_fill.lasts);
}

}  // namespace burin::haptics
