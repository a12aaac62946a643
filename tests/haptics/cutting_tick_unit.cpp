// SPDX-License-Identifier: MIT
// What a whole tick makes of cutting, beyond the law itself (cutting_unit.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::haptics {

// The whole tick of a bar that lies in the material, pressed in its middle, while the hand turns it: what the hand gets
// is the torque of the material, against the turn. The spring, which bears in the middle, has none.
TEST(CuttingTick, TheTickGivesTheHandTheMaterialsTorqueOnAToolThatTurns) {
    const Vec3 half(0.012, 0.002, 0.004);
    const toolbox::FeltTool felt = toolbox::felt_tool(compute::BoxTool{half});
    const test::Surface plane = test::plane(0.05, 200);
    const auto torque_of_turn = [&](double rate_rad_per_s) {
        TickParameters p;
        p.probe = felt.probe;
        p.shape = felt.shape;
        p.tool = felt.surface;
        p.action = ToolAction::cut;
        p.clearance_ratio = 0.0;
        p.limit_stiffness = false;
        p.passivity.control = false;
        p.max_surface_age_s = 0.0;
        p.materials[0].hardness_Ns_per_m3 = 2e6;
        p.materials[0].cutting_yield_Pa = 0.0;
        p.materials[0].stiffness_N_per_m = 600.0;
        p.materials[0].damping_Ns_per_m = 0.0;
        TickState state;
        TickRecord record;
        for (int i = 0; i < 80; ++i) {
            devices::DeviceSample sample;
            sample.time_ns = (i + 1) * 1'000'000;
            sample.buttons = 1;
            // In the air, then down by 20 mm/s, and turned from the sixtieth tick on.
            sample.position_device_m = {0.0, i < 5 ? half.y + 0.002 : half.y - 2e-5 * i, 0.0};
            sample.orientation_device = glm::angleAxis(rate_rad_per_s * kDt * std::max(0, i - 60), Vec3(0.0, 0.0, 1.0));
            const Tick t = haptics::tick(state, sample, *plane, p, test::kStrongDevice, sample.time_ns, kDt);
            state = t.next;
            record = t.record;
        }
        EXPECT_NE(record.flags & kTickCutting, 0u);
        return record.contact.wrench.torque_device_Nm.z;
    };
    const double to_left = torque_of_turn(1.0), to_right = torque_of_turn(-1.0), still = torque_of_turn(0.0);
    // A tool that does not turn has a torque too, since its samples lie unevenly.
    EXPECT_LT(to_left, still - 5e-4);
    EXPECT_GT(to_right, still + 5e-4);
}

}  // namespace burin::haptics
