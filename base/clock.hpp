// SPDX-License-Identifier: MIT
// One monotonic clock in nanoseconds, and a simulated clock with the same interface. Real-time and simulated sessions
// run the same code; only the clock differs. now_ns() and sleep_until() are wait-free or block in the kernel; none
// allocates.
#pragma once

#include <time.h>

#include <cerrno>
#include <cstdint>

namespace burin {

using Nanoseconds = std::int64_t;  // since an arbitrary origin, the same for the whole process

inline constexpr Nanoseconds kNanosecondsPerSecond = 1'000'000'000;

[[nodiscard]] constexpr double seconds(Nanoseconds t_ns) { return static_cast<double>(t_ns) * 1e-9; }
// Rounds to the nearest nanosecond; |t_s| must stay below 2^53 ns (104 days).
[[nodiscard]] constexpr Nanoseconds nanoseconds(double t_s) {
    return static_cast<Nanoseconds>(t_s * 1e9 + (t_s < 0 ? -0.5 : 0.5));
}

class Clock {
public:
    virtual ~Clock() = default;
    [[nodiscard]] virtual Nanoseconds now_ns() noexcept = 0;
    // Returns at or after the absolute deadline; at once when it has passed.
    virtual void sleep_until(Nanoseconds deadline_ns) noexcept = 0;
    // Waits until the deadline without giving up the processor: exact to the nanosecond, but a core is busy. For
    // deadlines that are microseconds away.
    virtual void spin_until(Nanoseconds deadline_ns) noexcept { sleep_until(deadline_ns); }
};

// CLOCK_MONOTONIC. Any thread.
class MonotonicClock final : public Clock {
public:
    [[nodiscard]] Nanoseconds now_ns() noexcept override {
        timespec t{};
        clock_gettime(CLOCK_MONOTONIC, &t);
        return static_cast<Nanoseconds>(t.tv_sec) * kNanosecondsPerSecond + t.tv_nsec;
    }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        timespec t{};
        t.tv_sec = deadline_ns / kNanosecondsPerSecond;
        t.tv_nsec = deadline_ns % kNanosecondsPerSecond;
        // An absolute deadline does not drift; after a signal the loop sleeps again.
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
        }
    }
    void spin_until(Nanoseconds deadline_ns) noexcept override {
        while (now_ns() < deadline_ns) {
        }
    }
};

// Advances only when its user sleeps. One thread.
class SimulatedClock final : public Clock {
public:
    [[nodiscard]] Nanoseconds now_ns() noexcept override { return now_ns_; }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        if (deadline_ns > now_ns_) now_ns_ = deadline_ns;
    }

private:
    Nanoseconds now_ns_ = 0;
};

}  // namespace burin
