// SPDX-License-Identifier: MIT
#include "devices/trackers/server_delay.hpp"

#include <gtest/gtest.h>

namespace burin::devices {
namespace {

constexpr Nanoseconds kDelayMs = 1'000'000, kSecond = kNanosecondsPerSecond;

}  // namespace

// A clock of another epoch that runs fast by 20 parts in a million, and a way of 2 to 7 ms.
TEST(ServerDelay, SeesALateReportWhateverTheServersClockSays) {
    ServerDelay delay;
    for (int i = 0; i < 60 * 600; ++i) {  // ten minutes at 60 a second
        const Nanoseconds sent_ns = i * kSecond / 60, way_ns = (2 + i % 6) * kDelayMs;
        const Nanoseconds late_ns = i % 1000 == 999 ? 300 * kDelayMs : 0;
        const Nanoseconds stamp_ns = 1'700'000'000 * kSecond + sent_ns + sent_ns / 50'000;
        const Nanoseconds told_ns = delay.note(stamp_ns, sent_ns + way_ns + late_ns);
        ASSERT_GE(told_ns, 0);
        // What the clock gains in two windows is 0.6 ms; the way differs by 5 ms.
        if (i <= 6) continue;
        ASSERT_NEAR(static_cast<double>(told_ns), static_cast<double>(late_ns), 6.0 * kDelayMs) << i;
    }
}

TEST(ServerDelay, BearsAClockThatIsSet) {
    ServerDelay delay;
    Nanoseconds now_ns = 0;
    const auto told_after = [&](Nanoseconds seconds, Nanoseconds set_ns) {
        Nanoseconds told_ns = 0;
        for (Nanoseconds until_ns = now_ns + seconds * kSecond; now_ns < until_ns; now_ns += 10 * kDelayMs)
            told_ns = delay.note(now_ns + set_ns, now_ns);
        return told_ns;
    };
    EXPECT_EQ(told_after(5, 0), 0);
    EXPECT_EQ(told_after(1, 3600 * kSecond), 0) << "set on";
    EXPECT_EQ(told_after(1, 0), 0) << "set back by an hour: no report is so late";
    EXPECT_EQ(told_after(1, -5 * kSecond), 5 * kSecond) << "set back by a little seems late";
    EXPECT_EQ(told_after(31, -5 * kSecond), 0) << "but not for long";
}

}  // namespace burin::devices
