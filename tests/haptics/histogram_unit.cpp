// SPDX-License-Identifier: MIT
#include "haptics/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "tests/haptics/rig.hpp"

namespace burin::haptics {

TEST(Histogram, BucketsFollowOneAnotherWithoutGapsAndAreAnEighthWide) {
    for (std::size_t bucket = 0; bucket + 1 < Histogram::kBuckets; ++bucket) {
        const Nanoseconds last = Histogram::last_of(bucket);
        EXPECT_EQ(Histogram::bucket_of(last), bucket);
        EXPECT_EQ(Histogram::bucket_of(last + 1), bucket + 1);
        if (bucket > 0) {
            const auto first = static_cast<double>(Histogram::last_of(bucket - 1) + 1);
            EXPECT_LE(static_cast<double>(last + 1) / first, bucket < 16 ? 2.0 : 1.126);
        }
    }
    EXPECT_EQ(Histogram::bucket_of(-5), 0u);
    EXPECT_EQ(Histogram::bucket_of(Nanoseconds{1} << 40), Histogram::kBuckets - 1);
    EXPECT_EQ(Histogram::bucket_of(std::numeric_limits<Nanoseconds>::max()), Histogram::kBuckets - 1);
}

TEST(Histogram, QuantilesAreThoseOfTheSortedValuesToWithinABucket) {
    std::mt19937_64 random(5);
    std::lognormal_distribution<double> times(9.0, 1.5);
    Histogram histogram;
    std::vector<Nanoseconds> values;
    EXPECT_EQ(histogram.quantile_ns(0.5), 0);
    for (int i = 0; i < 20000; ++i) {
        values.push_back(static_cast<Nanoseconds>(times(random)));
        histogram.add(values.back());
    }
    std::ranges::sort(values);
    EXPECT_EQ(histogram.total(), values.size());
    EXPECT_EQ(histogram.largest_ns(), values.back());
    for (const double q : {0.001, 0.25, 0.5, 0.99, 0.999, 1.0}) {
        const auto rank = static_cast<std::size_t>(std::ceil(q * 20000.0));
        const auto exact = static_cast<double>(values[rank - 1]);
        const auto read = static_cast<double>(histogram.quantile_ns(q));
        EXPECT_GE(read, exact) << q;
        EXPECT_LE(read, 1.126 * exact) << q;
    }
    EXPECT_EQ(histogram.quantile_ns(1.0), values.back());
}

TEST(Histogram, MayBeReadWhileItIsWritten) {
    Histogram histogram;
    std::thread writer([&] {
        for (int i = 0; i < 50000; ++i) histogram.add(i % 1000);
    });
    std::uint64_t last = 0;
    while (last < 50000) {
        const std::uint64_t now = histogram.total();
        ASSERT_GE(now, last);
        EXPECT_LE(histogram.quantile_ns(0.5), 1023);
        last = now;
    }
    writer.join();
    EXPECT_EQ(histogram.total(), 50000u);
}

namespace {

// Every look at it takes a microsecond, and a sleeper wakes 20 us late.
class TickingClock final : public Clock {
public:
    Nanoseconds now = 0;
    Nanoseconds now_ns() noexcept override { return now += 1000; }
    void sleep_until(Nanoseconds deadline_ns) noexcept override { now = std::max(now, deadline_ns) + 20'000; }
};

}  // namespace

TEST(Histogram, TheLoopKeepsHowLateItsTicksBeginAndHowLongTheyTake) {
    TickingClock clock;
    devices::SimulatedOmni omni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}}), {}, &clock);
    HapticChannels channels;
    HapticLoop loop(omni, clock, channels);
    loop.run_ticks(500);
    EXPECT_EQ(loop.lateness().total(), 500u);
    EXPECT_EQ(loop.duration().total(), 500u);
    EXPECT_EQ(loop.lateness().largest_ns(), 21'000);  // and the look at the clock
    // A tick looks at the clock itself, and so does the device: at least one look, at most a few.
    EXPECT_GE(loop.duration().quantile_ns(0.0), 1000);
    EXPECT_LE(loop.duration().largest_ns(), 6000);
    loop.step();
    EXPECT_EQ(loop.duration().total(), 500u);  // who steps by hand times by hand
}

}  // namespace burin::haptics
