// SPDX-License-Identifier: MIT
// A block: the rows of about a second of one hand's ticks, column after column, compressed.
//
// Layout before compression: all rows of the first column, then all of the second, and so on; little-endian, 8 bytes a
// value (f64, i64) or 4 (u32). Compressed by zstd, level 3, as one frame that states its size. The check sum is CRC-32C
// of 28 bytes (hand u32, tick0 i64, rows u32, t0_ns i64, length of the data u32, little-endian) and of the compressed
// data. Why so, in figures: docs/decisions/025-recorded-ticks.md.
//
// Unpacking takes data from anywhere: it checks the sum, the number of rows and both sizes before it allocates, and
// allocates at most kMostBlockBytes. Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "record/columns.hpp"

namespace burin::record {

inline constexpr std::uint32_t kMostBlockRows = 1u << 14;              // 16 s of ticks
inline constexpr std::size_t kMostColumns = 1024;                      // of a hand
inline constexpr std::size_t kMostBlockBytes = std::size_t{64} << 20;  // uncompressed

struct BlockHeader {
    std::uint32_t hand = 0;
    std::int64_t tick0 = 0;  // of its first row
    std::uint32_t rows = 0;
    Nanoseconds t0_ns = 0;  // time of its first row

    bool operator==(const BlockHeader&) const = default;
};

struct PackedBlock {
    BlockHeader header;
    std::uint32_t crc = 0;
    std::vector<std::byte> data;  // compressed
};

[[nodiscard]] std::uint32_t crc_of(const BlockHeader& header, std::span<const std::byte> data);

// The rows of a block while it is filled, and after it has been unpacked.
class Block {
public:
    Block() = default;
    // Takes the types of the columns; rows come by add().
    explicit Block(std::vector<ColumnType> types) : types_(std::move(types)), columns_(types_.size()) {}

    [[nodiscard]] std::uint32_t rows() const { return rows_; }
    [[nodiscard]] std::size_t columns() const { return types_.size(); }
    [[nodiscard]] ColumnType type(std::size_t column) const { return types_[column]; }
    // The bits of a value, whatever its type.
    [[nodiscard]] Word at(std::size_t column, std::uint32_t row) const;
    // All values of a column as bytes, as the block holds them.
    [[nodiscard]] std::span<const std::byte> bytes(std::size_t column) const { return columns_[column]; }

    // Appends a row, one word for each column.
    void add(std::span<const Word> row);
    void clear();

private:
    friend Result<PackedBlock> pack(const Block& block, BlockHeader header);
    friend Result<Block> unpack(const PackedBlock& packed, std::span<const ColumnType> types, const std::string& where);

    std::vector<ColumnType> types_;
    std::vector<std::vector<std::byte>> columns_;
    std::uint32_t rows_ = 0;
};

// Compresses the block; the header's number of rows is taken from the block.
[[nodiscard]] Result<PackedBlock> pack(const Block& block, BlockHeader header);

// Checks and unpacks. `where` names file and block in the message of a failure.
[[nodiscard]] Result<Block> unpack(const PackedBlock& packed, std::span<const ColumnType> types,
                                   const std::string& where);

}  // namespace burin::record
