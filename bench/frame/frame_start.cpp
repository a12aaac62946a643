// SPDX-License-Identifier: MIT
#include "bench/frame/frame_start.hpp"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace burin::bench {
namespace {

// Returns the start time since boot: proc(5), field 22 of /proc/pid/stat, in clock ticks. The second field, in
// brackets, may contain blanks.
double started_ms() {
    std::ifstream file("/proc/self/stat");
    std::string line;
    std::getline(file, line);
    const std::size_t bracket = line.rfind(')');
    if (bracket == std::string::npos) return -1.0;
    std::istringstream rest(line.substr(bracket + 1));
    std::string field;
    for (int i = 3; i <= 22; ++i) rest >> field;
    if (!rest) return -1.0;
    return 1e3 * std::stod(field) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

double wall_since_start_ms() {
    static const double start_ms = started_ms();
    if (start_ms < 0.0) return 0.0;
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec) - start_ms;
}

}  // namespace burin::bench
