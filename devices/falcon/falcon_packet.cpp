// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_packet.hpp"

namespace burin::devices {
namespace {

constexpr std::uint8_t kZero = 0x41;  // 'A'
constexpr std::size_t kStates = 1 + 4 * kFalconLegs;

FalconBytes packet_of(const FalconCounts& counts, std::uint8_t states) noexcept {
    FalconBytes bytes;
    bytes.fill(std::byte{kZero});
    bytes.front() = std::byte{'<'};
    bytes.back() = std::byte{'>'};
    for (std::size_t i = 0; i < kFalconLegs; ++i)
        for (std::size_t nibble = 0; nibble < 4; ++nibble) {
            const auto value = static_cast<std::uint16_t>(counts[i]);
            bytes[1 + 4 * i + nibble] = static_cast<std::byte>(kZero + ((value >> (4 * nibble)) & 0xf));
        }
    bytes[kStates] = static_cast<std::byte>(kZero + states);
    return bytes;
}

struct Packet {
    FalconCounts counts{};
    std::uint8_t states = 0;
};
std::optional<Packet> packet_in(const FalconBytes& bytes, std::uint8_t most_states) noexcept {
    if (bytes.front() != std::byte{'<'} || bytes.back() != std::byte{'>'}) return std::nullopt;
    Packet packet;
    for (std::size_t i = 0; i < kFalconLegs; ++i) {
        std::uint16_t value = 0;
        for (std::size_t nibble = 0; nibble < 4; ++nibble) {
            const int digit = std::to_integer<int>(bytes[1 + 4 * i + nibble]) - kZero;
            if (digit < 0 || digit > 0xf) return std::nullopt;
            value = static_cast<std::uint16_t>(value | digit << (4 * nibble));
        }
        packet.counts[i] = static_cast<std::int16_t>(value);
    }
    const int states = std::to_integer<int>(bytes[kStates]) - kZero;
    if (states < 0 || states > most_states) return std::nullopt;
    packet.states = static_cast<std::uint8_t>(states);
    return packet;
}

}  // namespace

FalconBytes falcon_bytes(const FalconCommand& command) noexcept {
    return packet_of(command.motors, static_cast<std::uint8_t>((command.lamps & 0xe) | (command.homes ? 1 : 0)));
}

FalconBytes falcon_bytes(const FalconReport& report) noexcept {
    return packet_of(report.encoders, static_cast<std::uint8_t>((report.buttons & 0xf) | (report.homed & 7) << 4));
}

std::optional<FalconCommand> falcon_command(const FalconBytes& bytes) noexcept {
    const auto packet = packet_in(bytes, 0xf);
    if (!packet) return std::nullopt;
    return FalconCommand{packet->counts, static_cast<std::uint8_t>(packet->states & 0xe), (packet->states & 1) != 0};
}

std::optional<FalconReport> falcon_report(const FalconBytes& bytes) noexcept {
    const auto packet = packet_in(bytes, 0x7f);
    if (!packet) return std::nullopt;
    return FalconReport{packet->counts, static_cast<std::uint8_t>(packet->states & 0xf),
                        static_cast<std::uint8_t>(packet->states >> 4)};
}

std::optional<FalconBytes> FalconReader::take(std::byte byte) noexcept {
    // '<' and '>' are no nibbles: whatever stands before a '<' is no packet. What the byte before the last may be is
    // not known.
    const bool may_be_any = count_ == kFalconPacket - 2, is_last = count_ == kFalconPacket - 1;
    const bool begins = byte == std::byte{'<'} && !may_be_any;
    const bool fits = count_ > 0 && (may_be_any || is_last == (byte == std::byte{'>'}));
    if (begins || !fits) {
        dropped_ += count_ + (begins ? 0 : 1);
        count_ = 0;
        if (!begins) return std::nullopt;
    }
    bytes_[count_++] = byte;
    if (count_ < kFalconPacket) return std::nullopt;
    count_ = 0;
    return bytes_;
}

}  // namespace burin::devices
