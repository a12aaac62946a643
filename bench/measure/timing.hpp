// SPDX-License-Identifier: MIT
// Time measurement for the benchmarks: wall time, and the processor time of the whole process beside it (which stays
// meaningful on a machine that is busy with other work). Milliseconds; base/statistics.hpp makes figures of many.
#pragma once

#include "base/clock.hpp"

namespace burin::bench {

// Returns the processor time of all threads of the process so far, ms.
[[nodiscard]] double process_cpu_ms();

// Measures the wall time between calls of lap_ms().
class Stopwatch {
public:
    Stopwatch() : last_ns_(clock_.now_ns()) {}
    [[nodiscard]] double lap_ms() {
        const Nanoseconds before_ns = last_ns_;
        last_ns_ = clock_.now_ns();
        return 1e3 * seconds(last_ns_ - before_ns);
    }

private:
    MonotonicClock clock_;
    Nanoseconds last_ns_;
};

}  // namespace burin::bench
