// SPDX-License-Identifier: MIT
#include "devices/haptic/simulated_fingers.hpp"

#include <utility>

namespace burin::devices {

SimulatedFinger::SimulatedFinger(SimulatedHand hand, const OmniModel& model, const bool& link_is_lost, Clock* clock)
    : arm_(std::move(hand), model, clock), description_(arm_.description()), link_is_lost_(link_is_lost) {
    description_.name = "simulated finger";
}

DeviceSample SimulatedFinger::read() noexcept {
    DeviceSample sample = arm_.read();
    if (link_is_lost_) {
        sample.fault = DeviceFault::disconnected;
        sample.fault_is_of_all = true;
    }
    return sample;
}

void SimulatedFinger::write(const DeviceWrench& wrench) noexcept {
    arm_.write(link_is_lost_ ? DeviceWrench{} : wrench);
}

SimulatedFingers::SimulatedFingers(std::vector<SimulatedHand> hands, const OmniModel& model, Clock* clock) {
    for (SimulatedHand& hand : hands) fingers_.emplace_back(std::move(hand), model, link_is_lost_, clock);
}

void SimulatedFingers::advance(Nanoseconds dt_ns) noexcept {
    for (SimulatedFinger& finger : fingers_) finger.arm().advance(dt_ns);
}

}  // namespace burin::devices
