// SPDX-License-Identifier: MIT
#include "renderer/surface/range_allocator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace burin::renderer {

// Against the plainest possible book: one flag an element.
TEST(RangeAllocator, NeverGivesAnElementTwiceAndForgetsNone) {
    std::mt19937 random(7);
    RangeAllocator ranges(500);
    std::vector<bool> taken(500, false);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> held;
    for (int step = 0; step < 20000; ++step) {
        if (step == 10000) {
            ranges.grow(800);
            taken.resize(800, false);
        }
        if (random() % 2 == 0 || held.empty()) {
            const auto size = static_cast<std::uint32_t>(1 + random() % 40);
            const auto first = ranges.allocate(size);
            if (!first) {
                std::uint32_t run = 0;
                for (const bool t : taken) {
                    run = t ? 0 : run + 1;
                    ASSERT_LT(run, size) << "there was room";
                }
                continue;
            }
            ASSERT_LE(*first + size, taken.size());
            for (std::uint32_t i = *first; i < *first + size; ++i) {
                ASSERT_FALSE(taken[i]);
                taken[i] = true;
            }
            held.emplace_back(*first, size);
        } else {
            std::swap(held[random() % held.size()], held.back());
            const auto [first, size] = held.back();
            held.pop_back();
            ranges.release(first, size);
            for (std::uint32_t i = first; i < first + size; ++i) taken[i] = false;
        }
        const auto free_count = static_cast<std::uint32_t>(std::count(taken.begin(), taken.end(), false));
        ASSERT_EQ(ranges.free_elements(), free_count);
    }
    for (const auto& [first, size] : held) ranges.release(first, size);
    EXPECT_EQ(ranges.allocate(800), 0u) << "all neighbours merge again";
}

}  // namespace burin::renderer
