// SPDX-License-Identifier: MIT
// Ticks of an Omni by its maker's library, here the emulated one, of a Force Dimension device, of a Falcon, of an
// Inverse3 and of a SpaceMouse: the driver's work on the haptic thread allocates, locks, throws and opens nothing, also
// while the device comes and goes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "devices/emulators/emulated_dhd.hpp"
#include "devices/emulators/emulated_falcon.hpp"
#include "devices/emulators/emulated_inverse3.hpp"
#include "devices/emulators/emulated_omni.hpp"
#include "devices/emulators/emulated_spacemouse.hpp"
#include "devices/emulators/emulated_wand.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "tests/devices/tries.hpp"
#include "tests/support/realtime_counters.hpp"

namespace burin::devices {

namespace {

constexpr auto kFallsSilent = [](auto& emulated, bool is_silent) { emulated.fall_silent(is_silent); };

// goes: the drill by which it is gone, and comes back.
template <typename Emulated, typename Goes = decltype(kFallsSilent)>
void ticks_without_cost(Emulated emulated, const std::string& device, const Goes& goes = kFallsSilent) {
    std::atomic<bool> ends = false;
    std::thread runs([&] { emulated.run([&] { return ends.load(); }); });
    MonotonicClock clock;
    clock.sleep_until(clock.now_ns() + 20'000'000);
    const SimulatedHand hand = SimulatedHand::create({{0.0, Vec3(0.0)}}).value();
    auto opened = tried([&] { return open_haptic_device(device, {clock, hand}); });
    EXPECT_TRUE(opened) << opened.error().line();
    test::RealtimeCounts counts;
    constexpr std::size_t kTicks = 4000;
    std::vector<Nanoseconds> took_ns(kTicks);
    int faults = 0;
    for (std::size_t tick = 0; opened && tick < kTicks; ++tick) {
        clock.sleep_until(clock.now_ns() + 1'000'000);
        if (tick == 800) goes(emulated, true);
        if (tick == 1000) goes(emulated, false);
        HapticDevice& part = *opened->parts[0].device;
        const test::RealtimeScope scope;
        const Nanoseconds begun_ns = clock.now_ns();
        const DeviceSample sample = part.read();
        part.write({Vec3(0.0, 0.5, 0.0), Vec3(0.0)});
        took_ns[tick] = clock.now_ns() - begun_ns;
        counts += scope.counts();
        faults += sample.fault != DeviceFault::none ? 1 : 0;
    }
    std::ranges::nth_element(took_ns, took_ns.begin() + kTicks / 2);
    std::printf("a tick's read and write: %lld ns, median\n", static_cast<long long>(took_ns[kTicks / 2]));
    if (opened) opened->parts.clear();
    ends = true;
    runs.join();
    EXPECT_EQ(counts.allocations, 0u);
    EXPECT_EQ(counts.frees, 0u);
    EXPECT_EQ(counts.locks, 0u);
    EXPECT_EQ(counts.throws, 0u);
    EXPECT_EQ(counts.files, 0u);
    EXPECT_GT(faults, 50) << "it was gone for a while";
    EXPECT_LT(faults, 3500) << "and there for some of it";
}

std::string realtime_name() { return "emulated-realtime-" + std::to_string(::getpid()); }

}  // namespace

TEST(Omni, AllocatesLocksThrowsAndOpensNothingInATick) {
    ticks_without_cost(EmulatedOmni::create(realtime_name()).value(), "omni:" + realtime_name());
}

TEST(Dhd, AllocatesLocksThrowsAndOpensNothingInATick) {
    ticks_without_cost(EmulatedDhd::create(realtime_name()).value(), "dhd:" + realtime_name());
}

TEST(Wand, AllocatesLocksThrowsAndOpensNothingInATick) {
    ticks_without_cost(EmulatedWand::create(realtime_name()).value(), "wand:" + realtime_name());
}

TEST(Falcon, AllocatesLocksThrowsAndOpensNothingInATick) {
    ticks_without_cost(EmulatedFalcon::create(realtime_name()).value(), "falcon:" + realtime_name());
}

TEST(Inverse3, AllocatesLocksThrowsAndOpensNothingInATick) {
    ticks_without_cost(EmulatedInverse3::create(realtime_name()).value(), "inverse3:" + realtime_name());
}

TEST(SpaceMouse, AllocatesLocksThrowsAndOpensNothingInATick) {
    const auto is_pulled = [](EmulatedSpaceMouse& emulated, bool pulled) { emulated.pull_cable(pulled); };
    for (const std::string kind : {"spacemouse:", "spacemouse-wand:"})
        ticks_without_cost(EmulatedSpaceMouse::create(realtime_name()).value(), kind + realtime_name(), is_pulled);
}

}  // namespace burin::devices
