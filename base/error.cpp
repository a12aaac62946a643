// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace burin {
namespace {
std::atomic<std::uint64_t> broken_count{0};
}

void contract_broken([[maybe_unused]] const char* expression, [[maybe_unused]] const char* file,
                     [[maybe_unused]] int line) noexcept {
    broken_count.fetch_add(1, std::memory_order_relaxed);  // a statistic; orders nothing
#ifndef NDEBUG
    std::fprintf(stderr, "%s:%d: broken contract: %s\n", file, line, expression);
    std::abort();
#endif
}

std::uint64_t broken_contracts() noexcept { return broken_count.load(std::memory_order_relaxed); }

}  // namespace burin
