// SPDX-License-Identifier: MIT
#include "geometry/mesh/distinct_positions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace burin::geometry {
namespace {

using Key = std::tuple<float, float, float>;
Key key_of(const Vec3f& p) { return {p.x, p.y, p.z}; }

// As the header says it, a step at a time: of equal positions all but the first take one, until all differ.
std::size_t apart_by_single_steps(std::vector<Vec3f>& positions) {
    std::size_t steps = 0;
    for (bool differ = false; !differ;) {
        differ = true;
        std::set<Key> seen;
        for (Vec3f& p : positions) {
            if (seen.insert(key_of(p)).second) continue;
            p.x = std::nextafter(p.x, std::numeric_limits<float>::max());
            ++steps;
            differ = false;
        }
    }
    return steps;
}

TEST(DistinctPositions, ComeApartAsBySingleSteps) {
    std::mt19937 random(3);
    for (int time = 0; time < 50; ++time) {
        std::vector<Vec3f> positions;
        for (int i = 0; i < 60; ++i) {
            Vec3f p(0.0f, static_cast<float>(random() % 2), static_cast<float>(random() % 2));
            p.x = time % 2 == 0 ? 1.0f : -0.5f;
            for (auto step = random() % 6; step > 0; --step) p.x = std::nextafter(p.x, 2.0f);
            positions.push_back(p);
        }
        std::vector<Vec3f> expected = positions;
        const std::size_t steps = apart_by_single_steps(expected);
        EXPECT_EQ(make_distinct(positions), steps);
        EXPECT_EQ(positions, expected);
    }
}

// It took as many sorts of all positions as fell together.
TEST(DistinctPositions, AHundredThousandAtOnePlaceComeApartInOneSweep) {
    constexpr std::size_t kMany = 100'000;
    std::vector<Vec3f> positions(kMany, Vec3f(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(make_distinct(positions), kMany * (kMany - 1) / 2);
    std::ranges::sort(positions, {}, key_of);
    EXPECT_EQ(std::ranges::adjacent_find(positions), positions.end());
    EXPECT_EQ(positions.front(), Vec3f(1.0f, 2.0f, 3.0f));
}

}  // namespace
}  // namespace burin::geometry
