// SPDX-License-Identifier: MIT
#include "bench/measure/timing.hpp"

#include <time.h>

namespace burin::bench {

double process_cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace burin::bench
