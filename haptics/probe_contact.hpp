// SPDX-License-Identifier: MIT
// The contact part of a tick: every point of the probe against the surface, and the wrench that the hand feels.
// Frame: object; wrenches are in the device frame. Pure; no clock, heap, lock or throw.
#pragma once

#include "haptics/channels.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/forces/cutting.hpp"

namespace burin::haptics {

// What contact keeps from tick to tick.
struct ProbeState {
    std::array<ProxyState, kMostProbePoints> proxies{};
    std::array<std::uint8_t, kMostProbePoints> materials{};  // material that each point touched in the last tick
    CuttingState cutting;
};

// References hold for the call.
struct ProbeInput {
    const devices::DeviceSample& sample;
    const MotionRecord& motion;
    const geometry::LocalSurface& surface;
    const TickParameters& parameters;
    const devices::DeviceDescription& device;
    double dt_s;
};

struct ProbeStep {
    ProbeState next;
    ContactRecord contact;    // its wrench is as the walls give it, not yet filtered
    std::uint32_t flags = 0;  // TickFlag bits that contact sets
};

// Computes, for each point, its proxy on the surface, the wall as the device may render it, and the force; the first
// point also cuts.
[[nodiscard]] ProbeStep touch_surface(const ProbeState& state, const ProbeInput& input) noexcept;

// Lets the proxies follow the hand while nothing is touched.
[[nodiscard]] ProbeStep follow_hand(const ProbeState& state, const ProbeInput& input) noexcept;

}  // namespace burin::haptics
