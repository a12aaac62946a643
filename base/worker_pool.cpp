// SPDX-License-Identifier: MIT
#include "base/worker_pool.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>

#ifdef BURIN_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace burin {
namespace {

// oneTBB is not built for the thread sanitizer, which therefore cannot see that starting and finishing a task orders
// memory. These two tell it exactly that order and no more, so that races within and between tasks are still found.
void release_to(void* tag) {
#ifdef BURIN_THREAD_SANITIZER
    __tsan_release(tag);
#else
    static_cast<void>(tag);
#endif
}
void acquire_from(void* tag) {
#ifdef BURIN_THREAD_SANITIZER
    __tsan_acquire(tag);
#else
    static_cast<void>(tag);
#endif
}

unsigned threads_for(unsigned asked) { return asked != 0 ? asked : std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace

struct WorkerPool::Arena {
    explicit Arena(unsigned threads) : arena(static_cast<int>(threads)) {
        if (threads > threads_for(0)) allowed.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    // Raises oneTBB's own limit, one thread per core, where a caller asks for more. Never lowers it: the smallest limit
    // that exists holds for all pools.
    std::optional<tbb::global_control> allowed;
    tbb::task_arena arena;
};

WorkerPool::WorkerPool(unsigned threads) : threads_(threads_for(threads)) {
    if (threads_ > 1) arena_ = std::make_unique<Arena>(threads_);
}

WorkerPool::~WorkerPool() = default;

void WorkerPool::run_erased(std::size_t count, void* task, Call call) {
    if (!arena_ || count <= 1) {
        for (std::size_t i = 0; i < count; ++i) call(task, i);
        return;
    }
    char started = 0, finished = 0;  // their addresses name the two orders
    release_to(&started);
    arena_->arena.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, count,
            [&](std::size_t i) {
                acquire_from(&started);
                call(task, i);
                release_to(&finished);
            },
            tbb::simple_partitioner());
    });
    acquire_from(&finished);
}

}  // namespace burin
