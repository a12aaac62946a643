// SPDX-License-Identifier: MIT
#include "renderer/surface/detail_worker.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace burin::renderer {
namespace {

// Nice value, of 19 at most: below carving, drawing and touch, but not lowest, as its results make drawing cheaper.
constexpr int kNice = 5;

}  // namespace

void DetailWorker::end() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    given_.notify_one();
    thread_.join();
}

void DetailWorker::give(DetailJob job) {
    ++waiting_;
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    given_.notify_one();
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

std::vector<DetailDone> DetailWorker::take() {
    std::vector<DetailDone> taken;
    if (waiting_ == 0) return taken;
    {
        const std::lock_guard lock(mutex_);
        std::swap(taken, done_);
    }
    waiting_ -= taken.size();
    return taken;
}

void DetailWorker::run() {
    // On Linux each thread has a nice value of its own; if setting
    // it is refused, the worker competes like any other thread.
    static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));
    std::unique_lock lock(mutex_);
    while (true) {
        given_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
        if (stopping_) return;
        DetailJob job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        std::vector<PatchLevel> levels = job.levels();
        lock.lock();
        done_.push_back({std::move(job), std::move(levels)});
    }
}

}  // namespace burin::renderer
