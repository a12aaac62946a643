// SPDX-License-Identifier: MIT
#include "record/crc32c.hpp"

#include <array>

namespace burin::record {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t rest = i;
        for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1u) != 0 ? 0x82F63B78u : 0u);
        table[i] = rest;
    }
    return table;
}

constexpr std::array<std::uint32_t, 256> kCrcTable = crc_table();

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
    std::uint32_t sum = ~before;
    for (const std::byte byte : bytes)
        sum = kCrcTable[(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xffu] ^ (sum >> 8);
    return ~sum;
}

}  // namespace burin::record
