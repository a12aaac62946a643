// SPDX-License-Identifier: MIT
// The views of a tick's record: each field of the record has a value of its own, so that none can stand for another.
#include "haptics/channels.hpp"

#include <gtest/gtest.h>

namespace burin::haptics {
namespace {

TickRecord distinct_record() {
    TickRecord r;
    r.tick = 11;
    r.time_ns = 12;
    r.surface_sequence = 13;
    r.parameter_sequence = 14;
    r.sample.position_device_m = {1.0, 2.0, 3.0};
    r.sample.buttons = 5;
    r.flags = kTickCutting | kTickLate;
    r.motion.orientation_object = glm::normalize(Quat(0.5, 0.1, 0.7, 0.3));
    // A quarter turn about z: x becomes y.
    r.motion.object_from_device.orientation = glm::normalize(Quat(1.0, 0.0, 0.0, 1.0));
    r.motion.workspace.phase = WorkspacePhase::dragging;
    r.motion.workspace.bubble_radius_object_m = 0.25;
    r.contact.point_count = 2;
    r.contact.deepest = 1;
    r.contact.points[0].hip_object_m = {4.0, 0.0, 0.0};
    r.contact.points[0].proxy_object_m = {5.0, 0.0, 0.0};
    r.contact.points[0].normal_object = {1.0, 0.0, 0.0};
    r.contact.points[1].hip_object_m = {6.0, 0.0, 0.0};
    r.contact.points[1].proxy_object_m = {7.0, 0.0, 0.0};
    r.contact.points[1].normal_object = {0.0, 1.0, 0.0};
    r.contact.points[2].proxy_object_m = {99.0, 0.0, 0.0};  // beyond the probe's points
    r.contact.points[1].object = 17;
    r.contact.points[1].asked = {1200.0, 0.5};
    r.contact.points[1].rendered = {857.5, 0.1};
    r.passivity.share = 0.75;
    r.contact.cut_object_m = {8.0, 0.0, 0.0};
    r.contact.stiffness_bound = StiffnessBound::quantisation;
    r.wanted.force_device_N = {9.0, 0.0, 0.0};
    r.gate.given = {{2.0, 0.0, 0.0}, {0.0, 0.0, 0.1}};
    r.gate.cause = GateCause::overspeed;
    return r;
}

TEST(RecordViews, TheFrameIsToldTheDeepestPointAndWhatTheHandFeels) {
    const TickRecord r = distinct_record();
    const ToolState t = tool_of(r, 15, 16);
    EXPECT_EQ(t.tick, 11u);
    EXPECT_EQ(t.time_ns, 12);
    EXPECT_EQ(t.hip_object_m, Vec3(6.0, 0.0, 0.0));
    EXPECT_EQ(t.proxy_object_m, Vec3(7.0, 0.0, 0.0));
    EXPECT_EQ(t.contact_normal_object, Vec3(0.0, 1.0, 0.0));
    EXPECT_EQ(t.orientation_object, r.motion.orientation_object);
    EXPECT_EQ(t.position_device_m, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(t.given.force_device_N, Vec3(2.0, 0.0, 0.0));
    EXPECT_EQ(t.given.torque_device_Nm, Vec3(0.0, 0.0, 0.1));
    ASSERT_EQ(t.point_count, 2u);
    EXPECT_EQ(t.proxies_object_m[0], Vec3(5.0, 0.0, 0.0));
    EXPECT_EQ(t.proxies_object_m[1], Vec3(7.0, 0.0, 0.0));
    EXPECT_EQ(t.proxies_object_m[2], Vec3(0.0));
    EXPECT_EQ(t.workspace.phase, WorkspacePhase::dragging);
    EXPECT_EQ(t.workspace.bubble_radius_object_m, 0.25);
    EXPECT_EQ(t.stiffness_bound, StiffnessBound::quantisation);
    EXPECT_EQ(t.object, 17u);
    EXPECT_EQ(t.asked.stiffness_N_per_m, 1200.0);
    EXPECT_EQ(t.rendered.stiffness_N_per_m, 857.5);
    EXPECT_EQ(t.rendered.damping_Ns_per_m, 0.1);
    EXPECT_EQ(t.energy_share, 0.75);
    EXPECT_EQ(t.buttons, 5u);
    EXPECT_EQ(t.flags, r.flags);
    EXPECT_EQ(t.cause, GateCause::overspeed);
    EXPECT_EQ(t.late_ticks, 15u);
    EXPECT_EQ(t.dropped_samples, 16u);
}

}  // namespace
}  // namespace burin::haptics
