// SPDX-License-Identifier: MIT
// Blocks: the check sum's published values, and what is refused.
#include "record/block.hpp"

#include <gtest/gtest.h>

#include <zstd.h>
#include <array>
#include <cstring>

#include <string>

#include "record/crc32c.hpp"

namespace burin::record {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

Block two_columns(std::uint32_t rows) {
    Block block({ColumnType::i64, ColumnType::u32});
    for (Word row = 0; row < rows; ++row) block.add(std::array<Word, 2>{row * 1000, row});
    return block;
}

const std::vector<ColumnType> kTwo{ColumnType::i64, ColumnType::u32};

}  // namespace

TEST(Crc32c, HasThePublishedValues) {
    EXPECT_EQ(crc32c(bytes_of("123456789")), 0xE3069283u);              // the check value of CRC catalogues
    EXPECT_EQ(crc32c(bytes_of(std::string(32, '\0'))), 0x8A9136AAu);    // RFC 3720, B.4
    EXPECT_EQ(crc32c(bytes_of(std::string(32, '\xff'))), 0x62A8AB43u);  // RFC 3720, B.4
    EXPECT_EQ(crc32c(bytes_of("56789"), crc32c(bytes_of("1234"))), 0xE3069283u);
}

TEST(Block, EveryChangedBitOfDataOrHeaderIsNoticed) {
    const PackedBlock sound = *pack(two_columns(40), {3, 11, 0, 123});
    ASSERT_TRUE(unpack(sound, kTwo, "block"));
    for (std::size_t at = 0; at < sound.data.size(); ++at) {
        PackedBlock changed = sound;
        changed.data[at] ^= std::byte{static_cast<unsigned char>(1u << (at % 8))};
        EXPECT_FALSE(unpack(changed, kTwo, "block")) << at;
    }
    for (const BlockHeader& header : {BlockHeader{2, 11, 40, 123}, BlockHeader{3, 12, 40, 123},
                                      BlockHeader{3, 11, 39, 123}, BlockHeader{3, 11, 40, 124}}) {
        PackedBlock changed = sound;
        changed.header = header;
        EXPECT_FALSE(unpack(changed, kTwo, "block"));
    }
}

TEST(Block, ClaimsThatItsDataDoNotKeepAreRefusedWithASumThatFits) {
    const PackedBlock sound = *pack(two_columns(40), {0, 1, 0, 0});
    for (const std::uint32_t rows : {0u, 39u, 41u, kMostBlockRows, kMostBlockRows + 1, 0xffffffffu}) {
        PackedBlock changed = sound;
        changed.header.rows = rows;
        changed.crc = crc_of(changed.header, changed.data);
        const auto refused = unpack(changed, kTwo, "FILE: block 1");
        ASSERT_FALSE(refused) << rows;
        EXPECT_EQ(refused.error().where, "FILE: block 1");
        EXPECT_FALSE(refused.error().remedy.empty());
    }
    PackedBlock cut = sound;
    cut.data.resize(cut.data.size() / 2);
    cut.crc = crc_of(cut.header, cut.data);
    EXPECT_FALSE(unpack(cut, kTwo, "block"));
    PackedBlock none = sound;
    none.data.clear();
    none.crc = crc_of(none.header, none.data);
    EXPECT_FALSE(unpack(none, kTwo, "block"));
    EXPECT_FALSE(unpack(sound, {}, "block"));
    EXPECT_FALSE(unpack(sound, std::vector(2000, ColumnType::f64), "block"));
}

TEST(Block, TheFrameIsOneThatZstdItselfReads) {
    const PackedBlock packed = *pack(two_columns(3), {0, 1, 0, 0});
    std::array<std::byte, 36> raw{};
    ASSERT_EQ(ZSTD_decompress(raw.data(), raw.size(), packed.data.data(), packed.data.size()), raw.size());
    const std::array<unsigned char, 36> wanted{0, 0, 0, 0, 0, 0, 0, 0, 0xe8, 3, 0, 0, 0, 0, 0, 0, 0xd0, 7,
                                               0, 0, 0, 0, 0, 0, 0, 0, 0,    0, 1, 0, 0, 0, 2, 0, 0,    0};
    EXPECT_EQ(std::memcmp(raw.data(), wanted.data(), wanted.size()), 0) << "8-byte column, then 4-byte column";
}

}  // namespace burin::record
