// SPDX-License-Identifier: MIT
#include "session/live/haptic_side.hpp"

#include <utility>

#include "devices/haptic/device_registry.hpp"

namespace burin::session {

Result<void> HapticSide::open(std::string_view device, Clock& clock, const Vec3& rest_device_m) {
    devices::HandTarget rest;
    rest.position_device_m = rest_device_m;
    Result<devices::SteeredHand> hand = devices::SteeredHand::create(&steering_, rest);
    if (!hand) return std::unexpected(hand.error());
    auto opened = devices::open_haptic_device(device, {clock, std::move(*hand)});
    if (!opened) return std::unexpected(opened.error());
    device_ = std::move(*opened);
    loop_.emplace(*device_, clock, channels_);
    return {};
}

void HapticSide::move_hand(Nanoseconds time_ns, const devices::HandTarget& target) {
    steering_.draft() = {++hand_sequence_, time_ns, target.position_device_m, target.orientation_device,
                         target.buttons};
    steering_.publish();
}

void HapticSide::publish(haptics::TickParameters parameters) {
    parameters.sequence = ++parameter_sequence_;
    channels_.parameters.draft() = std::move(parameters);
    channels_.parameters.publish();
}

}  // namespace burin::session
