// SPDX-License-Identifier: MIT
// A driver of a force-feedback arm and its ticks of a millisecond, for tests against emulated devices.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "tests/devices/tries.hpp"

namespace burin::devices {

inline const SimulatedHand& nobodys_hand() {
    static const SimulatedHand hand = SimulatedHand::create({{0.0, Vec3(0.0)}}).value();
    return hand;
}

class TickedArm {
public:
    // `device` as --device takes it.
    explicit TickedArm(const std::string& device) {
        auto opened = tried([&] { return open_haptic_device(device, {clock_, nobodys_hand()}); });
        EXPECT_TRUE(opened) << opened.error().line();
        if (opened) opened_ = std::move(*opened);
    }
    [[nodiscard]] DeviceSample tick(const Vec3& force_N) {
        clock_.sleep_until(clock_.now_ns() + 1'000'000);
        const DeviceSample sample = opened_.parts[0].device->read();
        opened_.parts[0].device->write({force_N, Vec3(0.0)});
        return sample;
    }
    // Ticks until it holds, but not for ever.
    template <typename Holds>
    bool ticks_until(const Vec3& force_N, Holds holds, int most = 5000) {
        for (int i = 0; i < most; ++i)
            if (holds(tick(force_N))) return true;
        return false;
    }
    [[nodiscard]] bool is_well() {
        return ticks_until(Vec3(0.0), [](const DeviceSample& s) { return s.fault == DeviceFault::none; });
    }
    [[nodiscard]] std::string messages() {
        std::string text;
        for (const std::string& message : opened_.messages->take_messages()) text += message + "\n";
        return text;
    }
    [[nodiscard]] OpenedDevice& opened() { return opened_; }
    [[nodiscard]] Clock& clock() { return clock_; }

private:
    MonotonicClock clock_;
    OpenedDevice opened_;
};

}  // namespace burin::devices
