// SPDX-License-Identifier: MIT
// The part of a tick that touches: every point of the probe on the surface, and what the hand feels of all together.
//
// Both fill in what `out` says of contact: points, work, flags, cutting, springs' energy, and the state for the next tick.
// Frame: object; what is returned is in the device frame. Pure but for `out`; no clock, heap, lock or throw.
#pragma once

#include "haptics/tick.hpp"

namespace burin {

// For each point: its proxy on the surface, the wall as the device may render it, and the force; the first also cuts.
[[nodiscard]] DeviceWrench touch_surface(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                                         const TickParameters& parameters, const DeviceDescription& device,
                                         double dt_s) noexcept;

// Nothing is touched: the proxies stay with the hand.
void follow_hand(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                 const TickParameters& parameters) noexcept;

}  // namespace burin
