// SPDX-License-Identifier: MIT
#include "devices/haptic/steered_fingers.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "devices/hand/simulated_hand.hpp"

namespace burin::devices {
namespace {

// A hand that rests, and closes its fingers after 0.1 s.
SimulatedHand closing_hand() {
    return SimulatedHand::create({{0.0, Vec3(0.01, 0.0, 0.0), {1.0, 0.0, 0.0, 0.0}, 0},
                                  {0.1, Vec3(0.01, 0.0, 0.0), {1.0, 0.0, 0.0, 0.0}, 1},
                                  {9.0, Vec3(0.01, 0.0, 0.0), {1.0, 0.0, 0.0, 0.0}, 1}})
        .value();
}

std::vector<DeviceSample> turn(OpenedDevice& opened, SimulatedClock& clock, const DeviceWrench& on_index = {}) {
    clock.sleep_until(clock.now_ns() + 1'000'000);
    std::vector<DeviceSample> samples;
    for (DevicePart& part : opened.parts) samples.push_back(part.device->read());
    for (std::size_t i = 0; i < opened.parts.size(); ++i)
        opened.parts[i].device->write(i == 1 ? on_index : DeviceWrench{});
    return samples;
}

}  // namespace

TEST(SteeredFingers, StandAroundTheHandAndCloseOntoItsMiddle) {
    SimulatedClock clock;
    OpenedDevice opened = simulated_fingers(closing_hand(), clock);
    ASSERT_EQ(opened.parts.size(), kFingers);
    EXPECT_EQ(opened.parts[0].name, "thumb");
    std::vector<DeviceSample> samples;
    for (int i = 0; i < 90; ++i) samples = turn(opened, clock);
    const Vec3 middle_m(0.01, 0.0, 0.0);
    for (const DeviceSample& sample : samples)
        EXPECT_NEAR(glm::distance(sample.position_device_m, middle_m), kOpen_m, 0.002);
    EXPECT_LT(samples[0].position_device_m.y, middle_m.y) << "the thumb is opposite";
    EXPECT_GT(samples[2].position_device_m.y, middle_m.y);
    for (int i = 0; i < 1200; ++i) samples = turn(opened, clock);
    for (const DeviceSample& sample : samples)
        EXPECT_NEAR(glm::distance(sample.position_device_m, middle_m), kClosed_m, 0.002);
}

TEST(SteeredFingers, OneThatIsPushedMovesAlone) {
    SimulatedClock clock;
    OpenedDevice opened = simulated_fingers(closing_hand(), clock);
    std::vector<DeviceSample> before, after;
    for (int i = 0; i < 60; ++i) before = turn(opened, clock);
    for (int i = 0; i < 30; ++i) after = turn(opened, clock, {Vec3(0.0, 1.5, 0.0), Vec3(0.0)});
    EXPECT_GT(after[1].position_device_m.y, before[1].position_device_m.y + 0.002);
    for (const std::size_t other : {0u, 2u, 3u})
        EXPECT_LT(glm::distance(after[other].position_device_m, before[other].position_device_m), 3e-4) << other;
}

TEST(SteeredFingers, AllPartsHaveOneRateAndSayThatNobodyFeelsThem) {
    SimulatedClock clock;
    const OpenedDevice opened = simulated_fingers(closing_hand(), clock);
    for (const DevicePart& part : opened.parts) {
        EXPECT_EQ(part.device->description().rate_Hz, 1000.0);
        EXPECT_FALSE(part.device->description().felt_by_person);
    }
}

}  // namespace burin::devices
