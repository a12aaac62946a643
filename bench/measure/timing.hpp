// SPDX-License-Identifier: MIT
// What the benchmarks measure time with: wall time, the processor time of the whole process beside it (which still tells
// something on a machine that is busy with other work), and order statistics of many updates. Milliseconds.
#pragma once

#include <vector>

#include "base/clock.hpp"

namespace burin::bench {

// Processor time of all threads of the process so far, ms.
[[nodiscard]] double process_cpu_ms();

// Wall time between calls of lap_ms().
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

// The value below which the given share of the values lies, by nearest rank; 0 when there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);
[[nodiscard]] inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }
[[nodiscard]] double sum(const std::vector<double>& values);

}  // namespace burin::bench
