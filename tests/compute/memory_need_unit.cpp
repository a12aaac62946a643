// SPDX-License-Identifier: MIT
#include "compute/rays/memory_need.hpp"

#include <gtest/gtest.h>

#include "compute/rays/solid.hpp"

namespace burin::compute::test {

TEST(MemoryNeed, GrowsWithTheSquareOfTheResolutionAndHoldsTheRays) {
    const Box unit{Vec3(0), Vec3(1)};
    const double coarse = static_cast<double>(memory_needed(*lattice_around(unit, 256)));
    const double fine = static_cast<double>(memory_needed(*lattice_around(unit, 512)));
    EXPECT_NEAR(fine / coarse, 4.0, 0.1);
    const Solid block = *make_block(Vec3(1), 64, {"block", {}});
    EXPECT_GT(memory_needed(block.lattice), block.bytes());
}

TEST(MemoryNeed, RefusesWhatDoesNotFitAndNamesWhatWould) {
    const Lattice lattice = *lattice_around({Vec3(0), Vec3(1)}, 2048);
    EXPECT_TRUE(check_memory(lattice, std::nullopt).has_value());
    EXPECT_TRUE(check_memory(lattice, std::uint64_t{1} << 40).has_value());
    const std::uint64_t little = 500'000'000;
    const auto refused = check_memory(lattice, little);
    ASSERT_FALSE(refused.has_value());
    const std::string line = refused.error().line();
    EXPECT_NE(line.find("resolution 2048"), std::string::npos) << line;
    EXPECT_NE(line.find("0.5 GB"), std::string::npos) << line;
    const std::size_t at = line.find("choose ");
    ASSERT_NE(at, std::string::npos) << line;
    const int fits = std::stoi(line.substr(at + 7));
    EXPECT_LE(memory_needed(*lattice_around({Vec3(0), Vec3(1)}, fits)), little) << line;
    EXPECT_GE(fits, 256);
    EXPECT_FALSE(check_memory(lattice, 1000).has_value());
}

TEST(MemoryNeed, TheMachineTells) { EXPECT_GT(memory_available().value_or(0), 1u << 20); }

}  // namespace burin::compute::test
