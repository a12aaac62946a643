// SPDX-License-Identifier: MIT
// Whatever is asked for, the gate keeps a wand's amplifiers on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "devices/haptic/simulated_wand.hpp"
#include "haptics/stability/safety_gate.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

// Wrenches of all sizes, some of them no numbers.
class AnyWrench {
public:
    explicit AnyWrench(std::uint32_t seed) : random_(seed) {}
    Vec3 vector(double usual) {
        const double size = usual * std::pow(10.0, 4.0 * share_(random_) - 2.0);
        Vec3 v;
        for (int axis = 0; axis < 3; ++axis) v[axis] = size * (2.0 * share_(random_) - 1.0);
        const double odd = share_(random_);
        if (odd < 1e-4) v.y = std::numeric_limits<double>::quiet_NaN();
        if (odd > 1.0 - 1e-4) v.z = std::numeric_limits<double>::infinity();
        return v;
    }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> share_{0.0, 1.0};
};

}  // namespace

TEST(WandLimits, AMillionRandomTicksNeverExceedThem) {
    devices::SimulatedWand wand(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}));
    const devices::DeviceDescription& device = wand.description();
    GateInput input;
    input.device_max_force_N = device.max_force_N;
    input.device_axis_max_force_N = device.axis_max_force_N;
    input.device_max_torque_Nm = device.max_torque_Nm;
    GateLimits limits;
    limits.max_force_N = device.max_force_N;
    GateState state;
    AnyWrench any(20);
    std::uint64_t saturated = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        input.wanted.force_device_N = any.vector(3.0);
        input.wanted.torque_device_Nm = any.vector(0.3);
        const GateStep step = pass_gate(state, input, limits, kDt);
        state = step.next;
        const devices::DeviceWrench& given = step.output.given;
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(std::abs(given.force_device_N[axis]), device.axis_max_force_N[axis]) << i;
            ASSERT_LE(std::abs(given.torque_device_Nm[axis]), device.max_torque_Nm[axis]) << i;
        }
        wand.write(given);
        ASSERT_FALSE(wand.tripped()) << i;
        saturated += step.output.saturated ? 1 : 0;
    }
    EXPECT_GT(saturated, 100'000u) << "the limits were never met";
    const devices::WandSaturation& counted = wand.saturation();
    // The gate's slew limit lets few of these jumps come as far as the device's own limits.
    EXPECT_GT(counted.force[0] + counted.force[1] + counted.force[2], 100u) << "no limit of force was met";
    EXPECT_GT(counted.torque[0] + counted.torque[2], 100u) << "no limit of torque was met";
    EXPECT_EQ(counted.torque[1], 0u);
}

}  // namespace burin::haptics
