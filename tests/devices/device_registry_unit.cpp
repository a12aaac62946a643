// SPDX-License-Identifier: MIT
// The registry of force-feedback devices.
#include "devices/registry/device_registry.hpp"

#include <gtest/gtest.h>

#include <set>

namespace burin::devices {
namespace {

HapticHost host_of(Clock& clock) {
    return {clock, *SimulatedHand::create({{0.0, Vec3(0.0)}, {1.0, Vec3(0.02, 0.0, 0.0)}})};
}

}  // namespace

TEST(HapticRegistry, NamesEachKindOnceAndInItsUsage) {
    std::set<std::string_view> names;
    ASSERT_FALSE(haptic_kinds().empty());
    for (const HapticKind& kind : haptic_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_TRUE(haptic_usage().contains(std::string(kind.name) + ": ")) << haptic_usage();
    }
    EXPECT_TRUE(names.contains(kDefaultHapticDevice));
}

TEST(HapticRegistry, OpensTheSimulatedOmniOnTheClockThatItIsGiven) {
    SimulatedClock clock;
    const auto opened = open_haptic_device("simulated", host_of(clock));
    ASSERT_TRUE(opened) << opened.error().line();
    EXPECT_EQ(opened->parts.front().device->description().max_force_N, OmniModel{}.max_force_N);
    SimulatedOmni reference(*SimulatedHand::create({{0.0, Vec3(0.0)}, {1.0, Vec3(0.02, 0.0, 0.0)}}), {}, &clock);
    for (int tick = 1; tick <= 500; ++tick) {
        clock.sleep_until(tick * Nanoseconds{1'000'000});
        ASSERT_EQ(opened->parts.front().device->read().position_device_m, reference.read().position_device_m) << tick;
    }
    EXPECT_EQ(opened->parts.size(), parts_of_device("simulated"));
    EXPECT_EQ(parts_of_device("simulated-fingers"), 4u);
    EXPECT_EQ(parts_of_device("simulatd"), 0u);
    EXPECT_GT(reference.read().position_device_m.x, 0.001) << "the hand moves it";
}

TEST(HapticRegistry, RefusesWhatItDoesNotKnowAndSuggestsTheNearest) {
    SimulatedClock clock;
    const auto opened = open_haptic_device("simulatd", host_of(clock));
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("did you mean simulated?")) << opened.error().line();
}

}  // namespace burin::devices
