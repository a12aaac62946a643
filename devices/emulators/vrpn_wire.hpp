// SPDX-License-Identifier: MIT
// A server's end of a connection of VRPN: the bytes that it sends, and what it understands of a client's. Written from
// vrpn_Connection.C, vrpn_Tracker.C, vrpn_Button.C, vrpn_Analog.C and vrpn_BaseClass.C of VRPN 07.38
// (github.com/vrpn/vrpn, 893c749) and without any of the driver's code (devices/trackers/vrpn_protocol.hpp), so that a
// fault in one of the two shows where they meet. Pure; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/space.hpp"

namespace burin::devices {

// Bytes to send; append in the order in which they are to go out.
class VrpnServerBytes {
public:
    VrpnServerBytes& cookie();
    VrpnServerBytes& sender(std::int32_t number, std::string_view name);
    VrpnServerBytes& type(std::int32_t number, std::string_view name);
    VrpnServerBytes& message(std::int32_t sender, std::int32_t type, std::span<const std::byte> payload = {},
                             std::int64_t time_us = 0);
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    VrpnServerBytes& description(std::int32_t kind, std::int32_t number, std::string_view name);

    std::vector<std::byte> bytes_;
};

// Payloads of a tracker's pose (metres), of a button that has changed, of all buttons, and of an analog's channels.
[[nodiscard]] std::vector<std::byte> vrpn_pos_quat(std::int32_t sensor, const Pose& pose);
[[nodiscard]] std::vector<std::byte> vrpn_button_change(std::int32_t button, std::int32_t state);
[[nodiscard]] std::vector<std::byte> vrpn_button_states(std::span<const std::int32_t> states);
[[nodiscard]] std::vector<std::byte> vrpn_analog_channels(std::span<const double> channels);

// A client's message with the client's own names for it; empty where it has not told them.
struct HeardVrpn {
    std::string sender, type;
    std::vector<std::byte> payload;
};

// Finds a client's messages among the bytes of its connection.
class VrpnServerEar {
public:
    // Takes what has come; returns the messages that it completes, without those that name something.
    [[nodiscard]] std::vector<HeardVrpn> take(std::span<const std::byte> bytes);
    // Returns whether the client has said what none of this version says; nothing is understood from then on.
    [[nodiscard]] bool is_lost() const { return is_lost_; }

private:
    // Reads one message. Returns nothing where it only gives a number its name.
    [[nodiscard]] std::optional<HeardVrpn> understood(std::span<const std::byte> message);

    std::vector<std::byte> waiting_;
    std::map<std::int32_t, std::string> senders_, types_;
    bool is_greeted_ = false, is_lost_ = false;
};

}  // namespace burin::devices
