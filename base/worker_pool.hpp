// SPDX-License-Identifier: MIT
// Fork-join parallelism for everything but the haptic thread: run(n, f) calls f(0) .. f(n-1), each once, on the caller
// and on oneTBB's worker threads, and returns when all calls are done. Results must not depend on which thread runs
// which index. Thread: any number of callers at once, also from inside f; callers share the worker threads. Never used
// by the haptic thread. Allocates. f must not throw.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace burin {

class WorkerPool {
public:
    // threads counts the caller too; 0 means one per core. 1 runs everything on the caller.
    explicit WorkerPool(unsigned threads = 0);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    [[nodiscard]] unsigned threads() const noexcept { return threads_; }

    // Calls f(0) .. f(count - 1), each once and in any order, and returns when all are done. What f writes is visible
    // to the caller afterwards.
    template <typename F>
    void run(std::size_t count, F&& f) {
        run_erased(count, &f, [](void* task, std::size_t i) { (*static_cast<std::remove_reference_t<F>*>(task))(i); });
    }

private:
    using Call = void (*)(void*, std::size_t);
    void run_erased(std::size_t count, void* task, Call call);

    struct Arena;  // keeps oneTBB's headers out of this one
    unsigned threads_;
    std::unique_ptr<Arena> arena_;  // null with one thread
};

}  // namespace burin
