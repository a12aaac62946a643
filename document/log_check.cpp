// SPDX-License-Identifier: MIT
#include "document/log_check.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/file_io.hpp"

namespace burin::document {
namespace {

// The format of the log: sqlite.org/fileformat2.html, "The Write-Ahead Log".
constexpr std::size_t kHeaderBytes = 32, kFrameHeaderBytes = 24, kSummedOfHeader = 24, kSummedOfFrame = 8;
constexpr std::uint32_t kMagic = 0x377f0682;  // with a last bit that tells the order of bytes in the sums
constexpr std::size_t kMostLogBytes = std::size_t{1} << 30, kLargestPage = 65536;

std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

std::uint32_t swapped(std::uint32_t value) {
    return value >> 24 | (value >> 8 & 0xff00) | (value << 8 & 0xff0000) | value << 24;
}

// The running check sum over all that was added.
struct LogSum {
    bool is_big_endian = false;
    std::array<std::uint32_t, 2> sum{};

    void add(std::span<const std::byte> bytes) {
        for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
            const std::uint32_t first = big_endian(bytes, at), second = big_endian(bytes, at + 4);
            sum[0] += (is_big_endian ? first : swapped(first)) + sum[1];
            sum[1] += (is_big_endian ? second : swapped(second)) + sum[0];
        }
    }
    [[nodiscard]] bool is_at(std::span<const std::byte> bytes, std::size_t at) const {
        return big_endian(bytes, at) == sum[0] && big_endian(bytes, at + 4) == sum[1];
    }
};

}  // namespace

bool is_log_damaged(const std::string& path) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path + "-wal", failed);
    if (failed || size <= kHeaderBytes || size > kMostLogBytes) return false;
    const Result<std::vector<std::byte>> log = read_file(path + "-wal");
    if (!log || log->size() <= kHeaderBytes) return false;
    const std::span<const std::byte> bytes = *log;
    const std::uint32_t magic = big_endian(bytes, 0);
    const std::size_t page = big_endian(bytes, 8), frame = kFrameHeaderBytes + page;
    LogSum sum{.is_big_endian = (magic & 1) != 0};
    sum.add(bytes.first(kSummedOfHeader));
    if ((magic & ~1u) != kMagic || page == 0 || page > kLargestPage || !sum.is_at(bytes, kSummedOfHeader)) return true;
    bool is_readable = true;
    for (std::size_t at = kHeaderBytes; at + frame <= bytes.size(); at += frame) {
        // Frames of an earlier round of the log, whose place was not written again, have other salts.
        const bool is_of_this_round =
            big_endian(bytes, at + 8) == big_endian(bytes, 16) && big_endian(bytes, at + 12) == big_endian(bytes, 20);
        if (is_readable) {
            sum.add(bytes.subspan(at, kSummedOfFrame));
            sum.add(bytes.subspan(at + kFrameHeaderBytes, page));
            is_readable = is_of_this_round && sum.is_at(bytes, at + 16);
        }
        const bool ends_a_transaction = big_endian(bytes, at + 4) != 0;
        if (!is_readable && is_of_this_round && ends_a_transaction) return true;
    }
    return false;
}

}  // namespace burin::document
