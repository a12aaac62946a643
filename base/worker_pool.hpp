// SPDX-License-Identifier: MIT
// A fork-join pool for the carving side: run(n, f) calls f(0) .. f(n-1), each once, over all workers and the caller, and
// returns when all are done. One run often follows another within microseconds, and waking a sleeping thread takes tens of
// them: who waits looks for more for a moment before it sleeps. Results must not depend on which thread runs which index. Never used by the haptic thread.
// Our own and not a library: the well-known ones are not built for thread sanitizers, and this is all we need of them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

namespace burin {

class WorkerPool {
public:
    // threads counts the caller too; 0 means one per core. 1 runs everything on the caller.
    explicit WorkerPool(unsigned threads = 0);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    [[nodiscard]] unsigned threads() const noexcept { return static_cast<unsigned>(workers_.size()) + 1; }

    // f(std::size_t index) must not throw, and must not call run. One caller at a time.
    template <typename F>
    void run(std::size_t count, F&& f) {
        run_erased(count, &f, [](void* task, std::size_t i) { (*static_cast<std::remove_reference_t<F>*>(task))(i); });
    }

private:
    using Call = void (*)(void*, std::size_t);
    void run_erased(std::size_t count, void* task, Call call);
    void work();
    void take_indices();

    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::vector<std::thread> workers_;
    // Changed under mutex_, so that a sleeper misses nothing; read without it by those who are still looking.
    std::atomic<std::size_t> generation_{0}, busy_{0};
    bool stop_ = false;     // guarded by mutex_
    void* task_ = nullptr;  // written before the generation changes
    Call call_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_{0};
};

}  // namespace burin
