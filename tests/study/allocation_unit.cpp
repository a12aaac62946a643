// SPDX-License-Identifier: MIT
#include "study/assign/sealed_list.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

namespace burin::study {
namespace {

std::string groups_of(std::uint64_t seed, std::uint64_t stratum, std::size_t places) {
    std::string text;
    for (const AllocationPlace& p : allocate(std::array{1u, 1u}, std::array{4u}, seed, stratum, places))
        text += static_cast<char>('a' + p.group);
    return text;
}

TEST(StudyAllocation, DrawsEveryOrderOfABlockEquallyOften) {
    // Six orders of aabb; chi-squared with 5 degrees of freedom exceeds 20.5 once in a thousand. Seeds are fixed.
    std::map<std::string, int> counts;
    constexpr int kBlocks = 6000;
    for (int seed = 0; seed < kBlocks; ++seed) ++counts[groups_of(static_cast<std::uint64_t>(seed), 0, 4)];
    ASSERT_EQ(counts.size(), 6u);
    double chi_squared = 0.0;
    for (const auto& [order, count] : counts) chi_squared += std::pow(count - kBlocks / 6.0, 2.0) / (kBlocks / 6.0);
    EXPECT_LT(chi_squared, 20.5);
}

TEST(StudyAllocation, StrataAndSeedsHaveListsOfTheirOwn) {
    EXPECT_EQ(groups_of(7, 0, 40), groups_of(7, 0, 40));
    EXPECT_NE(groups_of(7, 0, 40), groups_of(7, 1, 40));
    EXPECT_NE(groups_of(7, 0, 40), groups_of(8, 0, 40));
}

TEST(StudyAllocation, CombinesTheCodesOfAllStrata) {
    const std::array strata{Stratum{"hand", {"l", "r"}}, Stratum{"sex", {"f", "m", "x"}}};
    const auto all = combinations(strata);
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(stratum_label(all[0]), "l/f");
    EXPECT_EQ(stratum_label(all[5]), "r/x");
    EXPECT_EQ(stratum_label(combinations({})[0]), "all");
}

Protocol two_groups() {
    Protocol protocol;
    for (const char* code : {"touch", "sight"}) {
        Group group;
        group.code = code;
        protocol.groups.push_back(group);
    }
    return protocol;
}

TEST(StudySealedList, OpensPlaceByPlaceAndShowsNoGroupBefore) {
    const Protocol protocol = two_groups();
    const auto list = allocate(std::array{1u, 1u}, std::array{2u, 4u}, 7, 0, 12);
    const std::string sealed = seal_allocation(protocol, {list}, "a key");
    EXPECT_FALSE(sealed.contains("touch") || sealed.contains("sight")) << sealed;
    EXPECT_EQ(places_in(sealed, "all"), 12u);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto place = open_place(sealed, protocol, "a key", "all", i + 1);
        ASSERT_TRUE(place);
        EXPECT_EQ(place->group, list[i].group);
        EXPECT_EQ(place->block, list[i].block);
    }
    // Two places of one group in one block look nothing like each other.
    std::map<std::string, int> seen;
    for (std::size_t at = 0; at + 64 < sealed.size(); at = sealed.find('\n', at) + 1)
        ++seen[sealed.substr(sealed.find(' ', at + 4), 40)];
    EXPECT_EQ(seen.size(), 12u);
}

TEST(StudySealedList, TellsOfAnotherKeyAChangedLineAndAFullList) {
    const Protocol protocol = two_groups();
    std::string sealed = seal_allocation(protocol, {allocate(std::array{1u, 1u}, std::array{2u}, 7, 0, 4)}, "a key");
    const auto other = open_place(sealed, protocol, "another", "all", 1);
    ASSERT_FALSE(other);
    EXPECT_TRUE(other.error().line().contains("does not open")) << other.error().line();
    const auto full = open_place(sealed, protocol, "a key", "all", 5);
    ASSERT_FALSE(full);
    EXPECT_TRUE(full.error().line().contains("all 4 places of stratum all are taken")) << full.error().line();
    // The digits of a group's letter, so that the place would name another.
    const std::size_t letter = sealed.find(' ', 4) + 1 + 2 * 2;
    sealed[letter] = sealed[letter] == '0' ? '1' : '0';
    EXPECT_FALSE(open_place(sealed, protocol, "a key", "all", 1));
    EXPECT_TRUE(open_place(sealed, protocol, "a key", "all", 2));
    EXPECT_FALSE(open_place("all 1 ", protocol, "a key", "all", 1));
}

}  // namespace
}  // namespace burin::study
