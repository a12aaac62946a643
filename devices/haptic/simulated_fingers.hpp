// SPDX-License-Identifier: MIT
// A simulated device of several parts, such as a glove's fingertips: each part is driven and pulled by itself, by a
// scripted hand of its own, with the dynamics of the simulated Omni at a finger's mass.
//
// Faults are injected into one part, which the others do not notice, or into the link that all share.
// Time and threads as SimulatedOmni: a clock is given and every part catches up with it when it is read, or advance()
// moves all. Allocates when it is made; after that nothing allocates, locks or throws.
#pragma once

#include <deque>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

// One part: the Omni's model, and what the device's link adds to its samples.
class SimulatedFinger final : public HapticDevice {
public:
    SimulatedFinger(SimulatedHand hand, const OmniModel& model, const bool& link_is_lost, Clock* clock);

    [[nodiscard]] const DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] DeviceSample read() noexcept override;
    void write(const DeviceWrench& wrench) noexcept override;  // torque is ignored

    [[nodiscard]] SimulatedOmni& arm() noexcept { return arm_; }

private:
    SimulatedOmni arm_;
    DeviceDescription description_;
    const bool& link_is_lost_;
};

class SimulatedFingers {
public:
    // A finger's arm is assumed to weigh 10 g at the tip and to rub with 0.1 N; the Omni's other figures.
    static constexpr OmniModel kFinger{.apparent_mass_kg = 0.01, .friction_N = 0.1};

    // As many parts as there are hands. The clock, which may be null, must outlive the device.
    explicit SimulatedFingers(std::vector<SimulatedHand> hands, const OmniModel& model = kFinger,
                              Clock* clock = nullptr);
    SimulatedFingers(const SimulatedFingers&) = delete;
    SimulatedFingers& operator=(const SimulatedFingers&) = delete;

    [[nodiscard]] std::size_t count() const noexcept { return fingers_.size(); }
    [[nodiscard]] SimulatedFinger& part(std::size_t index) noexcept { return fingers_[index]; }

    // Of one part; its samples, but not those of the others, go wrong.
    void inject(std::size_t part, InjectedFault fault) noexcept { fingers_[part].arm().inject(fault); }
    // Of the link to all parts: their samples say so, and the device takes the force off its motors by itself.
    void lose_link(bool is_lost) noexcept { link_is_lost_ = is_lost; }
    // Advances every part (SimulatedOmni::advance).
    void advance(Nanoseconds dt_ns) noexcept;

private:
    bool link_is_lost_ = false;
    std::deque<SimulatedFinger> fingers_;  // its elements stay where they are
};

}  // namespace burin::devices
