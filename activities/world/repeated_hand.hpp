// SPDX-License-Identifier: MIT
// The hand of a recording whose ticks are computed again: every sample is the recorded one, and its device, which knows
// limits, axes and rate, is moved by nobody. One thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "devices/haptic/wand_description.hpp"
#include "haptics/haptic_loop.hpp"
#include "record/motion.hpp"

namespace burin::activities {

// The simulated device that led a recorded motion, and what of it touches: a ball at each point.
struct DeviceAsRecorded {
    std::optional<devices::WandDescription> wand = {};  // none: the simulated Omni
    std::vector<devices::WandPoint> points = {};        // of the wand; none: one, where the tool is

    [[nodiscard]] std::uint32_t point_count() const {
        return points.empty() ? 1u : static_cast<std::uint32_t>(points.size());
    }
    // Returns the probe of these points with balls of one radius.
    [[nodiscard]] haptics::Probe probe(double radius_m) const;
};

// Checks that the recording has one hand, and that it is of this device.
[[nodiscard]] Result<void> check_hand(const record::RecordReader& reader, const DeviceAsRecorded& device);

// Checks what a file may claim of a tick: times that can be subtracted from each other, and a mapping that is one.
[[nodiscard]] Result<void> check_tick(const record::RecordReader& reader, const record::RecordedTick& tick);

class RepeatedHand {
public:
    // The channels must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<RepeatedHand>> create(const DeviceAsRecorded& device,
                                                                      haptics::HapticChannels& channels);

    // Computes a recorded tick with the newest surface and parameters of the channels, as their next one.
    haptics::TickRecord repeated(const record::RecordedTick& tick);
    [[nodiscard]] Nanoseconds period_ns() const { return loop_.period_ns(); }

private:
    RepeatedHand(std::unique_ptr<devices::HapticDevice> device, haptics::HapticChannels& channels)
        : device_(std::move(device)), channels_(channels), loop_(*device_, clock_, channels) {}

    SimulatedClock clock_;
    std::unique_ptr<devices::HapticDevice> device_;
    haptics::HapticChannels& channels_;
    haptics::HapticLoop loop_;
};

}  // namespace burin::activities
