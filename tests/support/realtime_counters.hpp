// SPDX-License-Identifier: MIT
// Counts what the haptic thread must not do: allocations, locks, throws and files, by this thread, inside a scope.
// Link burin_realtime_counters into the test program: it replaces operator new, malloc, pthread_mutex_lock,
// __cxa_throw, fopen, open and their relatives for the whole program. Not under sanitizers, which replace the same
// symbols.
#pragma once

#include <cstdint>

namespace burin::test {

struct RealtimeCounts {
    std::uint64_t allocations =
        0;  // malloc, calloc, realloc, aligned_alloc, posix_memalign, and operator new through them
    std::uint64_t frees = 0;
    std::uint64_t locks = 0;  // pthread mutex, read-write lock, condition wait, semaphore wait
    std::uint64_t throws = 0;
    std::uint64_t files = 0;  // open, fopen, read, write

    RealtimeCounts& operator+=(const RealtimeCounts& more) noexcept {
        allocations += more.allocations;
        frees += more.frees;
        locks += more.locks;
        throws += more.throws;
        files += more.files;
        return *this;
    }
};

// Counting is per thread and on while a scope lives. Scopes do not nest.
class RealtimeScope {
public:
    RealtimeScope() noexcept;
    ~RealtimeScope();
    RealtimeScope(const RealtimeScope&) = delete;
    RealtimeScope& operator=(const RealtimeScope&) = delete;
    [[nodiscard]] RealtimeCounts counts() const noexcept;
};

}  // namespace burin::test
