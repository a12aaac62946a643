// SPDX-License-Identifier: MIT
#include "base/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace burin {

TEST(WorkerPool, RunsEveryIndexExactlyOnceForAnyThreadCount) {
    for (unsigned threads : {1u, 2u, 5u}) {
        WorkerPool pool(threads);
        for (std::size_t count : {0u, 1u, 2u, 1000u}) {
            std::vector<int> calls(count, 0);
            pool.run(count, [&](std::size_t i) { ++calls[i]; });
            for (int n : calls) EXPECT_EQ(n, 1);
        }
    }
}

TEST(WorkerPool, EverythingIsDoneWhenRunReturns) {
    WorkerPool pool(4);
    for (int round = 0; round < 500; ++round) {
        int sum = 0;
        std::vector<int> values(64);
        pool.run(values.size(), [&](std::size_t i) { values[i] = static_cast<int>(i); });
        for (int v : values) sum += v;
        ASSERT_EQ(sum, 64 * 63 / 2);
    }
}

}  // namespace burin
