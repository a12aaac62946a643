// SPDX-License-Identifier: MIT
// The bytes of VRPN 7, the Virtual-Reality Peripheral Network, over one TCP connection: what a client sends, and a
// reader of what a server sends that trusts nothing. The server's end is in devices/emulators/vrpn_wire.hpp and has no
// code in common with this.
//
// Each end first sends a cookie of 24 bytes, "vrpn: ver. 07.38  0" and zeros, whose version must agree up to the point.
// Then messages follow, all numbers big-endian: six int32 (length, seconds, microseconds, sender, type, sequence), and
// the payload, padded with zeros to a multiple of 8; the length counts header and payload, without the padding. Names
// of senders and of types are told by messages of the types -1 and -2, whose sender is the number being named, and
// whose payload is an int32 length (with the zero at the end) and the name. Numbers are the sender's own: each end has
// a table of the other's.
// Source: the protocol notes of vrpn-rs (github.com/vrpn/vrpn-rs, Protocol.md, CC-BY-4.0), checked against
// vrpn_Connection.C of VRPN 07.38 (github.com/vrpn/vrpn, 893c749): quaternions are x, y, z, w, and a button's message
// is of one button. Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"

namespace burin::devices {

inline constexpr std::uint16_t kVrpnPort = 3883;
inline constexpr std::size_t kVrpnCookieBytes = 24, kVrpnHeaderBytes = 24;
// VRPN's own limits: of its buffer for a message, of its tables, and of a name.
inline constexpr std::size_t kMostVrpnPayload = 64000, kMostVrpnNames = 2000, kMostVrpnName = 99;
inline constexpr std::size_t kMostVrpnButtons = 256, kMostVrpnChannels = 128;

enum VrpnSystemType : std::int32_t { kVrpnSender = -1, kVrpnType = -2, kVrpnDisconnect = -5 };

inline constexpr std::string_view kVrpnPose = "vrpn_Tracker Pos_Quat", kVrpnButton = "vrpn_Button Change",
                                  kVrpnButtons = "vrpn_Button States", kVrpnChannels = "vrpn_Analog Channel",
                                  kVrpnPing = "vrpn_Base ping_message", kVrpnPong = "vrpn_Base pong_message";

// Bytes that a client sends, without times; append in the order in which they are to go out.
class VrpnBytes {
public:
    VrpnBytes& cookie();
    VrpnBytes& name(VrpnSystemType kind, std::int32_t number, std::string_view name);
    VrpnBytes& message(std::int32_t sender, std::int32_t type, std::span<const std::byte> payload = {});
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

struct VrpnPose {
    std::int32_t sensor = 0;
    Vec3 position_m{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};
};
struct VrpnButton {
    std::int32_t button = 0, state = 0;
};

// Read a payload; nothing where it is shorter than what it should hold, or says more than VRPN allows. Numbers are as
// they come: they may be NaN.
[[nodiscard]] std::optional<VrpnPose> vrpn_pose(std::span<const std::byte> payload);
[[nodiscard]] std::optional<VrpnButton> vrpn_button(std::span<const std::byte> payload);
[[nodiscard]] std::optional<std::vector<std::int32_t>> vrpn_buttons(std::span<const std::byte> payload);
[[nodiscard]] std::optional<std::vector<double>> vrpn_channels(std::span<const std::byte> payload);

struct VrpnMessage {
    std::int32_t sender = 0, type = 0;
    std::span<const std::byte> payload;  // borrowed until the reader takes more
    std::int64_t time_us = 0;            // of the sender's clock, since 1970 as a rule; 0: it has set none
};

// Takes the bytes of one connection as they come, and gives its messages. Holds at most one message, of the largest
// size, and what came behind it: 128 KiB.
class VrpnReader {
public:
    // Returns where the next bytes are to be put, never empty once next() has given nothing; then say how many came.
    [[nodiscard]] std::span<std::byte> room();
    void came(std::size_t bytes) { end_ += bytes; }
    // Reads the cookie, if it has come; next() does so too.
    void read_version();
    // Returns the next whole message; nothing where there is none yet, or where the stream has failed.
    [[nodiscard]] std::optional<VrpnMessage> next();
    [[nodiscard]] bool has_cookie() const { return !version_.empty(); }
    [[nodiscard]] const std::string& version() const { return version_; }  // "07.38"
    // Says why the stream cannot be followed any more: no VRPN, another version, a length that no message has.
    [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

private:
    std::vector<std::byte> buffer_ = std::vector<std::byte>(2 * (kVrpnHeaderBytes + kMostVrpnPayload));
    std::size_t begin_ = 0, end_ = 0;
    std::string version_;
    std::optional<std::string> failure_;
};

// The other end's names: numbers below kMostVrpnNames, names of at most kMostVrpnName bytes; what is beyond is left out
// and counted.
class VrpnNames {
public:
    // Takes a message that names something; false where it is another.
    bool take(const VrpnMessage& message);
    [[nodiscard]] std::string_view sender(std::int32_t number) const { return name_of(senders_, number); }
    [[nodiscard]] std::string_view type(std::int32_t number) const { return name_of(types_, number); }
    [[nodiscard]] const std::vector<std::string>& senders() const { return senders_; }
    [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

private:
    [[nodiscard]] static std::string_view name_of(const std::vector<std::string>& names, std::int32_t number);

    std::vector<std::string> senders_, types_;
    std::uint64_t left_out_ = 0;
};

}  // namespace burin::devices
