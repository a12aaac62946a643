// SPDX-License-Identifier: MIT
#include "base/worker_pool.hpp"

namespace burin {
namespace {

// How often to look before sleeping: some thirty microseconds of the processor's pauses. The steps of an update follow each
// other sooner than that, and to wake a thread takes as long.
constexpr int kLooks = 700;

void pause() {
#ifdef __x86_64__
    __builtin_ia32_pause();
#endif
}

template <typename Condition>
bool soon(Condition&& condition) {
    for (int i = 0; i < kLooks; ++i) {
        if (condition()) return true;
        pause();
    }
    return false;
}

}  // namespace

WorkerPool::WorkerPool(unsigned threads) {
    if (threads == 0) threads = std::thread::hardware_concurrency();
    for (unsigned i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::run_erased(std::size_t count, void* task, Call call) {
    if (count == 0) return;
    if (workers_.empty() || count == 1) {
        for (std::size_t i = 0; i < count; ++i) call(task, i);
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        task_ = task;
        call_ = call;
        count_ = count;
        next_.store(0, std::memory_order_relaxed);  // published by the generation
        busy_.store(workers_.size(), std::memory_order_relaxed);
        // release: whoever sees the new generation sees the task.
        generation_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    take_indices();
    // acquire: what the workers wrote in their tasks is seen after this.
    const auto all_done = [this] { return busy_.load(std::memory_order_acquire) == 0; };
    if (soon(all_done)) return;
    std::unique_lock lock(mutex_);
    done_.wait(lock, all_done);
}

void WorkerPool::work() {
    std::size_t seen = 0;
    const auto more = [&] { return generation_.load(std::memory_order_acquire) != seen; };
    for (;;) {
        if (!soon(more)) {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return stop_ || more(); });
            if (stop_) return;
        }
        seen = generation_.load(std::memory_order_acquire);
        take_indices();
        // release: the caller, who sees busy_ fall to zero, sees this worker's tasks done.
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
            const std::lock_guard lock(mutex_);  // not between the caller's last look and its sleep
            done_.notify_one();
        }
    }
}

void WorkerPool::take_indices() {
    // relaxed: each index is handed out once by the addition itself; the mutex orders the tasks' data.
    for (std::size_t i = next_.fetch_add(1, std::memory_order_relaxed); i < count_;
         i = next_.fetch_add(1, std::memory_order_relaxed)) {
        call_(task_, i);
    }
}

}  // namespace burin
