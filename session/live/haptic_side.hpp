// SPDX-License-Identifier: MIT
// The haptic side of a live session: the device, the loop that drives it, the channels to it, and what the
// frames publish into these. The loop runs on a thread of its own, or is stepped by whoever drives the session; all
// other functions are the frame's thread's.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "devices/hand/steered_hand.hpp"
#include "devices/haptic/amplifiers.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::session {

class HapticSide {
public:
    // records: ticks that the recording's ring holds. pace: of the machine (haptics::WorkSettings). whole_ticks: an
    // activity goes by them.
    HapticSide(std::size_t records, double pace, bool whole_ticks)
        : channels_(haptics::HapticChannels::kStrokes, records, whole_ticks), pace_(pace) {}

    // Opens the device of that name (devices/haptic/device_registry.hpp), a simulated one with its hand at rest there.
    // The clock must outlive it.
    [[nodiscard]] Result<void> open(std::string_view device, Clock& clock, const Pose& rest_device);
    // Publishes where the hand is to go, for the device's next ticks: through the targets of the way, each at its own
    // time, to where it is to be at time_ns if the way does not end there. All times are session time.
    void move_hand(std::span<const devices::SteeredTarget> way, Nanoseconds time_ns, const devices::HandTarget& end);
    // Returns the number of targets that were lost to a full channel.
    [[nodiscard]] std::uint64_t lost_targets() const { return steering_.lost(); }
    // Publishes other parameters of the ticks; numbers them, and gives them the machine's pace.
    void publish(haptics::TickParameters parameters);
    // Switches the device's amplifiers; nothing where it has none that can be switched from here.
    [[nodiscard]] std::optional<devices::AmplifierAnswer> switch_amplifiers(bool on) {
        return amplifiers_ ? std::optional(amplifiers_->switch_amplifiers(on)) : std::nullopt;
    }
    // Returns the newest tool state that the loop has published.
    [[nodiscard]] const haptics::ToolState& newest_tool() { return channels_.tool.newest(); }

    [[nodiscard]] double pace() const { return pace_; }
    [[nodiscard]] haptics::HapticLoop& loop() { return *loop_; }
    [[nodiscard]] haptics::HapticChannels& channels() { return channels_; }
    [[nodiscard]] const devices::DeviceDescription& device() const { return device_->description(); }

private:
    haptics::HapticChannels channels_;
    double pace_;
    devices::HandSteering steering_;
    std::unique_ptr<devices::HapticDevice> device_;
    devices::Amplifiers* amplifiers_ = nullptr;  // of the device; null: none
    std::optional<haptics::HapticLoop> loop_;
    devices::SteeredTarget told_;  // the last target published
    std::uint64_t parameter_sequence_ = 0;
};

}  // namespace burin::session
