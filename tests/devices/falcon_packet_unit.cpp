// SPDX-License-Identifier: MIT
#include "devices/falcon/falcon_packet.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace burin::devices {
namespace {

std::string text_of(const FalconBytes& bytes) {
    std::string text;
    for (const std::byte byte : bytes) text += static_cast<char>(byte);
    return text;
}
FalconBytes packet(std::string_view text) {
    FalconBytes bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(text[i]);
    return bytes;
}
std::vector<FalconBytes> found_in(FalconReader& reader, std::string_view text) {
    std::vector<FalconBytes> found;
    for (const char one : text)
        if (const auto whole = reader.take(static_cast<std::byte>(one))) found.push_back(*whole);
    return found;
}

}  // namespace

TEST(FalconPacket, SaysItsNumbersInNibblesTheLowestFirst) {
    // 0x1234: 4 3 2 1 above 'A'; -1: four times 15; 4096 = 0x1000. Green (2) and homing (1): 3 above 'A'.
    EXPECT_EQ(text_of(falcon_bytes(FalconCommand{{0x1234, -1, 4096}, kFalconGreen, true})), "<EDCBPPPPAAABDA>");
    // Buttons 5 and encoders 0 and 2 homed: 0x55 above 'A' is 0x96.
    EXPECT_EQ(text_of(falcon_bytes(FalconReport{{0, 0, 0}, 5, 5})),
              "<AAAAAAAAAAAA\x96"
              "A>");
    EXPECT_EQ(falcon_command(packet("<EDCBPPPPAAABDA>")), (FalconCommand{{0x1234, -1, 4096}, kFalconGreen, true}));
}

TEST(FalconPacket, ReadsWhatItWrites) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> number(-32768, 32767), small(0, 127);
    for (int i = 0; i < 10'000; ++i) {
        const FalconCounts counts{static_cast<std::int16_t>(number(random)), static_cast<std::int16_t>(number(random)),
                                  static_cast<std::int16_t>(number(random))};
        const int states = small(random);
        const FalconReport report{counts, static_cast<std::uint8_t>(states & 15),
                                  static_cast<std::uint8_t>(states >> 4)};
        ASSERT_EQ(falcon_report(falcon_bytes(report)), report);
        const FalconCommand command{counts, static_cast<std::uint8_t>(states & 0xe), states % 2 == 1};
        ASSERT_EQ(falcon_command(falcon_bytes(command)), command);
    }
}

TEST(FalconPacket, RefusesBytesThatNoneHas) {
    EXPECT_TRUE(falcon_report(packet("<AAAAAAAAAAAAAA>")));
    EXPECT_TRUE(falcon_report(packet("<AAAAAAAAAAAAA?>"))) << "the last but one says nothing";
    for (const char* bad : {"(AAAAAAAAAAAAAA>", "<AAAAAAAAAAAAAA)", "<AAAAAAAAAAAA@A>", "<@AAAAAAAAAAAAA>",
                            "<AAAAAAAAAAAQAA>", "<AAAAAA AAAAAAA>",
                            "<AAAAAAAAAAAA\xc1"
                            "A>"})
        EXPECT_FALSE(falcon_report(packet(bad))) << bad;
    EXPECT_FALSE(falcon_command(packet("<AAAAAAAAAAAAQA>"))) << "more than the lamps and homing";
}

TEST(FalconPacket, IsFoundAgainAfterRubbishAndCountsIt) {
    FalconReader reader;
    EXPECT_EQ(found_in(reader, "xyz<AAAAAAAAAAAAAA>").size(), 1u);
    EXPECT_EQ(reader.dropped(), 3u);
    EXPECT_EQ(found_in(reader, "<AAAA<AAAAAAAAAAAAAA>").size(), 1u) << "one that was cut, and a whole one";
    EXPECT_EQ(reader.dropped(), 8u);
    EXPECT_EQ(found_in(reader, "<AAAA>").size(), 0u);
    EXPECT_EQ(reader.dropped(), 14u);
    EXPECT_EQ(found_in(reader, "<AAAAAAAAAAAAAAA>").size(), 0u) << "one byte too many";
    EXPECT_EQ(found_in(reader, "<BAAA").size() + found_in(reader, "AAAAAAAAAA").size(), 0u);
    const auto found = found_in(reader, ">");
    ASSERT_EQ(found.size(), 1u) << "in pieces";
    EXPECT_EQ(falcon_report(found.front())->encoders[0], 1);
    found_in(reader, "<AAAA");
    reader.forget();
    EXPECT_EQ(found_in(reader, "AAAAAAAAAA>").size(), 0u);
}

}  // namespace burin::devices
