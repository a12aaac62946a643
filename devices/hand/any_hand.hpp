// SPDX-License-Identifier: MIT
// Whatever leads a simulated device, and the palm of a glove: a script, the mouse of a desk, or a simulation.
// Frame: device. Wait-free: no heap, lock or throw.
#pragma once

#include <variant>

#include "devices/hand/directed_hand.hpp"
#include "devices/hand/planned_hand.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "devices/hand/steered_hand.hpp"

namespace burin::devices {

using AnyHand = std::variant<SimulatedHand, SteeredHand, DirectedHand, PlannedHand>;

// Uses get_if instead of visit, which could throw. A variant of types whose moves do not throw always holds one.
[[nodiscard]] inline HandTarget target_of(AnyHand& hand, double time_s) noexcept {
    if (auto* scripted = std::get_if<SimulatedHand>(&hand)) return scripted->target(time_s);
    if (auto* directed = std::get_if<DirectedHand>(&hand)) return directed->target(time_s);
    if (auto* planned = std::get_if<PlannedHand>(&hand)) return planned->target(time_s);
    return std::get_if<SteeredHand>(&hand)->target(time_s);
}
[[nodiscard]] inline const HandGrip& grip_of(const AnyHand& hand) noexcept {
    if (const auto* scripted = std::get_if<SimulatedHand>(&hand)) return scripted->grip();
    if (const auto* directed = std::get_if<DirectedHand>(&hand)) return directed->grip();
    if (const auto* planned = std::get_if<PlannedHand>(&hand)) return planned->grip();
    return std::get_if<SteeredHand>(&hand)->grip();
}

}  // namespace burin::devices
