// SPDX-License-Identifier: MIT
#include "bench/measure/machine.hpp"

#include <stdlib.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <thread>

namespace burin::bench {

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
