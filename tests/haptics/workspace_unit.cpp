// SPDX-License-Identifier: MIT
// Each workspace technique against its closed form, and every transition of the moving algorithm.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "haptics/workspace/technique.hpp"

namespace burin::haptics {
namespace {

constexpr double kTick_s = 1e-3;
constexpr std::uint32_t kButton = 2;

// A mapping with a turn and a gain, so that a frame that is mixed up shows.
Similarity turned_map() { return {{0.3, 1.1, -0.2}, glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3))), 2.5}; }

WorkspaceSettings settings_for(WorkspaceTechnique technique) {
    WorkspaceSettings settings;
    settings.technique = technique;
    settings.object_from_device = turned_map();
    return settings;
}

// A hand at the device: keeps the state from step to step.
struct Hand {
    WorkspaceSettings settings;
    WorkspaceState state;
    WorkspaceInput input;
    WorkspaceStep last;

    explicit Hand(WorkspaceTechnique technique) : settings(settings_for(technique)) {
        input.dt_s = kTick_s;
        step();
    }
    const WorkspaceStep& step() {
        last = step_workspace(state, settings, input);
        state = last.next;
        return last;
    }
    const WorkspaceStep& steps(int count) {
        for (int i = 0; i < count; ++i) step();
        return last;
    }
    // Moves there in one step, and tells its velocity.
    const WorkspaceStep& move_to(const Vec3& position) {
        input.velocity_device_m_per_s = (position - input.position_device_m) / kTick_s;
        input.position_device_m = position;
        return step();
    }
    const WorkspaceStep& press() {
        input.buttons = kButton;
        return step();
    }
    const WorkspaceStep& release() {
        input.buttons = 0;
        return step();
    }
    [[nodiscard]] Vec3 tool() const { return last.object_from_device * input.position_device_m; }
    [[nodiscard]] Vec3 middle() const { return last.object_from_device.position_m; }
};

double distance(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

bool same(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}

// Half extents along the object's axes, by the box's eight corners.
Box bounds_of(const Similarity& map, const Vec3& workspace) {
    Box bounds;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 4) != 0 ? 0.5 : -0.5);
        bounds.include(map * (sign * workspace));
    }
    return bounds;
}

bool inside(const Box& inner, const Box& outer, double slack) {
    return glm::all(glm::greaterThanEqual(inner.lo, outer.lo - slack)) &&
           glm::all(glm::lessThanEqual(inner.hi, outer.hi + slack));
}

}  // namespace

TEST(Workspace, FixedIsTheMappingOfTheSettingsEvenOutsideTheReach) {
    Hand hand(WorkspaceTechnique::fixed);
    EXPECT_TRUE(hand.last.jumped) << "it begins";
    hand.settings.reach_object = {Vec3(5.0), Vec3(6.0)};
    hand.press();
    EXPECT_FALSE(hand.last.jumped);
    EXPECT_FALSE(hand.last.paused);
    EXPECT_TRUE(same(hand.last.object_from_device, turned_map()));
}

TEST(Workspace, ScalingAmplifiesByItsGain) {
    Hand hand(WorkspaceTechnique::scaling);
    hand.settings.scaling_gain = 7.5;
    EXPECT_TRUE(hand.step().jumped) << "another gain is another mapping";
    const Vec3 p(0.04, -0.03, 0.02);
    EXPECT_FALSE(hand.move_to(p).jumped);
    const Similarity rest = turned_map();
    EXPECT_LT(distance(hand.tool(), rest.position_m + 2.5 * 7.5 * (rest.orientation * p)), 1e-14);
}

TEST(Workspace, ClutchingKeepsTheToolStillWhileTheHandReturnsAndGoesOnFromThere) {
    Hand hand(WorkspaceTechnique::clutching);
    hand.move_to({0.08, 0.05, -0.03});
    const Vec3 held = hand.tool();
    EXPECT_TRUE(hand.press().paused);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::clutched);
    for (int i = 0; i < 200; ++i) {
        hand.move_to(Vec3(0.08 - 0.0007 * i, 0.05 - 0.0005 * i, -0.03 + 0.0003 * i));
        ASSERT_LT(distance(hand.tool(), held), 1e-14);
        ASSERT_FALSE(hand.last.jumped);
    }
    EXPECT_FALSE(hand.release().paused);
    EXPECT_FALSE(hand.last.jumped);
    EXPECT_LT(distance(hand.tool(), held), 1e-14);
    const Vec3 step(0.01, 0.0, 0.0);
    hand.move_to(hand.input.position_device_m + step);
    EXPECT_LT(distance(hand.tool(), held + apply_to_vector(turned_map(), step)), 1e-14) << "as much as the hand";
    EXPECT_EQ(hand.state.presses, 1u);
}

TEST(Workspace, BubbleGlidesAndPushesByItsLaw) {
    Hand hand(WorkspaceTechnique::bubble);
    hand.settings.max_acceleration_m_per_s2 = 1e6;  // the law alone
    const double k = hand.settings.bubble_rate_per_m2s, s = hand.settings.bubble_stiffness_N_per_m;
    const double radius = hand.settings.bubble_radius_m;
    for (const double beyond : {0.002, 0.005, 0.012, 0.02}) {
        const Vec3 way = glm::normalize(Vec3(2, -1, 1));
        hand.move_to((radius + beyond) * way);
        const Vec3 before = hand.middle();
        hand.step();
        const Vec3 speed = glm::conjugate(turned_map().orientation) * ((hand.middle() - before) / (kTick_s * 2.5));
        EXPECT_LT(distance(speed, k * beyond * beyond * beyond * way), 1e-12) << beyond;
        EXPECT_LT(distance(hand.last.force_device_N, -s * beyond * way), 1e-12);
        EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::gliding);
        EXPECT_FALSE(hand.last.paused);
    }
    EXPECT_DOUBLE_EQ(hand.last.picture.bubble_radius_object_m, 2.5 * radius);
}

TEST(Workspace, BubbleIsPositionControlWithin) {
    Hand hand(WorkspaceTechnique::bubble);
    hand.move_to(0.9999 * hand.settings.bubble_radius_m * glm::normalize(Vec3(1, 1, -1)));
    hand.steps(100);
    EXPECT_TRUE(same(hand.last.object_from_device, turned_map()));
    EXPECT_EQ(hand.last.force_device_N, Vec3(0.0));
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::editing);
}

TEST(Workspace, AMappingThatMovesStopsInContactAndSetsOutGentlyAfterwards) {
    for (const auto technique : {WorkspaceTechnique::bubble, WorkspaceTechnique::drift}) {
        Hand hand(technique);
        hand.input.position_device_m = {0.07, 0.0, 0.0};
        hand.input.velocity_device_m_per_s = {0.0, 2.0, 0.0};
        hand.steps(2000);
        EXPECT_GT(glm::length(hand.state.glide_device_m_per_s), 0.2) << text(technique);
        hand.input.in_contact = true;
        const Vec3 before = hand.middle();
        hand.steps(50);
        EXPECT_EQ(hand.middle(), before) << "nothing is pushed into what it touches";
        hand.input.in_contact = false;
        hand.steps(10);
        // From rest with the acceleration a: a t^2 / 2, in steps a little more.
        const double most = 0.5 * hand.settings.max_acceleration_m_per_s2 * 0.01 * 0.011 * 2.5;
        EXPECT_GT(distance(hand.middle(), before), 0.0);
        EXPECT_LE(distance(hand.middle(), before), most + 1e-12);
        hand.input.in_contact = true;
        hand.settings.max_speed_in_contact_m_per_s = 0.02;
        const Vec3 then = hand.middle();
        hand.steps(100);
        EXPECT_LE(distance(hand.middle(), then), 0.02 * 0.1 * 2.5 + 1e-12) << "as fast as the settings let it";
    }
}

TEST(Workspace, DriftIsAShareOfTheHandsOwnMotion) {
    Hand hand(WorkspaceTechnique::drift);
    hand.settings.max_acceleration_m_per_s2 = 1e6;
    const double ratio = hand.settings.drift_ratio;
    hand.input.position_device_m = {0.25 * hand.settings.workspace_device_m.x, 0.0, 0.0};  // half-way out
    hand.step();
    hand.input.velocity_device_m_per_s = {0.0, 0.12, 0.16};
    const Vec3 before = hand.middle();
    hand.steps(100);
    const Vec3 moved = glm::conjugate(turned_map().orientation) * (hand.middle() - before);
    EXPECT_LT(distance(moved, Vec3(2.5 * ratio * 0.5 * 0.2 * 0.1, 0, 0)), 1e-12);
    hand.input.velocity_device_m_per_s = Vec3(0.0);
    const Vec3 rested = hand.middle();
    hand.steps(100);
    EXPECT_EQ(hand.middle(), rested) << "a hand at rest drifts nowhere";
}

TEST(Workspace, DriftBringsTheHandBackToTheMiddle) {
    Hand hand(WorkspaceTechnique::drift);
    // The tool works to and fro about one place of the scene; the hand is wherever that takes it.
    const Vec3 place = hand.last.object_from_device * Vec3(0.07, 0.0, 0.0);
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 wanted = place + Vec3(0.0, 0.05 * std::sin(0.012 * i), 0.0);
        hand.move_to(inverse(hand.last.object_from_device) * wanted);
    }
    const Vec3 at = inverse(hand.last.object_from_device) * place;
    EXPECT_LT(glm::length(at), 0.01) << "from 70 mm";
}

TEST(Workspace, MovingGoesThroughItsPhasesByTheTable) {
    Hand hand(WorkspaceTechnique::moving);
    const Vec3 corner = 0.5 * hand.settings.workspace_device_m * Vec3(1.0, -1.0, 0.2);
    hand.move_to(corner);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::editing);
    EXPECT_FALSE(hand.last.paused);
    EXPECT_FALSE(hand.last.picture.proposed_visible);

    // editing, down -> paused: a box around the tool, the workspace where it was
    const Vec3 tool = hand.tool();
    hand.press();
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::paused);
    EXPECT_TRUE(hand.last.paused);
    EXPECT_TRUE(hand.last.picture.proposed_visible);
    EXPECT_EQ(hand.last.picture.proposed_center_object_m, tool);
    EXPECT_TRUE(same(hand.last.object_from_device, turned_map()));

    // paused, up -> jumping: the workspace is where the box was, the tool at its border as before
    hand.steps(100);
    hand.release();
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::jumping);
    EXPECT_TRUE(hand.last.jumped);
    EXPECT_TRUE(hand.last.paused);
    EXPECT_FALSE(hand.last.picture.proposed_visible);
    EXPECT_EQ(hand.middle(), tool);
    EXPECT_LT(distance(hand.tool(), tool + apply_to_vector(turned_map(), corner)), 1e-14);

    // jumping, down -> paused
    hand.steps(50);
    EXPECT_EQ(hand.press().picture.phase, WorkspacePhase::paused);
    EXPECT_FALSE(hand.last.jumped);

    // paused, held -> dragging, and it stays so while it is held
    const int tap = static_cast<int>(std::lround(hand.settings.tap_s / kTick_s));
    hand.steps(tap - 1);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::paused);
    hand.steps(2);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::dragging);
    hand.steps(1000);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::dragging);
    EXPECT_TRUE(hand.last.paused);
    EXPECT_LT(distance(hand.last.picture.proposed_center_object_m, hand.tool()), 1e-14);

    // dragging, up -> jumping, then nothing for series_s -> editing
    const Vec3 dragged = hand.tool();
    hand.release();
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::jumping);
    EXPECT_TRUE(hand.last.jumped);
    EXPECT_LT(distance(hand.middle(), dragged), 0.01) << "one tick of dragging at most";
    const int series = static_cast<int>(std::lround(hand.settings.series_s / kTick_s));
    hand.steps(series - 1);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::jumping);
    hand.steps(2);
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::editing);
    EXPECT_FALSE(hand.last.paused);
    EXPECT_EQ(hand.state.presses, 2u);
}

TEST(Workspace, RepeatedPressesJumpOnInTheToolsDirectionByEqualSteps) {
    Hand hand(WorkspaceTechnique::moving);
    const Vec3 edge(0.0813, 0.02, 0.0);
    hand.move_to(edge);
    for (int press = 1; press <= 12; ++press) {
        hand.press();
        hand.steps(90);
        hand.release();
        const Vec3 expected = turned_map().position_m + apply_to_vector(turned_map(), press * 1.0 * edge);
        EXPECT_LT(distance(hand.middle(), expected), 1e-12) << press;
        hand.steps(90);
        EXPECT_TRUE(hand.last.paused) << "modelling waits until the series is over";
    }
}

TEST(Workspace, ADragGoesAfterTheToolNeverJumpingAndNoFasterThanItMay) {
    Hand hand(WorkspaceTechnique::moving);
    hand.settings.max_speed_m_per_s = 0.3;
    hand.press();
    hand.steps(400);
    hand.move_to({0.04, 0.0, 0.0});
    hand.steps(500);
    const Vec3 before = hand.middle();
    hand.steps(100);
    const Vec3 way = turned_map().orientation * Vec3(1, 0, 0);
    EXPECT_LT(distance(hand.middle() - before, 2.5 * 0.1 * 5.0 * 0.04 * way), 1e-12) << "rate times offset";
    hand.move_to({0.081, 0.0, 0.0});
    hand.steps(500);
    const Vec3 then = hand.middle();
    hand.steps(100);
    EXPECT_LT(distance(hand.middle() - then, 2.5 * 0.1 * 0.3 * way), 1e-12) << "the top speed";
    hand.move_to(Vec3(0.0));
    const Vec3 stopped = hand.middle();
    hand.steps(100);
    EXPECT_EQ(hand.middle(), stopped);
    hand.release();
    EXPECT_EQ(hand.middle(), stopped) << "from the middle the release moves nothing";
}

TEST(Workspace, StaysWithinTheReachAndProposesNoOtherPlace) {
    for (const auto technique :
         {WorkspaceTechnique::moving, WorkspaceTechnique::bubble, WorkspaceTechnique::clutching}) {
        Hand hand(technique);
        const Box reach{Vec3(-0.2, 0.6, -0.8), Vec3(0.9, 1.7, 0.4)};
        hand.settings.reach_object = reach;
        const Vec3 edge(0.08, 0.06, 0.03);
        for (int round = 0; round < 40; ++round) {
            hand.move_to(edge);
            hand.steps(20);
            hand.press();
            if (technique == WorkspaceTechnique::clutching) hand.move_to(-edge);
            hand.steps(20);
            const Vec3 proposed = hand.last.picture.proposed_center_object_m;
            hand.release();
            if (technique == WorkspaceTechnique::moving) {
                ASSERT_EQ(hand.middle(), proposed);
            }
            ASSERT_TRUE(
                inside(bounds_of(hand.last.object_from_device, hand.settings.workspace_device_m), reach, 1e-12));
        }
        EXPECT_FALSE(hand.step().jumped);
        hand.settings.reach_object = {reach.lo + 3.0, reach.hi + 3.0};
        EXPECT_TRUE(hand.step().jumped) << "a reach that changes moves the workspace, and says so";
        EXPECT_FALSE(hand.step().jumped);
    }
}

TEST(Workspace, AWorkspaceLargerThanItsReachLiesInItsMiddle) {
    Hand hand(WorkspaceTechnique::scaling);
    hand.settings.scaling_gain = 100.0;
    hand.settings.reach_object = {Vec3(-1, -2, -3), Vec3(3, 2, 5)};
    EXPECT_EQ((hand.step(), hand.middle()), Vec3(1, 0, 1));
}

TEST(Workspace, AChangeOfTheSettingsStartsAnewAndSaysSo) {
    Hand hand(WorkspaceTechnique::moving);
    hand.move_to({0.08, 0.0, 0.0});
    hand.press();
    hand.release();
    EXPECT_FALSE(same(hand.last.object_from_device, turned_map()));
    hand.settings.object_from_device.position_m.x += 0.1;
    EXPECT_TRUE(hand.step().jumped);
    EXPECT_TRUE(same(hand.last.object_from_device, hand.settings.object_from_device));
    EXPECT_EQ(hand.last.picture.phase, WorkspacePhase::editing);
    EXPECT_EQ(hand.state.presses, 0u);

    hand.press();
    hand.settings.technique = WorkspaceTechnique::clutching;
    EXPECT_TRUE(hand.step().jumped);
    EXPECT_FALSE(hand.last.paused) << "a press for the technique before is none for this one";
    hand.release();
    EXPECT_TRUE(hand.press().paused);

    hand.settings.bubble_radius_m *= 2.0;
    hand.settings.tap_s *= 2.0;
    EXPECT_FALSE(hand.step().jumped) << "what the mapping does not depend on disturbs nothing";
}

TEST(Workspace, OtherButtonsMoveNothing) {
    for (const auto technique : {WorkspaceTechnique::moving, WorkspaceTechnique::clutching}) {
        Hand hand(technique);
        hand.move_to({0.08, 0.0, 0.0});
        hand.input.buttons = ~kButton;
        hand.steps(1000);
        EXPECT_TRUE(same(hand.last.object_from_device, turned_map()));
        EXPECT_FALSE(hand.last.paused);
    }
}

TEST(Workspace, RefusesSettingsThatMakeNoSense) {
    const WorkspaceSettings good = settings_for(WorkspaceTechnique::bubble);
    EXPECT_TRUE(settings_are_sensible(good));
    EXPECT_TRUE(settings_are_sensible(WorkspaceSettings{}));
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const std::vector<double WorkspaceSettings::*> numbers{&WorkspaceSettings::tap_s,
                                                           &WorkspaceSettings::series_s,
                                                           &WorkspaceSettings::drag_rate_per_s,
                                                           &WorkspaceSettings::scaling_gain,
                                                           &WorkspaceSettings::bubble_radius_m,
                                                           &WorkspaceSettings::bubble_stiffness_N_per_m,
                                                           &WorkspaceSettings::bubble_rate_per_m2s,
                                                           &WorkspaceSettings::drift_ratio,
                                                           &WorkspaceSettings::max_speed_m_per_s,
                                                           &WorkspaceSettings::max_speed_in_contact_m_per_s,
                                                           &WorkspaceSettings::max_acceleration_m_per_s2};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        for (const double bad : {nan, inf, -1e-9}) {
            WorkspaceSettings settings = good;
            settings.*numbers[i] = bad;
            EXPECT_FALSE(settings_are_sensible(settings)) << i << " " << bad;
        }
    }
    const auto with = [&](auto change) {
        WorkspaceSettings settings = good;
        change(settings);
        return settings_are_sensible(settings);
    };
    EXPECT_FALSE(with([&](auto& s) { s.object_from_device.position_m.z = nan; }));
    EXPECT_FALSE(with([&](auto& s) { s.object_from_device.scale = 0.0; }));
    EXPECT_FALSE(with([&](auto& s) { s.object_from_device.orientation.w += 0.1; }));
    EXPECT_FALSE(with([&](auto& s) { s.workspace_device_m.y = -0.1; }));
    EXPECT_FALSE(with([&](auto& s) { s.reach_object = {Vec3(nan), Vec3(1.0)}; }));
    EXPECT_FALSE(with([&](auto& s) { s.reach_object = {Vec3(0.0), Vec3(inf)}; }));
    EXPECT_FALSE(with([&](auto& s) { s.drift_ratio = 1.0; })) << "the tool would go against the hand";
    EXPECT_FALSE(with([&](auto& s) { s.technique = static_cast<WorkspaceTechnique>(99); }));
    EXPECT_TRUE(with([&](auto& s) { s.workspace_device_m = Vec3(0.0); })) << "a device without depth is one";
}

TEST(Workspace, HasANameForEveryTechniqueAndPhase) {
    for (int i = 0; i <= static_cast<int>(WorkspaceTechnique::drift); ++i)
        EXPECT_STRNE(text(static_cast<WorkspaceTechnique>(i)), "unknown");
    for (int i = 0; i <= static_cast<int>(WorkspacePhase::gliding); ++i)
        EXPECT_STRNE(text(static_cast<WorkspacePhase>(i)), "unknown");
}

TEST(Workspace, InACornerOfTheWorkspaceItDriftsNoFasterThanAtItsEdge) {
    Hand hand(WorkspaceTechnique::drift);
    hand.settings.max_acceleration_m_per_s2 = 1e6;
    hand.input.position_device_m = 0.5 * hand.settings.workspace_device_m;
    hand.step();
    hand.input.velocity_device_m_per_s = {0.0, 0.12, 0.16};
    const Vec3 before = hand.middle();
    hand.steps(100);
    const double drifted_m = glm::length(hand.middle() - before);
    EXPECT_NEAR(drifted_m, 2.5 * hand.settings.drift_ratio * 0.2 * 0.1, 1e-12);
}

TEST(Workspace, ASecondDragSetsOutFromRest) {
    Hand hand(WorkspaceTechnique::moving);
    hand.press();
    hand.steps(400);
    hand.move_to({0.04, 0.0, 0.0});
    hand.steps(500);  // at 0.2 m/s by now
    hand.release();
    hand.press();
    while (hand.last.picture.phase != WorkspacePhase::dragging) hand.step();
    const Vec3 before = hand.middle();
    hand.step();
    // Two ticks of the greatest acceleration, at most, and the way that they make in one.
    const double most_m = hand.settings.max_acceleration_m_per_s2 * 2.0 * kTick_s * kTick_s;
    EXPECT_LE(glm::length(hand.middle() - before), 2.5 * most_m * (1.0 + 1e-9));
}

}  // namespace burin::haptics
