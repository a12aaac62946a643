// SPDX-License-Identifier: MIT
#include "bench/measure/timing.hpp"

#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

namespace burin::bench {
namespace {

double now_ms(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

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

double process_cpu_ms() { return now_ms(CLOCK_PROCESS_CPUTIME_ID); }

double wall_since_start_ms() {
    static const double start_ms = started_ms();
    return start_ms < 0.0 ? 0.0 : now_ms(CLOCK_BOOTTIME) - start_ms;
}

std::string machine() {
    std::string name = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            name = line.substr(colon + 2);
            break;
        }
    }
    std::array<double, 1> load{};
    std::array<char, 32> busy{};
    if (getloadavg(load.data(), 1) == 1) std::snprintf(busy.data(), busy.size(), ", load %.1f", load[0]);
    return std::to_string(std::thread::hardware_concurrency()) + " x " + name + busy.data();
}

}  // namespace burin::bench
