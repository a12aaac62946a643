// SPDX-License-Identifier: MIT
// What a Novint Falcon and its host say to each other: sixteen bytes either way, a thousand times a second.
//
//   '<'  12 bytes  1 byte  1 byte  '>'
// The twelve are three signed numbers of 16 bits, each in four nibbles, the lowest first, each nibble above 'A'. From
// the host they are commands of the motors, and the byte after them the lamps and whether encoders are to be homed;
// from the device they are encoders, and the byte the grip's buttons and which encoders are homed. The last byte says
// nothing. As libnifalcon reads and writes them (f7c727a, FalconFirmwareNovintSDK.cpp).
// Pure; any thread; no heap, lock or throw.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/falcon/falcon_kinematics.hpp"

namespace burin::devices {

inline constexpr std::size_t kFalconPacket = 16;
using FalconBytes = std::array<std::byte, kFalconPacket>;

enum FalconLamps : std::uint8_t { kFalconGreen = 2, kFalconBlue = 4, kFalconRed = 8 };

struct FalconCommand {
    FalconCounts motors{};
    std::uint8_t lamps = 0;  // bits: FalconLamps
    bool homes = true;       // a device that is told to home, and to stay so, counts from its stop
    bool operator==(const FalconCommand&) const = default;
};

struct FalconReport {
    FalconCounts encoders{};
    std::uint8_t buttons = 0;  // bits: plus, forward, centre, minus
    std::uint8_t homed = 0;    // bit i: encoder i knows where it is
    [[nodiscard]] bool is_homed() const noexcept { return homed == 7; }
    bool operator==(const FalconReport&) const = default;
};

[[nodiscard]] FalconBytes falcon_bytes(const FalconCommand& command) noexcept;
[[nodiscard]] FalconBytes falcon_bytes(const FalconReport& report) noexcept;
// Returns what a packet says; nothing where any of its bytes cannot be.
[[nodiscard]] std::optional<FalconCommand> falcon_command(const FalconBytes& bytes) noexcept;
[[nodiscard]] std::optional<FalconReport> falcon_report(const FalconBytes& bytes) noexcept;

// Finds packets in bytes that come in pieces. Bytes that belong to none are dropped and counted; none is read twice.
class FalconReader {
public:
    // Takes the next byte; returns the packet that it ends, whatever that says.
    [[nodiscard]] std::optional<FalconBytes> take(std::byte byte) noexcept;
    void forget() noexcept { count_ = 0; }
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

private:
    FalconBytes bytes_{};
    std::size_t count_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace burin::devices
