// SPDX-License-Identifier: MIT
// A hand that a simulation plans from frame to frame: at each frame it says where the hand goes until the next, step by
// step. So it looks at what a person would see, and its device goes on between two looks.
//
// Data flow: simulation -> HandPlan -> PlannedHand (a view of it, which the device holds).
// Frame: device, metres. Time: the device's own, from 0. One thread for both; a plan is changed between two reads of
// the device. Wait-free: no heap, lock or throw.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "devices/hand/directed_hand.hpp"

namespace burin::devices {

// Directions in the order of their times; at least one. Each holds until the next, the first also before its time.
using HandPlan = std::vector<HandDirection>;

class PlannedHand {
public:
    explicit PlannedHand(std::shared_ptr<const HandPlan> plan) : plan_(std::move(plan)) {}

    [[nodiscard]] HandTarget target(double time_s) noexcept {
        const auto next = std::ranges::lower_bound(*plan_, time_s, {}, &HandDirection::since_s);
        at_ = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - plan_->begin() - 1, 0));
        return DirectedHand((*plan_)[at_]).target(time_s);
    }
    // Returns how it holds at the time that was asked for last.
    [[nodiscard]] const HandGrip& grip() const noexcept { return (*plan_)[std::min(at_, plan_->size() - 1)].grip; }

private:
    std::shared_ptr<const HandPlan> plan_;
    std::size_t at_ = 0;
};

}  // namespace burin::devices
