// SPDX-License-Identifier: MIT
#include "record/block.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "base/try.hpp"
#include "record/compressed.hpp"
#include "record/crc32c.hpp"

namespace burin::record {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they lie in memory");

constexpr const char* kDamagedRemedy = "the other blocks can still be read; burin session check names all that cannot";

template <typename T>
std::byte* put(std::byte* to, T value) {
    std::memcpy(to, &value, sizeof value);
    return to + sizeof value;
}

std::size_t row_bytes(std::span<const ColumnType> types) {
    std::size_t sum = 0;
    for (const ColumnType type : types) sum += size_of(type);
    return sum;
}

}  // namespace

std::uint32_t crc_of(const BlockHeader& header, std::span<const std::byte> data) {
    std::array<std::byte, 28> bytes{};
    std::byte* to = put(bytes.data(), header.hand);
    to = put(to, header.tick0);
    to = put(to, header.rows);
    to = put(to, header.t0_ns);
    put(to, static_cast<std::uint32_t>(data.size()));
    return crc32c(data, crc32c(bytes));
}

Word Block::at(std::size_t column, std::uint32_t row) const {
    const std::size_t size = size_of(types_[column]);
    Word word = 0;
    std::memcpy(&word, columns_[column].data() + row * size, size);
    return word;
}

void Block::add(std::span<const Word> row) {
    BURIN_CHECK(row.size() == types_.size());
    for (std::size_t c = 0; c < types_.size(); ++c) {
        std::vector<std::byte>& column = columns_[c];
        const std::size_t at = column.size(), size = size_of(types_[c]);
        column.resize(at + size);
        std::memcpy(column.data() + at, &row[c], size);
    }
    ++rows_;
}

void Block::clear() {
    for (std::vector<std::byte>& column : columns_) column.clear();
    rows_ = 0;
}

Result<PackedBlock> pack(const Block& block, BlockHeader header) {
    header.rows = block.rows_;
    std::vector<std::byte> raw;
    raw.reserve(block.rows_ * row_bytes(block.types_));
    for (const std::vector<std::byte>& column : block.columns_) raw.insert(raw.end(), column.begin(), column.end());
    BURIN_TRY(data, compressed(raw));
    PackedBlock packed{header, 0, std::move(data)};
    packed.crc = crc_of(header, packed.data);
    return packed;
}

Result<Block> unpack(const PackedBlock& packed, std::span<const ColumnType> types, const std::string& where) {
    const std::uint32_t rows = packed.header.rows;
    if (crc_of(packed.header, packed.data) != packed.crc) return fail(where, "its check sum is wrong", kDamagedRemedy);
    const std::size_t each = row_bytes(types), size = each * rows;
    if (rows == 0 || rows > kMostBlockRows || types.empty() || types.size() > kMostColumns || size > kMostBlockBytes)
        return fail(where, "claims " + std::to_string(rows) + " rows of " + std::to_string(each) + " bytes",
                    kDamagedRemedy);
    BURIN_TRY(raw, decompressed(packed.data, size, where, kDamagedRemedy));
    Block block(std::vector<ColumnType>(types.begin(), types.end()));
    block.rows_ = rows;
    auto from = raw.cbegin();
    for (std::size_t c = 0; c < types.size(); ++c) {
        const auto to = from + static_cast<std::ptrdiff_t>(rows * size_of(types[c]));
        block.columns_[c].assign(from, to);
        from = to;
    }
    return block;
}

}  // namespace burin::record
