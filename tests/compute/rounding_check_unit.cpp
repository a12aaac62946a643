// SPDX-License-Identifier: MIT
// The numbers that a device's rounding is tried with.
#include "compute/vulkan/rounding_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace burin::compute::test {

// By the remainder, which a fused product gives: next to half-way it is half a unit in the last place times the divisor
// or, of a root, a whole one times the root.
TEST(HardRoundings, QuotientsAndRootsLieNextToHalfWay) {
    const std::vector<CheckedRounding> cases = hard_roundings();
    EXPECT_EQ(cases.size(), 4096u);
    const auto unit_of = [](double x) { return std::nextafter(std::abs(x), HUGE_VAL) - std::abs(x); };
    int above = 0, roots_above = 0;
    for (const CheckedRounding& c : cases) {
        const double quotient = c.rounded.quotient, root = c.rounded.root;
        EXPECT_EQ(quotient, c.numbers.a / c.numbers.b);
        EXPECT_EQ(root, std::sqrt(c.numbers.radicand));
        const double left = std::fma(-quotient, c.numbers.b, c.numbers.a);
        EXPECT_NEAR(std::abs(left) / (0.5 * unit_of(quotient) * c.numbers.b), 1.0, 0x1p-40);
        const double left_of_root = std::fma(-root, root, c.numbers.radicand);
        EXPECT_NEAR(std::abs(left_of_root) / (unit_of(root) * root), 1.0, 0x1p-40);
        above += (left > 0.0) == (quotient > 0.0) ? 1 : 0;
        roots_above += left_of_root > 0.0 ? 1 : 0;
    }
    // About half of each is rounded up and the others down, so that a device which rounds one way only is found.
    EXPECT_GT(above, 1500);
    EXPECT_LT(above, 2600);
    EXPECT_GT(roots_above, 1500);
    EXPECT_LT(roots_above, 2600);
}

}  // namespace burin::compute::test
