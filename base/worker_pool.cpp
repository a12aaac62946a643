// SPDX-License-Identifier: MIT
#include "base/worker_pool.hpp"

namespace burin {

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
        next_.store(0, std::memory_order_relaxed);  // published by the mutex
        busy_ = workers_.size();
        ++generation_;
    }
    wake_.notify_all();
    take_indices();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::work() {
    std::size_t seen = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return stop_ || generation_ != seen; });
            if (stop_) return;
            seen = generation_;
        }
        take_indices();
        {
            const std::lock_guard lock(mutex_);
            if (--busy_ == 0) done_.notify_one();
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
