// SPDX-License-Identifier: MIT
// An emulated wand that runs, and a driver that is ticked, for tests of both from end to end.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/drivers/library_beside.hpp"
#include "devices/emulators/emulated_wand.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/registry/device_registry.hpp"
#include "tests/devices/ticked_arm.hpp"
#include "tests/devices/tries.hpp"

namespace burin::devices {

// Names of this process's own, so that tests beside it and a user's emulators are not met.
inline std::string own_wand(const std::string& number = "") {
    return "emulated-test-" + std::to_string(::getpid()) + number;
}

inline std::string library_of_tests(const std::string& name) { return library_beside(name.c_str()); }

inline Vec3 jig_device_m() {
    const WandDescription wand = quanser_wand_of_maker();
    const auto tips = wand_tips(wand.mechanism.arm, wand.mechanism.jig_rad);
    return device_from_maker(wand) * wand_axis(*tips).middle_m;
}

// From the jig to a place, within a quarter of a second, and it stays there.
inline std::vector<HandPose> out_to(const Vec3& place_device_m, const Quat& turned = {1.0, 0.0, 0.0, 0.0}) {
    const Quat upright(1.0, 0.0, 0.0, 0.0);
    return {{0.0, jig_device_m(), upright, 0}, {0.05, jig_device_m(), upright, 0}, {0.3, place_device_m, turned, 0}};
}

// An emulated wand that runs while it lives.
class RunningWand {
public:
    explicit RunningWand(const std::string& name, std::vector<HandPose> script = out_to(Vec3(0.0)))
        : wand_(EmulatedWand::create(name, {.script = std::move(script), .silence = {}}).value()) {
        wand_.dies_after(kEnded_ns);
        thread_ = std::thread([this] { wand_.run([this] { return ends_.load(); }); });
        // It can be found from its first step on.
        const auto is_found = [&] { return std::ranges::count(emulated_wands(), name) > 0; };
        EXPECT_TRUE(tried(is_found));
    }
    ~RunningWand() {
        ends_ = true;
        thread_.join();
    }
    [[nodiscard]] EmulatedWand* operator->() { return &wand_; }
    [[nodiscard]] bool is_without_force() const { return wand_.volts() == WandJoints{}; }

private:
    EmulatedWand wand_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// A driver and its ticks of a millisecond.
class TickedWand {
public:
    explicit TickedWand(const std::string& name) {
        auto opened = tried([&] { return open_haptic_device("wand:" + name, {clock_, nobodys_hand()}); });
        EXPECT_TRUE(opened) << opened.error().line();
        if (opened) opened_ = std::move(*opened);
    }
    [[nodiscard]] DeviceSample tick(const DeviceWrench& wrench) {
        clock_.sleep_until(clock_.now_ns() + 1'000'000);
        const DeviceSample sample = opened_.parts[0].device->read();
        opened_.parts[0].device->write(wrench);
        return sample;
    }
    // Ticks until it holds, but not for ever.
    template <typename Holds>
    bool ticks_until(const DeviceWrench& wrench, Holds holds, int most = 5000) {
        for (int i = 0; i < most; ++i)
            if (holds(tick(wrench))) return true;
        return false;
    }
    // Until it is well and the hand has taken it out of the jig.
    [[nodiscard]] bool is_out() {
        return ticks_until({}, [](const DeviceSample& s) {
            return s.fault == DeviceFault::none && glm::length(s.position_device_m) < 0.01;
        });
    }
    [[nodiscard]] bool is_well() {
        return ticks_until({}, [](const DeviceSample& s) { return s.fault == DeviceFault::none; });
    }
    [[nodiscard]] std::string messages() {
        for (const std::string& message : opened_.messages->take_messages()) said_ += message + "\n";
        return said_;
    }
    [[nodiscard]] OpenedDevice& opened() { return opened_; }
    [[nodiscard]] Clock& clock() { return clock_; }

private:
    MonotonicClock clock_;
    OpenedDevice opened_;
    std::string said_;
};

inline constexpr DeviceWrench kPresses{Vec3(0.0, 0.0, 1.5), Vec3(0.0)};

}  // namespace burin::devices
