// SPDX-License-Identifier: MIT
// Ticks of recorded samples: a recording put in the place of a hand. Each sample goes through the whole of a tick, with
// the surface and the parameters that the caller gives, and nobody feels it.
//
// The same samples, surfaces, parameters and times give the same records to the bit as the loop that they were recorded
// in (haptics/haptic_loop.hpp), where that has one part and began as this does: with a hand that has touched nothing.
// Pure but for its state; one thread each.
#pragma once

#include "haptics/tick.hpp"

namespace burin::haptics {

class SampleRepeater {
public:
    // device: the one that was recorded; of its description come limits, axes and rate.
    explicit SampleRepeater(const devices::DeviceDescription& device)
        : device_(device), dt_s_(seconds(nanoseconds(1.0 / device.rate_Hz))) {}

    // Computes the next tick. The record stays until the next call.
    const TickRecord& repeat(const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                             const TickParameters& parameters, Nanoseconds now_ns);
    // Sets all proxies at a place, from where the next tick takes them to the hand.
    void place(const Vec3& position_object_m, const geometry::LocalSurface& surface);
    // Returns what the ticks so far have left.
    [[nodiscard]] const TickState& state() const { return full_.next.tick; }
    [[nodiscard]] std::uint64_t ticks() const { return ticks_; }

private:
    devices::DeviceDescription device_;
    double dt_s_;
    FullTick full_;
    std::uint64_t ticks_ = 0;
};

}  // namespace burin::haptics
