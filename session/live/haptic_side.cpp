// SPDX-License-Identifier: MIT
#include "session/live/haptic_side.hpp"

#include <utility>

#include "devices/haptic/device_registry.hpp"

namespace burin::session {

Result<void> HapticSide::open(std::string_view device, Clock& clock, const Pose& rest_device) {
    devices::HandTarget rest;
    rest.position_device_m = rest_device.position_m;
    rest.orientation_device = rest_device.orientation;
    Result<devices::SteeredHand> hand = devices::SteeredHand::create(&steering_, rest);
    if (!hand) return std::unexpected(hand.error());
    told_.position_device_m = rest_device.position_m;
    told_.orientation_device = rest_device.orientation;
    auto opened = devices::open_haptic_device(device, {clock, std::move(*hand)});
    if (!opened) return std::unexpected(opened.error());
    device_ = std::move(*opened);
    amplifiers_ = dynamic_cast<devices::Amplifiers*>(device_.get());
    loop_.emplace(*device_, clock, channels_);
    return {};
}

void HapticSide::move_hand(std::span<const devices::SteeredTarget> way, Nanoseconds time_ns,
                           const devices::HandTarget& end) {
    const auto tell = [&](const devices::SteeredTarget& target) {
        if (steering_.push(target)) told_ = target;  // else the next frame tells the end again
    };
    for (const devices::SteeredTarget& target : way) tell(target);
    const bool is_there = end.position_device_m == told_.position_device_m && end.buttons == told_.buttons &&
                          end.orientation_device == told_.orientation_device;
    if (!is_there) tell({time_ns, end.position_device_m, end.orientation_device, end.buttons});
}

void HapticSide::publish(haptics::TickParameters parameters) {
    parameters.sequence = ++parameter_sequence_;
    parameters.work.pace = pace_;
    channels_.parameters.draft() = std::move(parameters);
    channels_.parameters.publish();
}

}  // namespace burin::session
