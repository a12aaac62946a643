// SPDX-License-Identifier: MIT
#include "base/ring.hpp"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <thread>

namespace burin {

TEST(Ring, RoundsItsCapacityUpToAPowerOfTwo) {
    EXPECT_EQ(Ring<int>(0).capacity(), 2u);
    EXPECT_EQ(Ring<int>(1).capacity(), 2u);
    EXPECT_EQ(Ring<int>(2).capacity(), 2u);
    EXPECT_EQ(Ring<int>(3).capacity(), 4u);
    EXPECT_EQ(Ring<int>(1000).capacity(), 1024u);
    EXPECT_EQ(Ring<int>(1024).capacity(), 1024u);
}

TEST(Ring, AnEmptyRingGivesNothingAndLeavesTheTargetAlone) {
    Ring<int> ring(4);
    int value = 7;
    EXPECT_FALSE(ring.pop(value));
    EXPECT_EQ(value, 7);
}

TEST(Ring, AFullRingRefusesAndCountsWithoutLosingWhatItHolds) {
    Ring<int> ring(4);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
    EXPECT_EQ(ring.refused(), 0u);
    EXPECT_FALSE(ring.push(99));
    EXPECT_FALSE(ring.push(99));
    EXPECT_EQ(ring.refused(), 2u);
    int value = -1;
    EXPECT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 0);
    EXPECT_TRUE(ring.push(4));  // one place free again
    EXPECT_FALSE(ring.push(99));
    for (int i = 1; i <= 4; ++i) {
        EXPECT_TRUE(ring.pop(value));
        EXPECT_EQ(value, i);
    }
    EXPECT_FALSE(ring.pop(value));
}

TEST(Ring, TheOldestStaysUntilItIsPopped) {
    Ring<int> ring(2);
    EXPECT_EQ(ring.oldest(), nullptr);
    ring.push(5);
    ring.push(6);
    ASSERT_NE(ring.oldest(), nullptr);
    EXPECT_EQ(*ring.oldest(), 5);
    EXPECT_EQ(*ring.oldest(), 5);
    int value = 0;
    EXPECT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 5);
    EXPECT_EQ(*ring.oldest(), 6);
    EXPECT_TRUE(ring.pop(value));
    EXPECT_EQ(ring.oldest(), nullptr);
}

TEST(Ring, ShowsWhatWaitsAndDropsTheOldest) {
    Ring<int> ring(4);
    EXPECT_EQ(ring.waiting(), 0u);
    for (int next = 0; next < 11; next += 3) {
        for (int i = 0; i < 3; ++i) ASSERT_TRUE(ring.push(next + i));
        ASSERT_EQ(ring.waiting(), 3u);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(ring.at(i), next + static_cast<int>(i));
        ring.drop();
        EXPECT_EQ(ring.at(0), next + 1);
        ring.drop();
        ring.drop();
        EXPECT_EQ(ring.waiting(), 0u);
    }
}

TEST(Ring, BehavesAsAQueueThroughManyWrapArounds) {
    Ring<int> ring(8);
    std::deque<int> model;
    std::uint32_t random = 1;
    std::uint64_t refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        random = random * 1664525u + 1013904223u;
        if ((random >> 16) % 2 == 0) {
            const bool room = model.size() < ring.capacity();
            EXPECT_EQ(ring.push(i), room);
            if (room) model.push_back(i);
            refused += !room;
        } else {
            int value = -1;
            EXPECT_EQ(ring.pop(value), !model.empty());
            if (model.empty()) continue;
            EXPECT_EQ(value, model.front());
            model.pop_front();
        }
    }
    EXPECT_EQ(ring.refused(), refused);
}

TEST(Ring, TwoThreadsLoseNothingTearNothingAndKeepTheOrder) {
    using Wide = std::array<std::uint64_t, 32>;
    Ring<Wide> ring(16);  // small, so that both edges are met all the time
    constexpr std::uint64_t kLast = 300'000;
    std::uint64_t refused_by_producer = 0;
    std::thread producer([&] {
        Wide value;
        for (std::uint64_t i = 1; i <= kLast; ++i) {
            value.fill(i);
            while (!ring.push(value)) {
                ++refused_by_producer;
                std::this_thread::yield();
            }
        }
    });
    std::uint64_t next = 1, wrong = 0;
    Wide value;
    while (next <= kLast) {
        if (!ring.pop(value)) {
            std::this_thread::yield();
            continue;
        }
        for (const std::uint64_t word : value) wrong += word != next;
        ++next;
    }
    producer.join();
    EXPECT_EQ(wrong, 0u);
    EXPECT_FALSE(ring.pop(value));
    EXPECT_EQ(ring.refused(), refused_by_producer);
}

}  // namespace burin
