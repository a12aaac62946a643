// SPDX-License-Identifier: MIT
// CRC-32C (Castagnoli, IEEE Trans. Commun. 41(6), 1993; polynomial 0x1EDC6F41, reflected), the check sum of iSCSI
// (RFC 3720, B.4) and of ext4. Detects torn and exchanged blocks; no protection against intent. Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace burin::record {

// Returns the sum of the bytes, continued from that of the bytes before them; 0 begins.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;

}  // namespace burin::record
