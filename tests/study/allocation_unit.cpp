// SPDX-License-Identifier: MIT
#include "study/assign/allocation.hpp"

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

}  // namespace
}  // namespace burin::study
