// SPDX-License-Identifier: MIT
// Minutes of ticks, hours where asked for (BURIN_SOAK_TICKS=36000000 are ten), on a disk that now and then does nothing
// for as long as ten seconds of ticks take to come: none is lost. Everything is counted; no time is measured.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "tests/record/failing_disk.hpp"
#include "tests/record/made_ticks.hpp"

namespace burin::record {

TEST(RecordSoak, NoTickIsLostHoweverOftenTheDiskStallsForTenSeconds) {
    const char* wanted = std::getenv("BURIN_SOAK_TICKS");
    const std::uint64_t ticks = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 150'000;
    const Workplace at;
    test::FailingDisk& disk = test::failing_disk();
    disk.reset();
    test::Recording recording(kRingTicks);
    WriterOptions options;
    options.vfs = test::FailingDisk::kName;
    ASSERT_TRUE(recording.begin(at / "a.session", options));

    std::atomic<std::uint64_t> pushed{0}, stalled_until{0};
    std::atomic<int> stalled{0}, flushes{0};
    disk.set_before_sync([&] {
        if (++flushes % 5 != 0) return;
        ++stalled;
        stalled_until = std::min(pushed + 10'000, ticks);
        while (pushed < stalled_until) std::this_thread::yield();
    });
    for (std::uint64_t tick = 1; tick <= ticks; ++tick) {
        // Faster than a session's, the ticks wait where the disk does not.
        while (recording.ring.waiting() > 4000 && pushed >= stalled_until) std::this_thread::yield();
        ASSERT_TRUE(recording.ring.push(test::made_tick(tick, 2))) << tick;
        pushed = tick;
    }
    const Result<void> closed = recording.writer->close();
    disk.reset();
    ASSERT_TRUE(closed) << closed.error().line();
    EXPECT_GT(stalled, 3);
    EXPECT_EQ(recording.ring.refused(), 0u);
    EXPECT_EQ(*test::sound_ticks(at / "a.session"), ticks);
    std::printf("%llu ticks, %d stalls, none lost\n", static_cast<unsigned long long>(ticks), stalled.load());
}

}  // namespace burin::record
