// SPDX-License-Identifier: MIT
#include "gpu/driver_threads.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

namespace burin::gpu {
namespace {

constexpr const char* kVariable = "LP_NUM_THREADS";

}  // namespace

void leave_a_core_to_touch() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    setenv(kVariable, std::to_string(std::max(1u, cores - 1)).c_str(), 0);  // NOLINT(concurrency-mt-unsafe)
}

const char* driver_threads() {
    const char* threads = std::getenv(kVariable);  // NOLINT(concurrency-mt-unsafe)
    return threads != nullptr ? threads : "";
}

}  // namespace burin::gpu
