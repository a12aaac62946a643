// SPDX-License-Identifier: MIT
// Time measurement for the benchmarks: wall time, and the processor time of the whole process beside it (which stays
// meaningful on a machine that is busy with other work); and the machine on which it is measured. Milliseconds;
// base/statistics.hpp makes figures of many.
#pragma once

#include <string>

#include "base/clock.hpp"

namespace burin::bench {

// Returns the processor time of all threads of the process so far, ms.
[[nodiscard]] double process_cpu_ms();

// Returns the wall time since the system started this process, ms, to 10 ms: from /proc/self/stat, which counts in
// hundredths of a second. 0 where the system does not provide it.
[[nodiscard]] double wall_since_start_ms();

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

// Returns "2 x Intel(R) Xeon(R) Processor, load 0.1": the cores, the processor's name where the system provides it, and
// the load average of the last minute (0: quiet).
[[nodiscard]] std::string machine();

}  // namespace burin::bench
