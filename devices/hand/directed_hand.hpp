// SPDX-License-Identifier: MIT
// A hand that a simulation directs: before each period it says where the hand means to be, how fast it goes on from
// there, and how firmly it holds. Such as a simulated learner's, which looks at what the device did and goes on.
//
// Data flow: simulation -> HandDirection -> DirectedHand (a view of it, which the device holds).
// Frame: device, metres. Time: the device's own, from 0. The direction must outlive the hand and every copy of it.
// One thread for both. Wait-free: no heap, lock or throw.
#pragma once

#include "devices/hand/simulated_hand.hpp"

namespace burin::devices {

struct HandDirection {
    double since_s = 0.0;  // when the hand is at the target; from then on it goes on with the target's velocity
    HandTarget target;
    HandGrip grip;
};

class DirectedHand {
public:
    explicit DirectedHand(const HandDirection& direction) : direction_(&direction) {}

    // For a time before the direction's it is where the direction begins.
    [[nodiscard]] HandTarget target(double time_s) const noexcept {
        HandTarget now = direction_->target;
        const double since_s = time_s - direction_->since_s;
        if (since_s > 0.0) now.position_device_m += since_s * now.velocity_device_m_per_s;
        return now;
    }
    [[nodiscard]] const HandGrip& grip() const noexcept { return direction_->grip; }

private:
    const HandDirection* direction_;
};

}  // namespace burin::devices
