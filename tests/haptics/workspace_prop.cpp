// SPDX-License-Identifier: MIT
// Whatever a hand does: the tool moves continuously but where a jump is told, and all stays finite and within reach.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "haptics/workspace/technique.hpp"

namespace burin::haptics {
namespace {

double between(int lo, int hi, double unit) { return *rc::gen::inRange(lo, hi + 1) * unit; }

Vec3 any_position() {
    const double x = between(-90, 90, 1e-3), y = between(-70, 70, 1e-3), z = between(-40, 40, 1e-3);
    return {x, y, z};
}

WorkspaceSettings any_settings() {
    WorkspaceSettings s;
    s.technique = static_cast<WorkspaceTechnique>(*rc::gen::inRange(0, 6));
    const Vec3 axis = any_position() + Vec3(0.0, 0.0, 1.0);
    s.object_from_device = {any_position() * 10.0, glm::angleAxis(between(0, 600, 0.01), glm::normalize(axis)),
                            between(1, 300, 0.1)};
    if (*rc::gen::arbitrary<bool>()) {
        const Vec3 middle = any_position() * 20.0;
        const Vec3 half = glm::abs(any_position()) * 20.0;
        s.reach_object = {middle - half, middle + half};
    }
    s.scaling_gain = between(1, 200, 0.1);
    s.tap_s = between(0, 50, 1e-3);
    s.series_s = between(0, 50, 1e-3);
    s.drag_rate_per_s = between(0, 50, 1.0);
    s.max_speed_m_per_s = between(0, 20, 0.1);
    s.max_speed_in_contact_m_per_s = between(0, 3, 0.02);
    s.bubble_radius_m = between(0, 60, 1e-3);
    return s;
}

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

bool finite(const WorkspaceStep& s) {
    const Vec3 all = s.object_from_device.position_m + s.force_device_N + s.picture.proposed_center_object_m +
                     s.next.glide_device_m_per_s + s.next.anchor_object_m;
    return std::isfinite(length(all)) && std::isfinite(s.object_from_device.scale) && std::isfinite(s.next.phase_s);
}

bool within_reach(const WorkspaceStep& step, const WorkspaceSettings& s) {
    if (s.reach_object.empty() || s.technique == WorkspaceTechnique::fixed) return true;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 4) != 0 ? 0.5 : -0.5);
        const Vec3 p = step.object_from_device * (sign * s.workspace_device_m);
        const Vec3 opposite = step.object_from_device * (-sign * s.workspace_device_m);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::max(p[axis], opposite[axis]) <= s.reach_object.hi[axis] + 1e-9 &&
                std::min(p[axis], opposite[axis]) >= s.reach_object.lo[axis] - 1e-9)
                continue;
            // Too long to fit along this axis: then it lies in the middle.
            if (std::abs(step.object_from_device.position_m[axis] - s.reach_object.center()[axis]) > 1e-9) return false;
        }
    }
    return true;
}

// The tool moves with the hand, with the mapping as fast as that may move, and not at all otherwise. A clutched hand
// moves the mapping against itself, so the tool by no more than the hand moves, and at the reach's border likewise.
double most_motion_m(const WorkspaceSettings& s, double scale, double hand_m, bool in_contact, double dt_s) {
    const double top = in_contact ? s.max_speed_in_contact_m_per_s : s.max_speed_m_per_s;
    const bool moves_by_itself = s.technique == WorkspaceTechnique::moving ||
                                 s.technique == WorkspaceTechnique::bubble || s.technique == WorkspaceTechnique::drift;
    return scale * (hand_m + (moves_by_itself ? top * dt_s : 0.0)) * (1.0 + 1e-9) + 1e-9;
}

}  // namespace

TEST(Workspace, TheToolMovesContinuouslyButWhereAJumpIsTold) {
    EXPECT_TRUE(rc::check([] {
        WorkspaceSettings settings = any_settings();
        WorkspaceState state;
        WorkspaceInput input;
        input.dt_s = 1e-3;
        input.position_device_m = any_position();
        Vec3 tool{0.0};
        for (int i = 0; i < 150; ++i) {
            const Vec3 before = input.position_device_m;
            if (*rc::gen::inRange(0, 3) == 0) input.position_device_m += 0.05 * any_position();
            input.velocity_device_m_per_s = any_position() * 10.0;
            if (*rc::gen::inRange(0, 8) == 0) input.buttons ^= 2u;
            if (*rc::gen::inRange(0, 12) == 0) input.in_contact = !input.in_contact;
            const bool changed = *rc::gen::inRange(0, 40) == 0;
            if (changed) settings = any_settings();
            RC_PRE(settings_are_sensible(settings));
            const WorkspaceStep step = step_workspace(state, settings, input);
            const Vec3 now = step.object_from_device * input.position_device_m;
            RC_ASSERT(finite(step));
            RC_ASSERT(within_reach(step, settings));
            RC_ASSERT(i > 0 || step.jumped);
            const double scale = step.object_from_device.scale;
            const double hand_m = length(input.position_device_m - before);
            // Clutched and clamped on some axes only, the tool moves by parts of the hand's motion.
            if (!step.jumped) {
                RC_ASSERT(length(now - tool) <= most_motion_m(settings, scale, hand_m, input.in_contact, 1e-3));
            }
            tool = now;
            state = step.next;
        }
    }));
}

TEST(Workspace, StaysFiniteOnAnyInput) {
    EXPECT_TRUE(rc::check([] {
        const auto any = [] {
            const double big = std::numeric_limits<double>::max();
            switch (*rc::gen::inRange(0, 8)) {
                case 0: return big;
                case 1: return -big;
                case 2: return 1e-320;
                case 3: return between(-9, 9, 1e160);
                case 4: return std::numeric_limits<double>::infinity();
                case 5: return std::numeric_limits<double>::quiet_NaN();
                default: return between(-900, 900, 1e-3);
            }
        };
        WorkspaceSettings settings = any_settings();
        if (*rc::gen::arbitrary<bool>()) settings.workspace_device_m = Vec3(0.0);
        if (*rc::gen::arbitrary<bool>()) settings.bubble_rate_per_m2s = settings.drag_rate_per_s = 1e9;
        if (*rc::gen::arbitrary<bool>()) settings.max_speed_m_per_s = settings.max_acceleration_m_per_s2 = 1e9;
        RC_PRE(settings_are_sensible(settings));
        WorkspaceState state;
        for (int i = 0; i < 50; ++i) {
            WorkspaceInput input;
            for (int axis = 0; axis < 3; ++axis) {
                input.position_device_m[axis] = any();
                input.velocity_device_m_per_s[axis] = any();
            }
            input.buttons = *rc::gen::inRange<std::uint32_t>(0, 4);
            input.dt_s = any();
            const WorkspaceStep step = step_workspace(state, settings, input);
            RC_ASSERT(finite(step));
            RC_ASSERT(within_reach(step, settings));
            state = step.next;
        }
    }));
}

}  // namespace burin::haptics
