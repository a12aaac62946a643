// SPDX-License-Identifier: MIT
// What the list of blocks tells of a hand: each block has its own length, and a gap begins where that ends.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "record/examination.hpp"

namespace burin::record {
namespace {

struct ListedBlock {
    std::int64_t first = 0;
    std::uint32_t rows = 0;
};

HandRecord hand_of_blocks(const std::vector<ListedBlock>& blocks) {
    HandRecord hand;
    for (const ListedBlock& block : blocks)
        hand.blocks.push_back({static_cast<std::int64_t>(hand.blocks.size()) + 1,
                               {2, block.first, block.rows, 7'000'000 + 1'000'000 * block.first}});
    return hand;
}

struct ListedGap {
    std::int64_t until = 0, missing = 0;
    bool operator==(const ListedGap&) const = default;
};

void PrintTo(const ListedGap& gap, std::ostream* to) { *to << gap.missing << " until " << gap.until; }

std::vector<ListedGap> gaps_of(const HandSummary& summary) {
    std::vector<ListedGap> gaps;
    for (const TickGap& gap : summary.gaps) gaps.push_back({gap.after_tick, gap.missing});
    return gaps;
}

}  // namespace

TEST(HandSummary, TellsTheGapsBetweenBlocksWhateverTheirLengths) {
    struct Case {
        const char* what;
        std::vector<ListedBlock> blocks;
        std::vector<ListedGap> gaps;  // until its last missing tick, and how many are missing
    };
    const std::vector<Case> cases{
        {"one block", {{5, 100}}, {}},
        {"even blocks", {{0, 100}, {100, 100}, {200, 100}}, {}},
        {"a short block in the middle", {{0, 100}, {100, 37}, {137, 100}, {237, 100}}, {}},
        {"a short block at the beginning", {{3, 20}, {23, 100}, {123, 100}}, {}},
        {"a short block at the end", {{0, 100}, {100, 100}, {200, 1}}, {}},
        {"a long block in the middle", {{0, 10}, {10, 400}, {410, 10}, {420, 10}}, {}},
        {"a gap before a short block", {{0, 100}, {109, 37}, {146, 100}}, {{108, 9}}},
        {"a gap after a short block", {{0, 100}, {100, 37}, {150, 100}}, {{149, 13}}},
        {"gaps on both sides of a short block", {{0, 100}, {104, 37}, {142, 100}}, {{103, 4}, {141, 1}}},
        {"gaps of several lengths", {{10, 5}, {17, 50}, {70, 1}, {90, 8}}, {{16, 2}, {69, 3}, {89, 19}}},
        {"a block that begins before the last has ended", {{0, 100}, {90, 10}, {100, 20}}, {{89, -10}}}};
    for (const Case& of : cases) {
        const HandRecord hand = hand_of_blocks(of.blocks);
        const HandSummary summary = summary_of(hand);
        EXPECT_EQ(gaps_of(summary), of.gaps) << of.what;
        std::uint64_t ticks = 0;
        for (const ListedBlock& block : of.blocks) ticks += block.rows;
        EXPECT_EQ(summary.ticks, ticks) << of.what;
        EXPECT_EQ(summary.first_tick, of.blocks.front().first) << of.what;
        EXPECT_EQ(summary.first_ns, 7'000'000 + 1'000'000 * of.blocks.front().first) << of.what;
        EXPECT_EQ(summary.last_block_ns, 7'000'000 + 1'000'000 * of.blocks.back().first) << of.what;
    }
}

TEST(HandSummary, OfAHandWithoutBlocksIsEmpty) {
    const HandSummary summary = summary_of({});
    EXPECT_EQ(summary.ticks, 0u);
    EXPECT_TRUE(summary.gaps.empty());
}

}  // namespace burin::record
