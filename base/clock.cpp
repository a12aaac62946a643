// SPDX-License-Identifier: MIT
#include "base/clock.hpp"

#include <cerrno>
#include <ctime>

namespace burin {

Nanoseconds MonotonicClock::now_ns() noexcept {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<Nanoseconds>(t.tv_sec) * kNanosecondsPerSecond + t.tv_nsec;
}

void MonotonicClock::sleep_until(Nanoseconds deadline_ns) noexcept {
    timespec t{};
    t.tv_sec = deadline_ns / kNanosecondsPerSecond;
    t.tv_nsec = deadline_ns % kNanosecondsPerSecond;
    // An absolute deadline does not drift; a signal only means: sleep again.
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
    }
}

void MonotonicClock::spin_until(Nanoseconds deadline_ns) noexcept {
    while (now_ns() < deadline_ns) {
    }
}

}  // namespace burin
